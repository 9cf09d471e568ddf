// This has handles that release themselves, and small scenes, for the tests of the C interface.
#pragma once

#include <crt/crt.h>
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>

namespace crt::test {

template <auto release>
struct Releaser {
  template <class Handle>
  void operator()(Handle* handle) const {
    release(handle);
  }
};

using EntityHandle = std::unique_ptr<crt_entity, Releaser<crt_entity_release>>;
using SceneHandle = std::unique_ptr<crt_scene, Releaser<crt_scene_release>>;
using PreparedHandle = std::unique_ptr<crt_prepared, Releaser<crt_prepared_release>>;
using JobHandle = std::unique_ptr<crt_job, Releaser<crt_job_release>>;
using ImageHandle = std::unique_ptr<crt_image, Releaser<crt_image_release>>;
using BufferHandle = std::unique_ptr<crt_buffer, Releaser<crt_buffer_release>>;
using ProfileHandle = std::unique_ptr<crt_profile, Releaser<crt_profile_release>>;
using DiagnosticsHandle = std::unique_ptr<crt_diagnostics, Releaser<crt_diagnostics_release>>;

using Numbers = std::array<double, 3>;

/// Returns what a function handed out. The test fails if it did not.
template <class Handle, class Call>
Handle made(const Call& call) {
  typename Handle::pointer out = nullptr;
  const crt_status status = call(&out);
  INFO(std::string(crt_error_message()));
  REQUIRE(status == CRT_OK);
  REQUIRE(out != nullptr);
  return Handle(out);
}

inline EntityHandle sphere(const Numbers& center, double radius) {
  return made<EntityHandle>(
      [&](crt_entity** out) { return crt_sphere_create(center.data(), radius, out); });
}

inline EntityHandle box(const Numbers& a, const Numbers& b) {
  return made<EntityHandle>(
      [&](crt_entity** out) { return crt_box_create(a.data(), b.data(), out); });
}

inline EntityHandle difference(crt_entity* from, crt_entity* cutter) {
  return made<EntityHandle>(
      [&](crt_entity** out) { return crt_difference_create(from, &cutter, 1, out); });
}

inline SceneHandle new_scene() {
  return made<SceneHandle>([](crt_scene** out) { return crt_scene_create(out); });
}

inline ProfileHandle new_profile() {
  return made<ProfileHandle>([](crt_profile** out) { return crt_profile_create(out); });
}

inline PreparedHandle prepare(crt_scene* scene) {
  return made<PreparedHandle>([&](crt_prepared** out) { return crt_scene_prepare(scene, out); });
}

inline ImageHandle render(crt_prepared* prepared, const crt_render_options* options = nullptr) {
  return made<ImageHandle>([&](crt_image** out) { return crt_render(prepared, options, out); });
}

/// Makes a small scene of a lit sphere and a box with a hole.
inline SceneHandle small_scene(std::int32_t width = 40, std::int32_t height = 30) {
  SceneHandle scene = new_scene();
  const EntityHandle ball = sphere({-0.4, 0, 2}, 0.5);
  const EntityHandle block = box({0.2, -0.5, 1.5}, {1.2, 0.5, 2.5});
  const EntityHandle hole = sphere({0.7, 0, 1.5}, 0.4);
  const EntityHandle part = difference(block.get(), hole.get());
  REQUIRE(crt_scene_add_entity(scene.get(), ball.get()) == CRT_OK);
  REQUIRE(crt_scene_add_entity(scene.get(), part.get()) == CRT_OK);
  crt_light light;
  REQUIRE(crt_light_init(&light, sizeof light) == CRT_OK);
  light.origin[0] = 2;
  light.origin[1] = 3;
  light.origin[2] = -1;
  light.ambient = 0.1;
  REQUIRE(crt_scene_add_light(scene.get(), &light) == CRT_OK);
  crt_settings settings;
  REQUIRE(crt_settings_init(&settings, sizeof settings) == CRT_OK);
  settings.width = width;
  settings.height = height;
  REQUIRE(crt_scene_set_settings(scene.get(), &settings) == CRT_OK);
  return scene;
}

inline std::string message() {
  return crt_error_message();
}

/// Says whether the thread's last message contains `text`.
inline bool says(const std::string& text) {
  return message().find(text) != std::string::npos;
}

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace crt::test
