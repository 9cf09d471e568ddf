#pragma once

#include <crt/background.hpp>
#include <crt/camera.hpp>
#include <crt/entity.hpp>
#include <crt/light.hpp>
#include <crt/settings.hpp>
#include <vector>

namespace crt {

/// A Scene is the description of a picture: plain values, which can be edited freely without cost.
/// Nothing is computed until `prepare`, and editing a scene never touches what was prepared from
/// it.
struct Scene {
  std::vector<Entity> entities{};
  /// Without any there is a head light, see Settings::head_light.
  std::vector<Light> lights{};
  Camera camera{};
  Background background = SolidBackground{};
  Settings settings;
};

}  // namespace crt
