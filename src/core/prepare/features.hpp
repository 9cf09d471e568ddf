#pragma once

#include <vector>

#include "core/shading/prepared_material.hpp"

namespace crt {
struct Scene;
}

namespace crt::core {

/// What a scene uses. What it does not use must cost it nothing: the ray loop asks here first.
struct Features {
  bool lights = false;
  bool ambient = false;       ///< some light has an ambient share
  bool shadows = false;       ///< some material answers light that could be kept from it
  bool reflection = false;    ///< some material mirrors
  bool transparency = false;  ///< some material lets light through
  bool absorption = false;    ///< some transparent material absorbs
  bool patterns = false;      ///< some material's colour is a pattern
  bool bumps = false;
  bool lens = false;  ///< aperture > 0 and more than one sample of it
  bool csg = false;
  /// What a surface multiplies the light by at most that it lets through; 1 if none brightens it.
  double gain = 1;
};

/// Reads them off a scene and its materials.
Features find_features(const Scene& scene, const std::vector<PreparedMaterial>& materials,
                       bool csg);

}  // namespace crt::core
