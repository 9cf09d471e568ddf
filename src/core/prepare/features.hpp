#pragma once

#include <vector>

#include "core/shading/prepared_material.hpp"

namespace crt {
struct Scene;
}

namespace crt::core {

/// Features are what a scene uses. What it does not use must cost it nothing: the ray loop asks
/// here first.
struct Features {
  bool lights = false;
  bool ambient = false;       ///< some light has an ambient share
  bool shadows = false;       ///< some material answers light that could be blocked
  bool reflection = false;    ///< some material mirrors
  bool transparency = false;  ///< some material lets light through
  bool absorption = false;    ///< some transparent material absorbs
  bool patterns = false;      ///< some material's colour is a pattern
  bool bumps = false;
  bool principled = false;  ///< some material is
  bool emission = false;    ///< some material gives off light
  bool lens = false;        ///< has_lens() and more than one sample of it
  bool csg = false;
  bool unseen = false;      ///< camera rays pass some object
  bool shadowless = false;  ///< light passes some object
  /// The light that a surface lets through is multiplied by at most this. It is 1 if none brightens
  /// it.
  double gain = 1;
};

/// Finds the features of a scene and its materials.
Features find_features(const Scene& scene, const std::vector<PreparedMaterial>& materials,
                       bool csg);

}  // namespace crt::core
