// Tests of one entity in both tiers share this scene.
#pragma once

#include "crt/prepared_scene.hpp"
#include "crt/scene.hpp"

namespace crt::test {

inline constexpr Precision tiers[] = {Precision::standard, Precision::exact};

/// Returns a scene that has nothing but an entity.
inline PreparedScene scene_of(const Entity& entity, Precision precision = Precision::standard) {
  Scene scene;
  scene.entities = {entity};
  scene.settings.precision = precision;
  return prepare(scene);
}

}  // namespace crt::test
