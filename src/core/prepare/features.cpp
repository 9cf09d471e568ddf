#include "core/prepare/features.hpp"

#include <algorithm>

#include "crt/scene.hpp"

namespace crt::core {

Features find_features(const Scene& scene, const std::vector<PreparedMaterial>& materials,
                       bool csg) {
  Features features;
  features.csg = csg;
  features.lights = !scene.lights.empty();
  for (const Light& light : scene.lights) {
    std::visit(
        [&](const auto& kind) {
          if constexpr (requires { kind.ambient; })
            features.ambient = features.ambient || kind.ambient > 0;
        },
        light);
  }
  for (const PreparedMaterial& material : materials) {
    // Only diffuse and specular light can be blocked by something.
    const bool answers_lights = material.description->specular > 0 || material.diffuse(0.0) > 0;
    features.shadows = features.shadows || (features.lights && answers_lights);
    features.reflection = features.reflection || material.description->reflectivity > 0;
    features.transparency = features.transparency || !material.opaque;
    features.absorption = features.absorption || (!material.opaque && material.absorbing);
    features.gain = std::max(features.gain, material.gain);
    features.patterns = features.patterns || material.pattern.has_value();
    features.bumps = features.bumps || material.tilts();
    features.principled = features.principled || material.principled.has_value();
    features.emission = features.emission || material.emits;
  }
  features.lens = has_lens(scene.camera) && scene.settings.dof_samples > 1;
  return features;
}

}  // namespace crt::core
