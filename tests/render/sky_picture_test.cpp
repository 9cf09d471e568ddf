// A sky lights a scene, and its sun is seen where nothing has taken samples of it.
#include <doctest/doctest.h>

#include <cmath>

#include "core/shading/sky.hpp"
#include "crt/error.hpp"
#include "pictures.hpp"

using namespace crt;
using namespace crt::test;

namespace {

const SkyBackground evening{.sun = {0.4, 0.6, 1}, .turbidity = 4};

/// Makes a scene that takes many samples of one pixel.
Scene sampled_scene(const Background& background, int samples = 1024) {
  Scene scene = dark_scene();
  scene.background = background;
  scene.settings.target_error = 1;
  scene.settings.min_samples = scene.settings.max_samples = samples;
  return scene;
}

Entity floor_of(const SharedMaterial& material) {
  return Plane{.normal = {0, 1, 0}, .position = {0, 0, 0}, .material = material};
}

Material matt(double color) {
  return {.color = grey(color)};
}

/// Returns what a narrow look along a direction sees.
Color along(Scene scene, const Vec3& from, const Vec3& direction) {
  scene.camera.fov = 1e-3;
  return seen(scene, from, from + direction);
}

Color sun_of(const SkyBackground& background) {
  const core::Rgb light =
      core::Sky(background)
          .sun(core::lanes_of(core::direction_and_length(background.sun).direction))
          .lane(0);
  return {light.x, light.y, light.z};
}

}  // namespace

TEST_CASE("a white floor under a sky is as bright as the ground that the sky shows") {
  // That is computed by quadrature when the sky is prepared.
  SkyBackground background = evening;
  background.ground = {1, 1, 1};
  Scene scene = sampled_scene(background, 16384);
  const Color ground = along(scene, {0, 1, 0}, {0, -1, 0.3});
  scene.entities = {floor_of(matt(1))};
  for (const int indirect : {0, 2}) {
    scene.settings.indirect = indirect;
    const Color lit = along(scene, {0, 1, 0}, {0, -1, 0.3});
    CHECK(lit.r == doctest::Approx(ground.r).epsilon(2e-3));
    CHECK(lit.g == doctest::Approx(ground.g).epsilon(2e-3));
    CHECK(lit.b == doctest::Approx(ground.b).epsilon(2e-3));
  }
}

TEST_CASE("a sky that does not shine is merely seen") {
  SkyBackground background = evening;
  background.shines = false;
  Scene scene = sampled_scene(background, 16);
  const Color sky = along(scene, {0, 1, 0}, {0, 1, -1});
  scene.entities = {floor_of(matt(1))};
  CHECK(along(scene, {0, 1, 0}, {0, -1, 0.3}) == Color{0, 0, 0});
  scene.background = evening;
  CHECK(along(scene, {0, 1, 0}, {0, 1, -1}) == sky);
}

TEST_CASE("a scene with a sky needs no head light, and has no warning of lights") {
  Scene scene;
  scene.entities = {floor_of(matt(1))};
  const auto warns = [&scene] {
    const PreparedScene prepared = prepare(scene);
    for (const std::string& warning : prepared.warnings())
      if (warning.find("no lights") != std::string::npos) return true;
    return false;
  };
  CHECK(warns());
  scene.background = evening;
  CHECK_FALSE(warns());
}

TEST_CASE("an environment light takes the place of the dome's") {
  Scene scene = sampled_scene(evening, 4096);
  scene.entities = {floor_of(matt(1))};
  const double whole = along(scene, {0, 1, 0}, {0, -1, 0.3}).g;
  scene.lights = {EnvironmentLight{.scale = 0}};
  const double sun = along(scene, {0, 1, 0}, {0, -1, 0.3}).g;
  scene.lights = {EnvironmentLight{.scale = 2}};
  const double brighter = along(scene, {0, 1, 0}, {0, -1, 0.3}).g;
  CHECK(sun < 0.9 * whole);
  CHECK(brighter - sun == doctest::Approx(2 * (whole - sun)).epsilon(5e-3));
}

