// A camera that is exactly on a surface sees what is before it, and from within what is behind it.
#include <doctest/doctest.h>

#include <string>

#include "extremes/support.hpp"

using namespace crt;
using namespace crt::test;

namespace {

struct Post {
  std::string name;
  Entity solid;  ///< convex, with a surface through `at` and the normal `out` there
  Vec3 at;
  Vec3 out;
};

std::vector<Post> posts() {
  const Vec3 up(0, 1, 0);
  const Vec3 slanted = glm::normalize(Vec3(1, 2, -0.5));
  return {
      {"ground", Entity(Plane{}) ^ Entity(Sphere{.radius = 100}), {0.3, 0, 0.2}, up},
      {"box", Box{}, {0.3, 1, -0.2}, up},
      {"ball", Sphere{}, slanted, slanted},
      {"cylinder", Cylinder{.from = {-1, 0, 0}, .to = {1, 0, 0}}, {0.3, 0.6, 0.8}, {0, 0.6, 0.8}},
      {"cylinder's cap", Cylinder{}, {0.3, 1, -0.2}, up},
      {"cone", Cone{}, {0.3, 0.5, 0.4}, glm::normalize(Vec3(0.6, 1, 0.8))},
      {"part of a ball", Entity(Sphere{}) ^ Entity(Box{.corner_a = {-2, -2, -2}}), slanted,
       slanted}};
}

Scene seen_from(const Post& post, const Transform& placed, const Vec3& towards,
                Precision precision) {
  Scene scene = dark_scene();
  scene.settings.width = 30;
  scene.settings.height = 30;
  scene.settings.precision = precision;
  scene.entities = {post.solid.transformed(placed)};
  scene.camera.position = apply(placed, post.at);
  scene.camera.pointing = scene.camera.position + turn(placed, towards);
  scene.camera.fov = 2.4;
  return scene;
}

}  // namespace

TEST_CASE("an eye on a solid sees the open before it and the solid behind it") {
  constexpr double flat = 1e-3;
  Random random(50);
  for (const Post& post : posts()) {
    for (int round = 0; round < 16; ++round) {
      Transform placed = round < 2
                             ? Transform{}
                             : rotate_degrees({random.between(0, 360), random.between(0, 360), 0});
      placed.translation = random.between(0, 30) * random.direction();
      const Precision precision = round % 2 == 0 ? Precision::standard : Precision::exact;
      for (const bool glassy : {false, true}) {
        Scene scene = seen_from(post, placed, post.out + 1.5 * random.direction(), precision);
        scene.background = SolidBackground{{1, 1, 1}};
        scene.settings.recursion_depth = 20;
        Material fog = glass(1);
        fog.absorption = grey(1e9);
        scene.entities = {scene.entities[0].with_material(glassy ? fog : inert())};
        const Image image = render(prepare(scene), {.threads = 1});
        int wrong = 0;
        for (int y = 0; y < 30; ++y) {
          for (int x = 0; x < 30; ++x) {
            const double rise = glm::dot(pixel_ray(scene, x, y).direction, turn(placed, post.out));
            if (std::abs(rise) < flat) continue;
            wrong += image.at(x, y).r != (rise > 0 ? 1 : 0) ? 1 : 0;
          }
        }
        CAPTURE(post.name);
        CAPTURE(round);
        CAPTURE(glassy);
        CHECK(wrong == 0);
      }
    }
  }
}

TEST_CASE("an eye at the level of the water sees into it below and across it above") {
  Random random(51);
  for (int round = 0; round < 12; ++round) {
    Transform placed = round < 2
                           ? Transform{}
                           : rotate_degrees({random.between(0, 360), random.between(0, 360), 0});
    placed.translation = random.between(0, 30) * random.direction();
    Scene scene = dark_scene();
    scene.settings.width = 20;
    scene.settings.height = 20;
    scene.settings.precision = round % 2 == 0 ? Precision::standard : Precision::exact;
    scene.background = SolidBackground{{1, 1, 1}};
    Material water = glass(1);
    water.absorption = {0, 0.5, 50};
    scene.entities = {
        Entity(Box{.corner_a = {-5, -2, -5}, .corner_b = {5, 0, 5}, .material = water})
            .transformed(placed)};
    scene.camera.position = apply(placed, {0.3, 0, -1});
    // The camera looks level, or in the water's plane but to the side.
    scene.camera.pointing = apply(placed, {0.3 + round % 3, 0, 1});
    const Image image = render(prepare(scene), {.threads = 1});
    int wrong = 0;
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 20; ++x) {
        const Vec3 direction = pixel_ray(scene, x, y).direction;
        const double rise = glm::dot(direction, turn(placed, {0, 1, 0}));
        if (std::abs(rise) < 1e-3) continue;
        wrong += (image.at(x, y).b < 1e-6F) != (rise < 0) ? 1 : 0;
      }
    }
    CAPTURE(round);
    CHECK(wrong == 0);
  }
}
