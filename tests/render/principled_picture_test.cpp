// Principled materials in pictures: furnaces, mirrors, glass, and what gives off light.
#include <doctest/doctest.h>

#include "pictures.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Makes a scene of one pixel, the middle of a ball, with an even sky that lights all.
Scene furnace(const SharedMaterial& material, bool is_light) {
  Scene scene = dark_scene();
  scene.settings.width = 1;
  scene.settings.height = 1;
  scene.settings.min_samples = 16384;
  scene.settings.max_samples = 16384;
  scene.settings.target_error = 1e-9;
  scene.settings.recursion_depth = 16;
  scene.settings.cutoff = Cutoff::background;
  scene.settings.indirect = 1;
  scene.background = SolidBackground{{1, 1, 1}};
  if (is_light) scene.lights = {EnvironmentLight{}};
  scene.camera = {.position = {0, 0, -4}, .pointing = {0.4, 0.3, 0}, .fov = 1e-4};
  scene.entities = {Sphere{.material = material}};
  return scene;
}

Color middle(const Scene& scene) {
  return render(prepare(scene), {.threads = 2}).at(0, 0);
}

}  // namespace

TEST_CASE("white principled balls vanish before an even sky, whatever they are made of") {
  for (const double metallic : {0.0, 0.5, 1.0}) {
    for (const double roughness : {0.0, 0.4, 1.0}) {
      for (const double coat : {0.0, 1.0}) {
        CAPTURE(metallic);
        CAPTURE(roughness);
        CAPTURE(coat);
        const PrincipledMaterial white{.color = Color{1, 1, 1},
                                       .metallic = metallic,
                                       .roughness = roughness,
                                       .coat = coat,
                                       .coat_roughness = 0.3};
        CHECK(middle(furnace(white, true)).r == doctest::Approx(1).epsilon(0.015));
      }
    }
  }
}

TEST_CASE("so do balls that let light through, smooth or rough") {
  for (const double roughness : {0.0, 0.3, 0.8}) {
    CAPTURE(roughness);
    const PrincipledMaterial clear{
        .color = Color{1, 1, 1}, .roughness = roughness, .transmission = 1};
    CHECK(middle(furnace(clear, true)).r == doctest::Approx(1).epsilon(0.02));
  }
}

TEST_CASE("a smooth metal shows what a mirror of its colour shows") {
  const PrincipledMaterial metal{.color = Color{1, 1, 1}, .metallic = 1, .roughness = 0};
  Scene scene = furnace(metal, false);
  scene.background = GradientBackground{.horizon = {0.1, 0.2, 0.3}, .sky = {1, 0.5, 0}};
  scene.settings.target_error = 0;
  const Color seen = middle(scene);
  scene.entities = {Sphere{.material = inert(1)}};
  const Color mirrored = middle(scene);
  CHECK(seen.r == doctest::Approx(mirrored.r).epsilon(1e-4));
  CHECK(seen.b == doctest::Approx(mirrored.b).epsilon(1e-4));
}

TEST_CASE("lights that are seen give a rough metal as much as those that are not") {
  // Light is found by samples and by rays then, and else by samples alone.
  for (const double roughness : {0.15, 0.3, 0.7}) {
    CAPTURE(roughness);
    Scene scene = furnace(
        PrincipledMaterial{.color = Color{1, 0.8, 0.5}, .metallic = 1, .roughness = roughness},
        false);
    scene.background = SolidBackground{{0, 0, 0}};
    SphereLight light{.center = {1.5, 2, -3}, .radius = 0.5, .color = {4, 4, 4}};
    scene.lights = {light};
    const Color both = middle(scene);
    light.visible = false;
    scene.lights = {light};
    const Color samples = middle(scene);
    CHECK(both.r > 0);
    CHECK(both.r == doctest::Approx(samples.r).epsilon(0.02));
    CHECK(both.b == doctest::Approx(samples.b).epsilon(0.02));
  }
}

TEST_CASE("what gives off light shows it, and lights what bounces see") {
  const Material glowing{.color = Color{0, 0, 0}, .diffuse = 0, .emission = {2, 1, 0.5}};
  Scene scene = furnace(glowing, false);
  scene.background = SolidBackground{{0, 0, 0}};
  CHECK(middle(scene) == Color{2, 1, 0.5});
  // Within a glowing ball, a matt one gets its albedo times that light.
  scene.entities = {Sphere{.radius = 20, .material = glowing},
                    Sphere{.material = Material{.color = grey(0.5), .diffuse = 1}}};
  CHECK(middle(scene).r == doctest::Approx(1).epsilon(1e-3));
  scene.settings.indirect = 0;
  CHECK(middle(scene).r == 0);
}