TEST_CASE("cameras, mirrors and clear glass see the sun as it is") {
  Scene scene = sampled_scene(evening, 16);
  const Color sun = sun_of(evening);
  const Color dome = along(scene, {0, 1, 0}, {0.4, 0.6, 1.2});
  CHECK(sun.g > 1e3 * dome.g);
  CHECK(along(scene, {0, 1, 0}, evening.sun).g == doctest::Approx(sun.g).epsilon(1e-2));

  const Vec3 down(evening.sun.x, -evening.sun.y, evening.sun.z);
  scene.entities = {floor_of(inert(0.5))};
  CHECK(along(scene, {0, 1, 0}, down).g == doctest::Approx(0.5 * sun.g).epsilon(1e-2));
  scene.entities = {
      floor_of(PrincipledMaterial{.color = Color{1, 1, 1}, .metallic = 1.0, .roughness = 0.0})};
  CHECK(along(scene, {0, 1, 0}, down).g == doctest::Approx(sun.g).epsilon(1e-2));
  scene.entities = {
      Entity(Plane{.normal = {0, 1, 0}, .position = {0, 2, 0}, .material = glass(1)})};
  CHECK(along(scene, {0, 1, 0}, evening.sun).g == doctest::Approx(sun.g).epsilon(1e-2));
}

TEST_CASE("rough metal has the sun by samples alone, also through clear glass") {
  // The same sky by a background that shows no sun and lights that are written out.
  const PrincipledMaterial metal{.color = Color{1, 1, 1}, .metallic = 1.0, .roughness = 0.3};
  SkyBackground shown = evening;
  shown.shines = false;
  for (const double degrees_off : {0.0, 10.0}) {
    Scene scene = sampled_scene(evening, 4096);
    scene.entities = {floor_of(metal)};
    const Vec3 down(evening.sun.x, -evening.sun.y - degrees_off * 0.02, evening.sun.z);
    const Color own = along(scene, {0, 1, 0}, down);
    scene.entities.push_back(
        Box{.corner_a = {-9, 1.5, -9}, .corner_b = {9, 1.6, 9}, .material = glass(1)});
    CHECK(along(scene, {0, 1, 0}, down).g == doctest::Approx(own.g).epsilon(0.02));
    scene.entities.pop_back();
    scene.background = shown;
    scene.lights = {EnvironmentLight{}, core::Sky(evening).sunlight()};
    const Color written = along(scene, {0, 1, 0}, down);
    CHECK(own == written);
    CHECK(own.g < 100);  // A disc that is seen would be 10^4.
  }
}

TEST_CASE("the light of a sky has the same bytes for any number of threads") {
  Scene scene = varied_scene();
  scene.lights = {};
  scene.background = evening;
  const PreparedScene prepared = prepare(scene);
  CHECK(same_pixels(render(prepared, {.threads = 1}), render(prepared, {.threads = 4})));
}

TEST_CASE("a sky of bad numbers is an error with its field") {
  const auto field_of_error = [](const SkyBackground& background) -> std::string {
    Scene scene;
    scene.background = background;
    try {
      prepare(scene);
    } catch (const Error& error) {
      return std::string(error.argument());
    }
    return "";
  };
  CHECK(field_of_error({}) == "");
  CHECK(field_of_error({.sun = {0, 0, 0}}) == "sun");
  CHECK(field_of_error({.sun = {0, NAN, 0}}) == "sun");
  CHECK(field_of_error({.turbidity = 1.9}) == "turbidity");
  CHECK(field_of_error({.turbidity = NAN}) == "turbidity");
  CHECK(field_of_error({.scale = -1}) == "scale");
  CHECK(field_of_error({.ground = {-1, 0, 0}}) == "ground");
}
