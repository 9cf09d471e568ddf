#include "core/geometry/plane/plane.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "geometry/oracle.hpp"

using namespace crt;
using namespace crt::test;

namespace {

Subject random_plane(Random& random) {
  const double size = random.power_of_ten(-6, 6);
  const Vec3 position = random.in_cube() * (size * random.power_of_ten(-2, 2));
  const Vec3 normal = random.direction() * random.power_of_ten(-9, 9);
  const RealVec n = normalized(RealVec(normal));
  const RealVec p0(position);
  return {.primitive = Plane{.normal = normal, .position = position},
          .center = position,
          .size = size,
          .candidates = [=](const RealRay& ray) { return plane_roots(ray, n, p0); },
          .field = [=](const RealVec& p) { return dot(n, p - p0); }};
}

bool crossings(const Plane& plane, const core::ObjectRay& ray, core::CrossingList& out) {
  out.clear();
  return core::make_shape(plane)->crossings(ray, out);
}

}  // namespace

TEST_CASE("plane: crossings are the true ones within their error") {
  check_against_oracle(random_plane, 100000);
}
TEST_CASE("plane: powers of two scale it to the bit") {
  check_scaling(random_plane, 2000);
}
TEST_CASE("plane: a ray turned round meets the same points") {
  check_reversal(random_plane, 20000);
}
TEST_CASE("plane: points, normals and (u, v)") {
  check_surface_points(random_plane, 10000, false);
}
TEST_CASE("plane: a ray that starts on it obeys its side") {
  check_starts(random_plane, 100000, true);
}

TEST_CASE(
    "plane: a ray comes from inside or goes there, and one parallel to it is where its origin is") {
  core::CrossingList list;
  CHECK(crossings(Plane{}, {.origin = {0, -5, 0}, .direction = {0, 1, 0}}, list));
  REQUIRE(list.size() == 1);
  CHECK(list[0].t == 5);
  CHECK_FALSE(list[0].entering);
  CHECK_FALSE(crossings(Plane{}, {.origin = {0, -5, 0}, .direction = {0, -1, 0}}, list));
  REQUIRE(list.size() == 1);
  CHECK(list[0].t == -5);
  CHECK(list[0].entering);
  CHECK(crossings(Plane{}, {.origin = {0, -1e-300, 0}, .direction = {1, 0, 0}}, list));
  CHECK(list.empty());
  CHECK_FALSE(crossings(Plane{}, {.origin = {0, 0, 0}, .direction = {1, 0, 0}}, list));
  CHECK(list.empty());
  const Plane slanted{.normal = {1, 1, 0}, .position = {1, 0, 0}};
  CHECK(crossings(slanted, {.origin = {0.25, 0.5, 9}, .direction = {1, -1, 7}}, list));
  CHECK_FALSE(crossings(slanted, {.origin = {0.25, 0.75, 9}, .direction = {1, -1, 7}}, list));
  CHECK(list.empty());
}

TEST_CASE("plane: a ray nearly parallel to it is met far away without losing its digits") {
  Random random(13);
  for (int i = 0; i < 20000; ++i) {
    const Subject subject = random_plane(random);
    const auto shape = core::make_shape(subject.primitive);
    const Vec3 normal = std::get<Plane>(subject.primitive).normal;
    const RealVec n = normalized(RealVec(normal));
    const core::PlaneAxes axes = core::plane_axes(normal);
    core::ObjectRay ray;
    ray.origin = subject.center + subject.size * random.in_cube();
    ray.direction = axes.u + random.uniform(-1, 1) * axes.v;
    ray.direction +=
        random.power_of_ten(-14, -3) *
        Vec3(static_cast<double>(n.x), static_cast<double>(n.y), static_cast<double>(n.z));
    core::CrossingList list;
    shape->crossings(ray, list);
    const auto roots = subject.candidates(RealRay(ray));
    REQUIRE(list.size() == roots.size());
    for (std::size_t k = 0; k < list.size(); ++k)
      REQUIRE(magnitude(list[k].t - roots[k]) <= list[k].error);
  }
}

TEST_CASE("plane: its surface has its own normal, and one position across an axis") {
  const core::Surface slanted =
      core::make_shape(Plane{.normal = {1, -4, 2}, .position = {1, 2, 3}})->surface(0);
  CHECK(slanted.direction == Vec3(0.25, -1, 0.5));
  CHECK(slanted.position == Vec3(1, 2, 3));
  const core::Surface axis =
      core::make_shape(Plane{.normal = {0, 0, -5}, .position = {7, 8, 9}})->surface(0);
  CHECK(axis.direction.z < 0);
  CHECK(axis.position == Vec3(0, 0, 9));
}

TEST_CASE("an axis is the same whatever its length and sense") {
  for (const double length : {1.0, -1.0, 3.0, -0.125}) {
    CHECK(core::canonical_axis(Vec3(1, -4, 2) * length) == Vec3(-0.25, 1, -0.5));
  }
}

TEST_CASE("plane: (u, v) are scene units along x and z on a floor, along x and y on a wall") {
  const auto at = [](const Vec3& normal, const Vec3& p) {
    const auto shape = core::make_shape(Plane{.normal = normal, .position = {1, 1, 1}});
    const core::ObjectRay ray{.origin = p, .direction = normal};
    core::CrossingList list;
    shape->crossings(ray, list);
    return shape->surface_point(ray, list.front());
  };
  CHECK(at({0, 1, 0}, {3, 8, 5}).u == 2);
  CHECK(at({0, 1, 0}, {3, 8, 5}).v == 4);
  CHECK(at({0, 0, -1}, {3, 8, 5}).u == 2);
  CHECK(at({0, 0, -1}, {3, 8, 5}).v == 7);
  CHECK(at({1, 0, 0}, {3, 8, 5}).u == 4);
  CHECK(at({1, 0, 0}, {3, 8, 5}).v == 7);
}

TEST_CASE("plane: only one across an axis is bounded") {
  const auto bounds = core::make_shape(Plane{.normal = {0, 2, 0}, .position = {1, 2, 3}})->bounds();
  CHECK(bounds.upper.y == 2);
  CHECK(bounds.lower.y < -1e308);
  CHECK(bounds.upper.x > 1e308);
  CHECK(core::make_shape(Plane{.normal = {0, -2, 0}, .position = {1, 2, 3}})->bounds().lower.y ==
        2);
  CHECK(core::make_shape(Plane{.normal = {0, 1, 1e-9}})->bounds().upper.y > 1e308);
}
