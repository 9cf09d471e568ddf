// A scene at 10^9 of its own size from the origin looks as it does at the origin.
#include <doctest/doctest.h>

#include "extremes/support.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// The scene is put here. Its coordinates, all multiples of 2^-20, are doubles there too.
constexpr double far = 0x1p32;
constexpr double coordinate_step = 0x1p-20;

Vec3 snapped(const Vec3& p) {
  Vec3 result;
  for (int axis = 0; axis < 3; ++axis)
    result[axis] = std::nearbyint(p[axis] / coordinate_step) * coordinate_step;
  return result;
}

enum class Placing { coordinates, transform };

Scene scene_at(const Vec3& away, Placing placing, Precision precision) {
  Scene scene;
  scene.settings.width = 60;
  scene.settings.height = 45;
  scene.settings.precision = precision;
  scene.background = GradientBackground{};
  const auto at = [&](double x, double y, double z) {
    return snapped({x, y, z}) + (placing == Placing::coordinates ? away : Vec3(0));
  };
  Material crystal = glass(1.5);
  crystal.absorption = {0.1, 0.4, 0.2};
  const Material shiny{.color = Color{0.8, 0.7, 0.3}, .reflectivity = 0.3, .specular = 0.4};
  const Material plain{.color = Color{0.3, 0.5, 0.8}};
  const Entity block = Box{.corner_a = at(0.9, 0, 0), .corner_b = at(2, 1.1, 1), .material = plain};
  scene.entities = {
      Plane{.position = at(0, 0, 0), .material = shiny},
      Sphere{.center = at(-0.2, 0.7, -0.5), .radius = 0.7, .material = crystal},
      block - Entity(Sphere{.center = at(1.5, 1.1, 0.2), .radius = 0.4, .material = shiny}) -
          Entity(Box{.corner_a = at(0.9, 0, 0), .corner_b = at(1.2, 1.1, 0.3)}),
      Cylinder{.from = at(-2, 0, 1), .to = at(-1.8, 1.3, 1.2), .radius = 0.4, .material = shiny},
      Cone{.from = at(0.6, 0, -1.4),
           .to = at(0.7, 0.6, -1.3),
           .radius = 0.3,
           .radius2 = 0.1,
           .material = plain},
      Torus{.center = at(-1.4, 0.4, -0.6),
            .axis = {0.3, 1, 0.2},
            .radius = 0.5,
            .thickness = 0.15,
            .material = plain},
      Disc{.center = at(0.2, 1.4, 2), .normal = {0.1, 0.2, -1}, .radius = 0.7, .material = shiny},
      Triangle{
          .a = at(-1, 0, 2.3), .b = at(0, 0.2, 2.4), .c = at(-0.6, 1.6, 2.5), .material = plain}};
  if (placing == Placing::transform) {
    for (Entity& entity : scene.entities) entity = entity.transformed(translate(away));
  }
  scene.lights = {
      PointLight{.origin = snapped({3, 5, -4}) + away, .ambient = 0.1},
      SpotLight{.origin = snapped({-4, 6, -2}) + away, .pointing = away, .color = grey(0.6)},
      ParallelLight{.from = {1, 1, -1}, .pointing = Vec3(0), .color = grey(0.3)}};
  scene.camera = {.position = snapped({0.3, 1.7, -5.1}) + away,
                  .pointing = snapped({0, 0.5, 0.1}) + away};
  return scene;
}

}  // namespace

TEST_CASE("a scene at 10^9 of its size from the origin is hit where it is at the origin") {
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    for (const Placing placing : {Placing::coordinates, Placing::transform}) {
      const Scene here = scene_at(Vec3(0), placing, precision);
      RayQueries near_queries(prepare(here));
      for (const Vec3& away :
           {far * Vec3(1, 1, 1), far * Vec3(-1, 0.5, 0.25), far * Vec3(0, 0, -1)}) {
        const Scene there = scene_at(away, placing, precision);
        RayQueries far_queries(prepare(there));
        int different = 0;
        for (int y = 0; y < here.settings.height; ++y) {
          for (int x = 0; x < here.settings.width; ++x) {
            Ray ray = pixel_ray(here, x, y);
            const std::optional<Hit> expected = near_queries.intersect(ray);
            ray.origin += away;
            const std::optional<Hit> hit = far_queries.intersect(ray);
            if (hit.has_value() != expected.has_value()) {
              ++different;
            } else if (hit && (hit->entity_id != expected->entity_id ||
                               hit->entering != expected->entering ||
                               std::abs(hit->t - expected->t) > 1e-13 * expected->t ||
                               glm::length(hit->normal - expected->normal) > 1e-12)) {
              ++different;
            }
          }
        }
        CAPTURE(away.x);
        CHECK(different == 0);
      }
    }
  }
}

TEST_CASE("a scene at 10^9 of its size from the origin looks as it does at the origin") {
  // Points on surfaces are rounded to 2^-20, a millionth; light, mirrors and glass see that, but
  // hardly.
  constexpr double alike = 2e-4;
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    for (const Placing placing : {Placing::coordinates, Placing::transform}) {
      const Image reference =
          render(prepare(scene_at(Vec3(0), placing, precision)), {.threads = 1});
      for (const Vec3& away :
           {far * Vec3(1, 1, 1), far * Vec3(-1, 0.5, 0.25), far * Vec3(0, 0, -1)}) {
        const Image image = render(prepare(scene_at(away, placing, precision)), {.threads = 1});
        int different = 0;
        for (int y = 0; y < image.height(); ++y) {
          for (int x = 0; x < image.width(); ++x) {
            if (difference(image.at(x, y), reference.at(x, y)) > alike) ++different;
          }
        }
        CAPTURE(away.x);
        CHECK(speckles(image, reference, alike) == 0);
        CHECK(different <= 5);
      }
    }
  }
}
