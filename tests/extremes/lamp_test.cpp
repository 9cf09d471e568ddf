// Lights that are exactly on a surface light what is before it, without a speckle.
#include <doctest/doctest.h>

#include <string>

#include "extremes/support.hpp"

using namespace crt;
using namespace crt::test;

namespace {

struct Fixture {
  std::string name;
  Entity bearer;  ///< above y = 2, with a surface through (0, 2, 0)
};

std::vector<Fixture> fixtures() {
  const Entity ceiling = Box{.corner_a = {-5, 2, -5}, .corner_b = {5, 3, 5}};
  return {
      {"ceiling", ceiling},
      {"half-space", Plane{.normal = {0, -1, 0}, .position = {0, 2, 0}}},
      {"ball", Sphere{.center = {0, 3, 0}, .radius = 1}},
      {"cylinder", Cylinder{.from = {0, 2, 0}, .to = {0, 3, 0}, .radius = 1}},
      {"cylinder's side", Cylinder{.from = {-1, 3, 0}, .to = {1, 3, 0}, .radius = 1}},
      {"cone", Cone{.from = {0, 3, 0}, .to = {0, 2, 0}, .radius = 1}},
      {"ring", Torus{.center = {0, 3, 0}, .axis = {1, 0, 0}, .radius = 0.75, .thickness = 0.25}},
      {"disc", Disc{.center = {0, 2, 0}}},
      {"niche", ceiling - Entity(Box{.corner_a = {-1, 1, -1}, .corner_b = {1, 2, 1}})},
      {"two", ceiling + Entity(Sphere{.center = {0, 3, 0}, .radius = 1})}};
}

}  // namespace

TEST_CASE("a light on a surface lights what is before it") {
  Random random(40);
  for (const Fixture& fixture : fixtures()) {
    for (int round = 0; round < 12; ++round) {
      Transform placed = round < 2
                             ? Transform{}
                             : rotate_degrees({random.between(0, 360), random.between(0, 360), 0});
      placed.translation = random.between(0, 30) * random.direction();
      const auto place = [&](const Vec3& p) { return apply(placed, p); };
      Scene scene = dark_scene();
      scene.settings.width = 40;
      scene.settings.height = 40;
      scene.settings.precision = round % 2 == 0 ? Precision::standard : Precision::exact;
      const SharedMaterial white(Material{.color = grey(1)});
      scene.entities = {fixture.bearer.transformed(placed).with_material(white).with_id(1),
                        Entity(Plane{}).transformed(placed).with_material(white).with_id(0)};
      const Vec3 light = place({0, 2, 0});
      scene.lights = {PointLight{.origin = light}};
      // The camera is between floor and fixture, where it sees the floor alone.
      scene.camera = {
          .position = place({0.4, 1.9, -3.3}), .pointing = place({0.1, 0, 0.2}), .fov = 1.2};
      RayQueries queries(prepare(scene));
      const Image image = render(prepare(scene), {.threads = 1});
      int dark = 0;
      int floor = 0;
      for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 40; ++x) {
          const std::optional<Hit> hit = queries.intersect(pixel_ray(scene, x, y));
          if (!hit || hit->entity_id != 0) continue;
          ++floor;
          const Vec3 offset = light - hit->position;
          const double expected = glm::dot(offset, hit->normal) / glm::length(offset);
          dark += std::abs(image.at(x, y).r - expected) > 1e-5 ? 1 : 0;
        }
      }
      CAPTURE(fixture.name);
      CAPTURE(round);
      CHECK(dark == 0);
      CHECK(floor > 500);
    }
  }
}
