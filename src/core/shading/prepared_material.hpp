// Materials with what can be told of them beforehand.
#pragma once

#include <optional>

#include "core/shading/prepared_pattern.hpp"
#include "crt/material.hpp"

namespace crt::core {

struct PreparedMaterial {
  PreparedMaterial(const SharedMaterial& material, TexturePool& textures);

  SharedMaterial description;
  /// The colour where there is no pattern.
  Color color;
  std::optional<PreparedPattern> pattern;
  /// Empty where the bumps have no height.
  std::optional<PreparedPattern> bump;
  /// Lets nothing through anywhere.
  bool opaque = true;
  /// No ray goes on from it.
  bool ends_paths = true;
  bool absorbing = false;

  /// Looks the same everywhere.
  bool uniform() const { return !pattern && !bump; }

  /// The share of light let through where the colour's alpha is `alpha`: a gap in the colour lets
  /// all of it through.
  double transparency(double alpha) const {
    return alpha == 1 ? description->transparency : 1 - (1 - description->transparency) * alpha;
  }

  /// The strength of the diffuse light there.
  double diffuse(double transparency) const;
};

}  // namespace crt::core
