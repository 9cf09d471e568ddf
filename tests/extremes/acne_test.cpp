// A lit convex solid never shadows itself, at any scale.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "extremes/support.hpp"

using namespace crt;
using namespace crt::test;

namespace {

struct Named {
  std::string name;
  Entity solid;
};

/// Returns convex solids within two units around the origin.
std::vector<Named> convex_solids() {
  const Entity ball = Sphere{};
  const Entity block = Box{.corner_a = {-1, -0.7, -0.8}, .corner_b = {0.9, 0.8, 1}};
  const Entity pillar = Cylinder{.from = {-0.2, -1, 0.1}, .to = {0.3, 1, 0}, .radius = 0.6};
  const Entity half = Plane{.normal = {0.6, 0, 0.8}, .position = {0.2, 0, 0}};
  return {{"sphere", ball},
          {"box", block},
          {"cylinder", pillar},
          {"cone", Cone{.from = {0, -1, 0}, .to = {0.1, 1, 0.2}}},
          {"frustum", Cone{.from = {0, -1, 0}, .to = {0.1, 1, 0.2}, .radius = 0.4, .radius2 = 0.9}},
          {"half a ball", ball ^ half},
          {"intersection", ball ^ block ^ pillar},
          {"a block less half of it", block - half}};
}

/// Returns the light that a camera ray's hit sends back if nothing stands between it and the
/// lights.
double unhidden_light(const Scene& scene, const Ray& ray, RayQueries& queries) {
  const std::optional<Hit> hit = queries.intersect(ray);
  if (!hit) return 0;
  double light = 0;
  for (const Light& source : scene.lights) {
    const Vec3 towards = std::visit(
        [&](const auto& kind) {
          if constexpr (requires { kind.from; }) {
            return kind.from - kind.pointing;
          } else if constexpr (requires { kind.origin; }) {
            return kind.origin - hit->position;
          } else {
            return Vec3(std::numeric_limits<double>::quiet_NaN());  // no light of these tests
          }
        },
        source);
    light += std::max(0.0, glm::dot(hit->normal, towards / glm::length(towards)));
  }
  return light;
}

/// A Count says how many pixels are darker than if nothing blocked the light, and how many are lit.
struct Count {
  int wrong = 0;
  int lit = 0;
};

Count compare_with_unhidden(const Scene& scene) {
  constexpr double tolerance = 1e-5;
  const PreparedScene prepared = prepare(scene);
  RayQueries queries(prepared);
  const Image image = render(prepared, {.threads = 1});
  Count count;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const double expected = unhidden_light(scene, pixel_ray(scene, x, y), queries);
      count.lit += expected > 0 ? 1 : 0;
      count.wrong += std::abs(image.at(x, y).r - expected) > tolerance ? 1 : 0;
    }
  }
  return count;
}

Scene lit_scene(const Named& named, double scale_by, Precision precision, Random& random) {
  Scene scene = dark_scene();
  scene.settings.width = 24;
  scene.settings.height = 24;
  scene.settings.precision = precision;
  const Transform turned =
      rotate_degrees({random.between(0, 360), random.between(0, 360), random.between(0, 360)});
  scene.entities = {named.solid.transformed(turned)
                        .transformed(scale(scale_by))
                        .with_material(Material{.color = grey(1)})};
  for (int i = 0; i < 3; ++i) {
    scene.lights.emplace_back(ParallelLight{.from = random.direction(), .pointing = Vec3(0)});
    scene.lights.emplace_back(PointLight{.origin = 2.0 * scale_by * random.direction()});
  }
  scene.camera = {.position = 4.0 * scale_by * random.direction(), .pointing = Vec3(0), .fov = 0.7};
  return scene;
}

}  // namespace

TEST_CASE("a lit convex solid never shadows itself") {
  Random random(7);
  for (const Named& named : convex_solids()) {
    int lit = 0;
    for (const double size : {1e-90, 1e-30, 1e-9, 1e-5, 1.0, 3e6, 1e11, 1e30, 1e90}) {
      for (const Precision precision : {Precision::standard, Precision::exact}) {
        const Count count = compare_with_unhidden(lit_scene(named, size, precision, random));
        CAPTURE(named.name);
        CAPTURE(size);
        CHECK(count.wrong == 0);
        lit += count.lit;
      }
    }
    CHECK(lit > 2000);
  }
}

TEST_CASE("a lit convex solid far from the origin does not shadow itself either") {
  // The camera is 10^9 of its size away: positions have seven digits left, which light need not
  // notice.
  Random random(8);
  int lit = 0;
  for (const Named& named : convex_solids()) {
    for (const Precision precision : {Precision::standard, Precision::exact}) {
      Scene scene = lit_scene(named, 1, precision, random);
      const Vec3 away = 0x1p30 * Vec3(1, -1, 1);
      scene.entities[0] = scene.entities[0].transformed(translate(away));
      scene.lights = {ParallelLight{.from = random.direction(), .pointing = Vec3(0)}};
      scene.camera.position += away;
      scene.camera.pointing = away;
      const Count count = compare_with_unhidden(scene);
      CAPTURE(named.name);
      CHECK(count.wrong <= count.lit / 100);
      lit += count.lit;
    }
  }
  CHECK(lit > 1000);
}
