// Spheres that have a transform, and whose first crossings are found by first_crossing.hpp, are
// compared with their shapes.
#include <doctest/doctest.h>

#include <cstdint>
#include <glm/geometric.hpp>

#include "core/compile/compile.hpp"
#include "core/intersect/filter_rays.hpp"
#include "core/prepare/prepared_data.hpp"
#include "support/numbers.hpp"
#include "support/placed.hpp"
#include "support/same_answers.hpp"

using namespace crt;
using namespace crt::core;
using namespace crt::test;

namespace {

constexpr std::uint64_t seed = 20261123;

using PlacedSphere = Placed<Sphere>;

/// Returns a sphere about the origin, or anywhere.
PlacedSphere some_sphere(Numbers& numbers, double scale) {
  PlacedSphere placed;
  placed.primitive.radius = scale * numbers.size(1e-2, 1);
  placed.primitive.center = numbers.below(2) == 0 ? Vec3(0) : scale * numbers.point(10);
  placed.steps = some_steps(numbers, scale);
  // Its centre may have all its digits then.
  if (numbers.below(4) == 0) placed.steps = {translate(scale * glm::round(numbers.point(9)))};
  return placed;
}

/// Returns a ray through the sphere, all but beside it, or past it.
WorldRay ray_near(const PlacedSphere& placed, Numbers& numbers) {
  const Sphere& sphere = placed.primitive;
  const Vec3 d = numbers.direction();
  const Vec3 across = glm::normalize(glm::cross(d, numbers.direction()));
  const double off = numbers.below(3) == 0   ? 1 + numbers.size(1e-17, 1e-3) * numbers.within(-1, 1)
                     : numbers.below(2) == 0 ? numbers.within(0, 1)
                                             : numbers.within(0, 2);
  return ray_through(placed, sphere.center + off * sphere.radius * across, d, sphere.radius,
                     numbers);
}

void check_spheres(Precision precision, int rounds) {
  Numbers numbers(seed);
  int met = 0;
  for (int round = 0; round < rounds; ++round) {
    const double scale = numbers.size(1e-30, 1e30);
    const PlacedSphere placed = some_sphere(numbers, scale);
    Scene scene;
    scene.settings.precision = precision;
    scene.entities = {placed.entity()};
    const Vec3 center = placed.to_place(placed.primitive.center);
    if (numbers.below(2) == 0) {
      scene.entities.emplace_back(Plane{.normal = numbers.direction(), .position = center});
    }
    if (numbers.below(4) == 0) scene.entities.push_back(placed.entity());
    if (numbers.below(2) == 0) {
      PlacedSphere other = placed;
      other.primitive.center += placed.primitive.radius * numbers.direction();
      scene.entities.push_back(other.entity());
    }
    const PreparedData data(scene);
    check_bounces(
        data, numbers, 50, [&] { return ray_near(placed, numbers); }, met);
  }
  CHECK(met > 200 * rounds);
}

/// Returns whether the proxy of an object resolves its crossings.
bool is_resolved(const Entity& entity) {
  const Entity entities[] = {entity};
  const CompiledScene scene = compile(entities);
  const std::uint32_t first[] = {0};
  const BoundingProxies proxies(scene, first);
  return proxies.list.front().leaf != nullptr;
}

}  // namespace

TEST_CASE("a ray finds the same alone, in a packet, and without cheap tests at moved spheres") {
  check_spheres(Precision::standard, 300);
}

TEST_CASE("so it does at moved spheres in the exact tier") {
  check_spheres(Precision::exact, 20);
}

TEST_CASE("spheres are resolved however they are moved") {
  const Entity sphere = Sphere{.center = {0, 0, 0}, .radius = 1};
  const Entity beside = Sphere{.center = {0.1, 0.7, 0}, .radius = 1};
  for (const Entity& entity : {sphere, beside}) {
    CHECK(is_resolved(entity));
    CHECK(is_resolved(entity.transformed(translate({0.1, 0.2, 0.3}))));
    CHECK(is_resolved(
        entity.transformed(scale(Vec3(1, 2, 3))).transformed(rotate_degrees(Vec3(10, 20, 30)))));
  }
}
