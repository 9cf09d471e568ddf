#include "core/geometry/disc/disc.hpp"

#include <doctest/doctest.h>

#include "geometry/oracle.hpp"

using namespace crt;
using namespace crt::test;

namespace {

Subject random_disc(Random& random) {
  const double radius = random.power_of_ten(-6, 6);
  const Vec3 center = random.in_cube() * (radius * random.power_of_ten(-2, 2));
  const Vec3 normal = random.direction() * random.power_of_ten(-9, 9);
  const RealVec n = normalized(RealVec(normal));
  const RealVec c(center);
  const Real r = radius;
  return {.primitive = Disc{.center = center, .normal = normal, .radius = radius},
          .center = center,
          .size = radius,
          .candidates = [=](const RealRay& ray) { return plane_roots(ray, n, c); },
          .field = [=](const RealVec& p) { return dot(n, p - c); },
          .on_surface = [=](const RealVec& p) { return length(p - c) <= r; }};
}

}  // namespace

TEST_CASE("disc: crossings are the true ones within their error") {
  check_against_oracle(random_disc, 100000);
}
TEST_CASE("disc: powers of two scale it to the bit") {
  check_scaling(random_disc, 2000);
}
TEST_CASE("disc: a ray turned round meets the same points") {
  check_reversal(random_disc, 20000);
}
TEST_CASE("disc: points, normals and (u, v)") {
  check_surface_points(random_disc, 10000, true);
}
TEST_CASE("disc: a ray that starts on it does not meet it again") {
  check_starts(random_disc, 50000, true);
}

TEST_CASE("disc: seen edge-on it is not met") {
  core::CrossingList list;
  core::make_shape(Disc{})->crossings({.origin = {-5, 0, 0}, .direction = {1, 0, 0}}, list);
  CHECK(list.empty());
}

TEST_CASE("disc: its box is flat across an axis and tight at any angle") {
  const core::Bounds flat =
      core::make_shape(Disc{.center = {1, 2, 3}, .normal = {0, 5, 0}, .radius = 2})->bounds();
  CHECK(flat.lower.y == 2);
  CHECK(flat.upper.y == 2);
  CHECK(flat.upper.x == doctest::Approx(3).epsilon(1e-14));
  const core::Bounds slanted = core::make_shape(Disc{.normal = {1, 1, 0}})->bounds();
  CHECK(slanted.upper.x == doctest::Approx(0.70710678118654752).epsilon(1e-14));
  CHECK(slanted.upper.z == doctest::Approx(1).epsilon(1e-14));
}

TEST_CASE("disc: angle and distance") {
  const auto shape = core::make_shape(Disc{.center = {0, 0, 0}, .normal = {0, 1, 0}, .radius = 2});
  const core::ObjectRay ray{.origin = {1, 5, 0}, .direction = {0, -1, 0}};
  const core::SurfacePoint point = shape->surface_point(ray, {.t = 5});
  CHECK(point.u == 0.25);
  CHECK(point.v == 0.5);
  CHECK(shape->surface_point({.origin = {0, 5, 0}, .direction = {0, -1, 0}}, {.t = 5}).u == 0);
}

TEST_CASE("disc: a ray that starts on its plane, on something else, meets it at 0 or not at all") {
  const auto shape = core::make_shape(Disc{.center = {1, 2, 3}, .normal = {1, 2, -1}});
  for (const core::Side side : {core::Side::outside, core::Side::inside}) {
    core::CrossingList list;
    core::ObjectRay ray{.origin = {1.5, 2, 3.5}, .direction = {1, 1, 1}};
    ray.start = {.face = 0, .side = side, .on_face = false};
    shape->crossings(ray, list);
    REQUIRE(list.size() == 1);
    CHECK(list[0].t == 0);
    CHECK(list[0].entering == (side == core::Side::inside));
    ray.origin = {3, 2, 5};
    list.clear();
    shape->crossings(ray, list);
    CHECK(list.empty());
  }
}
