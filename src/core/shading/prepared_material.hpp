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
  /// What light that it lets through is multiplied by at most; 1 if it brightens none.
  double gain = 1;
  /// No ray goes on from it.
  bool ends_paths = true;
  bool absorbing = false;
  /// Its pattern or its bumps look at u and v.
  bool uses_uv = false;

  /// The share of light let through where the colour's alpha is `alpha`: a gap in the colour lets
  /// all of it through.
  template <class Real>
  Real transparency(const Real& alpha) const {
    const Real full = broadcast<Real>(description->transparency);
    return select(alpha == 1.0, full, 1.0 - (1.0 - full) * alpha);
  }

  /// The strength of the diffuse light there.
  template <class Real>
  Real diffuse(const Real& transparency) const {
    if (description->diffuse) return broadcast<Real>(*description->diffuse);
    const Real rest = (1.0 - description->reflectivity) - transparency;
    return select(rest > 0.0, rest, Real{});
  }
};

}  // namespace crt::core
