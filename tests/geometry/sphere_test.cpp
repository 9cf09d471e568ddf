#include "core/geometry/sphere/sphere.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "geometry/oracle.hpp"

using namespace crt;
using namespace crt::test;

namespace {

Subject random_sphere(Random& random) {
  const double radius = random.power_of_ten(-6, 6);
  const Vec3 center = random.in_cube() * (radius * random.power_of_ten(-2, 2));
  const RealVec c(center);
  const Real r = radius;
  return {.primitive = Sphere{.center = center, .radius = radius},
          .center = center,
          .size = radius,
          .candidates =
              [=](const RealRay& ray) {
                const RealVec o = ray.origin - c;
                return quadratic_roots(dot(ray.direction, ray.direction), dot(o, ray.direction),
                                       dot(o, o) - r * r);
              },
          .field = [=](const RealVec& p) { return length(p - c) - r; }};
}

core::CrossingList crossings(const Sphere& sphere, const core::ObjectRay& ray) {
  core::CrossingList result;
  core::make_shape(sphere)->crossings(ray, result);
  return result;
}

}  // namespace

TEST_CASE("sphere: crossings are the true ones within their error") {
  check_against_oracle(random_sphere, 100000);
}
TEST_CASE("sphere: powers of two scale it to the bit") {
  check_scaling(random_sphere, 2000);
}
TEST_CASE("sphere: a ray turned round meets the same points") {
  check_reversal(random_sphere, 20000);
}
TEST_CASE("sphere: points, normals and (u, v)") {
  check_surface_points(random_sphere, 10000, true);
}
TEST_CASE("sphere: a ray that starts on it obeys its side") {
  check_starts(random_sphere, 100000, true);
}

TEST_CASE("sphere: a tangent ray does not meet it") {
  CHECK(crossings(Sphere{}, {.origin = {1, 0, -5}, .direction = {0, 0, 1}}).empty());
  CHECK(crossings(Sphere{}, {.origin = {1 - 0x1p-53, 0, -5}, .direction = {0, 0, 1}}).size() == 2);
}

TEST_CASE("sphere: from 1e12 radii away the error stays within the last digits of t") {
  Random random(7);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 direction = random.direction();
    core::ObjectRay ray{.origin = -1e12 * direction + 0.5 * random.in_cube(),
                        .direction = direction};
    for (const core::Crossing& crossing : crossings(Sphere{}, ray)) {
      const RealRay real(ray);
      const RealVec p = real.at(crossing.t);
      const Real slope = 2 * magnitude(dot(p, real.direction));
      const double off = static_cast<double>(magnitude(dot(p, p) - 1) / slope);
      REQUIRE(off <= 0.51 * (std::nextafter(crossing.t, 1e300) - crossing.t) + 1e-7);
    }
  }
}

TEST_CASE("sphere: directions of any length meet it where the unit direction does") {
  for (const int exponent : {-498, -300, 1, 300, 498}) {
    const double length = std::ldexp(1.0, exponent);
    const auto unit =
        crossings(Sphere{}, {.origin = {0.1, 0.2, -5}, .direction = Vec3(0.01, 0.02, 1)});
    const auto scaled =
        crossings(Sphere{}, {.origin = {0.1, 0.2, -5}, .direction = Vec3(0.01, 0.02, 1) * length});
    REQUIRE(scaled.size() == 2);
    CHECK(scaled[0].t == unit[0].t / length);
    CHECK(scaled[1].error == unit[1].error / length);
  }
  CHECK(crossings(Sphere{}, {.origin = {0, 0, -5}, .direction = {0, 5e-324, 1}}).size() == 2);
}

TEST_CASE("sphere: the smallest and the largest may be seen from anywhere") {
  const auto tiny =
      crossings(Sphere{.radius = 1e-100}, {.origin = {0, 0, -1e100}, .direction = {0, 0, 1e-150}});
  CHECK(tiny.empty());  // closer to each other than t can resolve
  const auto near =
      crossings(Sphere{.radius = 1e-100}, {.origin = {0, 0, -1e-99}, .direction = {0, 0, 1e150}});
  REQUIRE(near.size() == 2);
  CHECK(near[0].t == doctest::Approx(9e-250));
  const auto huge =
      crossings(Sphere{.radius = 1e100}, {.origin = {0, 0, 0}, .direction = {0, 0, 1e-150}});
  REQUIRE(huge.size() == 2);
  CHECK(huge[1].t == doctest::Approx(1e250));
}

TEST_CASE("sphere: longitude and latitude") {
  const auto shape = core::make_shape(Sphere{});
  const auto at = [&](const Vec3& p) {
    const core::ObjectRay ray{.origin = 3.0 * p, .direction = -p};
    core::CrossingList list;
    shape->crossings(ray, list);
    return shape->surface_point(ray, list.front());
  };
  CHECK(at({0, 0, 1}).u == 0);
  CHECK(at({1, 0, 0}).u == 0.25);
  CHECK(at({0, 0, -1}).u == 0.5);
  CHECK(at({-1, 0, 0}).u == 0.75);
  CHECK(at({0, -1, 0}).v == 0);
  CHECK(at({1, 0, 0}).v == 0.5);
  CHECK(at({0, 1, 0}).v == 1);
}
