#include "core/geometry/half_plane/half_plane.hpp"

#include <doctest/doctest.h>

#include "geometry/oracle.hpp"

using namespace crt;
using namespace crt::test;

namespace {

Subject random_half_plane(Random& random) {
  const double size = random.power_of_ten(-6, 6);
  const Vec3 position = random.in_cube() * (size * random.power_of_ten(-2, 2));
  const Vec3 normal = random.direction() * random.power_of_ten(-9, 9);
  RealVec n = normalized(RealVec(normal));
  Vec3 direction = random.direction();
  while (length(cross(n, RealVec(direction))) < 0.01) direction = random.direction();
  direction *= random.power_of_ten(-9, 9);
  const RealVec p0(position);
  const RealVec d(direction);
  return {.primitive = HalfPlane{.normal = normal, .position = position, .direction = direction},
          .center = position,
          .size = size,
          .candidates = [=](const RealRay& ray) { return plane_roots(ray, n, p0); },
          .field = [=](const RealVec& p) { return dot(n, p - p0); },
          .on_surface = [=](const RealVec& p) { return dot(d - dot(n, d) * n, p - p0) >= 0; }};
}

}  // namespace

TEST_CASE("half plane: crossings are the true ones within their error") {
  check_against_oracle(random_half_plane, 100000);
}
TEST_CASE("half plane: powers of two scale it to the bit") {
  check_scaling(random_half_plane, 2000);
}
TEST_CASE("half plane: a ray turned round meets the same points") {
  check_reversal(random_half_plane, 20000);
}
TEST_CASE("half plane: points, normals and (u, v)") {
  check_surface_points(random_half_plane, 10000, false);
}
TEST_CASE("half plane: a ray that starts on it does not meet it again") {
  check_starts(random_half_plane, 50000, true);
}

TEST_CASE("half plane: only the side of its direction is there") {
  const auto shape = core::make_shape(HalfPlane{.position = {1, 0, 0}, .direction = {2, 7, 0}});
  core::CrossingList list;
  shape->crossings({.origin = {0.999, 3, 50}, .direction = {0, -1, 0}}, list);
  CHECK(list.empty());
  const core::ObjectRay ray{.origin = {1.5, 3, 50}, .direction = {0, -1, 0}};
  shape->crossings(ray, list);
  REQUIRE(list.size() == 1);
  CHECK(list[0].t == 3);
  CHECK(list[0].entering);
  CHECK(shape->surface_point(ray, list[0]).u == 0.5);
  CHECK(shape->surface_point(ray, list[0]).v == -50);
}

TEST_CASE("half plane: bounds know an edge along an axis") {
  const core::Bounds bounds =
      core::make_shape(HalfPlane{.position = {1, 2, 3}, .direction = {-1, 5, 0}})->bounds();
  CHECK(bounds.lower.y == 2);
  CHECK(bounds.upper.y == 2);
  CHECK(bounds.upper.x == 1);
  CHECK(bounds.lower.x < -1e308);
  CHECK(bounds.upper.z > 1e308);
}
