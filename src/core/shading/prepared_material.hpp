// Prepared materials have what follows from their numbers alone.
#pragma once

#include <optional>

#include "core/shading/layer_shares.hpp"
#include "core/shading/prepared_pattern.hpp"
#include "crt/material.hpp"

namespace crt::core {

/// MaterialPools have what materials of one scene share.
struct MaterialPools {
  TexturePool& textures;
  TexturePool& normals;  ///< pictures of normals, which no gamma applies to
  LayerTablePool& tables;
};

/// A PreparedPrincipled is what a principled material has beside its stand-in.
struct PreparedPrincipled {
  PreparedPrincipled(const PrincipledMaterial& material, const MaterialPools& pools);

  // These are empty where a number holds everywhere.
  std::optional<PreparedPattern> metallic;
  std::optional<PreparedPattern> roughness;
  std::optional<PreparedPattern> emission;
  std::optional<PreparedPattern> normal_map;
  std::shared_ptr<const LayerTables> tables;

  bool uses_uv() const;
};

struct PreparedMaterial {
  PreparedMaterial(const SharedMaterial& material, const MaterialPools& pools);

  SharedMaterial description;
  /// This is the colour where there is no pattern.
  Color color;
  std::optional<PreparedPattern> pattern;
  /// This is empty if the bumps have no height.
  std::optional<PreparedPattern> bump;
  /// An opaque material lets nothing through anywhere.
  bool opaque = true;
  /// Light that the material lets through is multiplied by at most this, which is 1 if it brightens
  /// none.
  double gain = 1;
  /// No secondary ray continues from the material.
  bool ends_paths = true;
  bool absorbing = false;
  /// Some pattern uses u and v.
  bool uses_uv = false;
  /// This is empty for a material that is not principled.
  std::optional<PreparedPrincipled> principled;
  /// Returns whether patterns tilt its normals.
  bool tilts() const { return bump || (principled && principled->normal_map); }
  /// The surface gives off light.
  bool emits = false;

  /// Returns the share of light let through where the colour's alpha is `alpha`. A gap in the
  /// colour lets all of it through.
  template <class Real>
  Real transparency(const Real& alpha) const {
    const Real full = broadcast<Real>(description->transparency);
    return select(alpha == 1.0, full, 1.0 - (1.0 - full) * alpha);
  }

  /// Returns the strength of the diffuse light at that transparency.
  template <class Real>
  Real diffuse(const Real& transparency) const {
    if (description->diffuse) return broadcast<Real>(*description->diffuse);
    const Real rest = (1.0 - description->reflectivity) - transparency;
    return select(rest > 0.0, rest, Real{});
  }
};

}  // namespace crt::core
