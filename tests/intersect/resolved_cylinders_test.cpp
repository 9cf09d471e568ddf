// Cylinders and cones whose first crossings are found side by side (first_crossing.hpp) are
// compared with their shapes.
#include <doctest/doctest.h>

#include <cstdint>
#include <glm/geometric.hpp>
#include <utility>

#include "core/geometry/frustum/frustum.hpp"
#include "core/prepare/prepared_data.hpp"
#include "support/numbers.hpp"
#include "support/placed.hpp"
#include "support/same_answers.hpp"

using namespace crt;
using namespace crt::core;
using namespace crt::test;

namespace {

constexpr std::uint64_t seed = 20261123;

using PlacedCone = Placed<Cone>;

/// Returns a cone that is thin or flat. It is a cylinder, nearly one, blunt or pointed. It is not
/// moved, moved, turned, or scaled unevenly.
PlacedCone some_cone(Numbers& numbers, double scale) {
  const Vec3 from = scale * numbers.point(numbers.below(2) == 0 ? 1 : 1e3);
  const Vec3 axis = numbers.below(3) == 0 ? Vec3(0, 1, 0) : numbers.direction();
  const double length = scale * numbers.size(1e-2, 1);
  const double radius = length * numbers.size(1e-4, 1e2);
  const int kind = numbers.below(4);
  const double share = kind == 0   ? 1
                       : kind == 1 ? 1 - numbers.size(1e-15, 1e-2)
                       : kind == 2 ? numbers.within(0, 1)
                                   : 0;
  PlacedCone placed;
  placed.primitive = {
      .from = from, .to = from + length * axis, .radius = radius, .radius2 = share * radius};
  if (numbers.below(2) == 0) std::swap(placed.primitive.from, placed.primitive.to);
  placed.steps = some_steps(numbers, scale);
  return placed;
}

/// Returns a ray through its side or its caps, all but along its surface, or past it.
WorldRay ray_near(const PlacedCone& placed, Numbers& numbers) {
  const Cone& cone = placed.primitive;
  const Vec3 offset = cone.to - cone.from;
  const Vec3 axis = glm::normalize(offset);
  const Vec3 radial = glm::normalize(glm::cross(axis, numbers.direction()));
  const double share = numbers.below(4) == 0 ? numbers.size(1e-12, 0.1) : numbers.within(-0.1, 1.1);
  const double radius = cone.radius + share * (cone.radius2 - cone.radius);
  const double off = numbers.below(3) == 0   ? 1 + numbers.size(1e-17, 1e-2) * numbers.within(-1, 1)
                     : numbers.below(2) == 0 ? numbers.within(0, 1)
                                             : numbers.within(0, 2);
  Vec3 d = numbers.direction();
  if (numbers.below(4) == 0) d = d - glm::dot(d, radial) * radial;
  if (numbers.below(8) == 0) d = numbers.below(2) == 0 ? axis : radial;
  if (!(largest_component(d) > 0)) d = axis;
  return ray_through(placed, cone.from + share * offset + off * radius * radial, d,
                     glm::length(offset) + cone.radius, numbers);
}

void check_cones(Precision precision, int rounds) {
  Numbers numbers(seed);
  int met = 0;
  for (int round = 0; round < rounds; ++round) {
    const PlacedCone placed = some_cone(numbers, numbers.size(1e-9, 1e9));
    Scene scene;
    scene.settings.precision = precision;
    scene.entities = {placed.entity()};
    const Vec3 middle = 0.5 * (placed.primitive.from + placed.primitive.to);
    if (numbers.below(2) == 0) {
      scene.entities.emplace_back(
          Plane{.normal = numbers.direction(), .position = placed.to_place(middle)});
    }
    // This cone continues where the other ends, with a cap in common.
    PlacedCone next = placed;
    next.primitive.from = placed.primitive.to;
    next.primitive.to = 2.0 * placed.primitive.to - placed.primitive.from;
    if (numbers.below(2) == 0) scene.entities.push_back(next.entity());
    if (numbers.below(4) == 0) scene.entities.push_back(placed.entity());
    const PreparedData data(scene);
    check_bounces(
        data, numbers, 50, [&] { return ray_near(placed, numbers); }, met);
  }
  CHECK(met > 200 * rounds);
}

}  // namespace

TEST_CASE(
    "a ray finds the same alone, in a packet, and without cheap tests at cylinders and cones") {
  check_cones(Precision::standard, 600);
}

TEST_CASE("so it does at cylinders and cones in the exact tier") {
  check_cones(Precision::exact, 20);
}

TEST_CASE("most rays from the side of a cylinder are resolved, the same by lanes and alone") {
  Numbers numbers(seed);
  const auto cylinder = make_shape(Cylinder{.from = {1, 2, 3}, .to = {1, 4, 3}, .radius = 0.25});
  const Shape& shape = *cylinder;
  int resolved = 0;
  int missed = 0;
  constexpr int count = 4'000;
  for (int i = 0; i < count; ++i) {
    ObjectRayLanes rays{};
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const Vec3 level = Vec3(numbers.within(-1, 1), 0, numbers.within(-1, 1)) + Vec3(1e-3);
      const Vec3 d = glm::normalize(level + Vec3(0, 0.2 * numbers.within(-1, 1), 0));
      const Vec3 through(1 + numbers.within(-0.3, 0.3), 3 + numbers.within(-0.8, 0.8),
                         3 + numbers.within(-0.3, 0.3));
      rays.origin.set(lane, through - numbers.size(1, 100) * d);
      rays.direction.set(lane, d);
    }
    ShapeSpan<Lanes> entries;
    shape.span(rays, {lanes_with(15), LaneMask{}}, entries);
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const ObjectRay ray{.origin = rays.origin.lane(lane), .direction = rays.direction.lane(lane)};
      ShapeSpan<double> entry;
      shape.span(ray, {true, false}, entry);
      REQUIRE((entries.enter.known[lane] != 0) == entry.enter.known);
      REQUIRE((entries.misses[lane] != 0) == entry.misses);
      if (entry.enter.known) {
        REQUIRE(double{entries.enter.t[lane]} == entry.enter.t);
        REQUIRE(double{entries.enter.error[lane]} == entry.enter.error);
      }
      resolved += entry.enter.known ? 1 : 0;
      missed += entry.misses ? 1 : 0;
    }
  }
  CHECK(resolved > 2 * count);
  CHECK(resolved + missed > 3.5 * count);
}
