#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/exact_tools.hpp"

using namespace crt;
using namespace crt::test;

TEST_CASE("exact sphere: whole-number lines that miss, touch and hit are separated") {
  Random random(1);
  int touching = 0;
  int hits = 0;
  for (int i = 0; i < 40000; ++i) {
    const WholeRay ray = small_ray(random);
    const WholeVec center = small_vector(random, 4);
    const Whole radius = 1 + static_cast<Whole>(random.bits() % 6);
    const WholeVec offset = ray.origin - ray.weight * center;
    const Whole a = dot(ray.direction, ray.direction);
    const Whole b = dot(ray.direction, offset);
    const Whole c = dot(offset, offset) - ray.weight * ray.weight * radius * radius;
    const Whole discriminant = b * b - a * c;
    const core::CrossingList found = exact_crossings(
        Sphere{.center = as_vec3(center), .radius = static_cast<double>(radius)}, ray);
    REQUIRE(found.size() == (discriminant > 0 ? 2 : 0));
    touching += discriminant == 0 ? 1 : 0;
    if (found.empty()) continue;
    ++hits;
    const Real root = square_root(static_cast<Real>(discriminant));
    const Real q = b > 0 ? -(static_cast<Real>(b) + root) : root - static_cast<Real>(b);
    const Real one = q / static_cast<Real>(a);
    const Real other = static_cast<Real>(c) / q;
    REQUIRE(is_last_bit(found[0], one < other ? one : other));
    REQUIRE(is_last_bit(found[1], one < other ? other : one));
    REQUIRE(found[0].entering);
    REQUIRE_FALSE(found[1].entering);
  }
  CHECK(touching > 100);
  CHECK(hits > 5000);
}

TEST_CASE("exact sphere: one ulp decides at the silhouette, in a turned space as well") {
  // This turns by the triangle of three, four and five without rounding. The sphere becomes one of
  // radius 5.
  const Transform turn{{3, -4, 0}, {4, 3, 0}, {0, 0, 5}, {0, 0, 0}};
  for (const double far : {1.0, 1e3, 1e9, 1e15}) {
    for (const double side : {1.0, -1.0}) {
      const auto count = [&](double x) {
        return exact_crossings(Sphere{}, turn, {side * x, 4, -far}, {0, 0, 1}).size();
      };
      CHECK(count(3) == 0);
      CHECK(count(std::nextafter(3, 0)) == 2);
      CHECK(count(std::nextafter(3, 4)) == 0);
    }
    CHECK(exact_crossings(Sphere{}, {}, {1 - 0x1p-53, 0, -far}, {0, 0, 1}).size() == 2);
    CHECK(exact_crossings(Sphere{}, {}, {1, 0, -far}, {0, 0, 1}).empty());
    CHECK(exact_crossings(Sphere{}, {}, {1, 0x1p-1000, -far}, {0, 0, 1}).empty());
  }
}

TEST_CASE("exact sphere: t is right to the last bit at any distance, grazing too") {
  Random random(2);
  for (int i = 0; i < 30000; ++i) {
    const double radius = random.power_of_ten(-6, 6);
    const Vec3 center = random.in_cube() * (radius * random.power_of_ten(-2, 2));
    const Vec3 direction = random.direction();
    const double impact = random.one_in(2) ? 1 - random.power_of_ten(-12, 0) : random.uniform(0, 1);
    const Vec3 across = glm::normalize(glm::cross(direction, random.in_cube()));
    const Vec3 origin =
        center + across * (radius * impact) - direction * (radius * random.power_of_ten(-1, 6));
    const core::CrossingList found =
        exact_crossings(Sphere{.center = center, .radius = radius}, {}, origin, direction);
    const RealVec d(direction);
    const RealVec offset = RealVec(origin) - RealVec(center);
    // This is the distance of the line from the centre, in a form that quadruple precision is
    // enough for.
    const RealVec moment = cross(offset, d);
    const Real a = dot(d, d);
    const Real discriminant = a * Real{radius} * Real{radius} - dot(moment, moment);
    if (magnitude(discriminant) < 1e-20 * a * Real{radius} * Real{radius}) continue;
    REQUIRE(found.size() == (discriminant > 0 ? 2 : 0));
    if (found.empty()) continue;
    const Real half = square_root(discriminant);
    const Real ulp = std::nextafter(std::abs(found[0].t), HUGE_VAL) - std::abs(found[0].t);
    REQUIRE(magnitude(Real{found[0].t} - (-dot(offset, d) - half) / a) <= 0.51 * ulp);
  }
}

TEST_CASE("exact sphere: powers of two scale it to the bit") {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 center = random.in_cube();
    const Vec3 direction = random.direction();
    const Vec3 origin = random.in_cube() * 4.0;
    for (const int power : {-300, -1, 300}) {
      const double factor = std::ldexp(1.0, power);
      const auto here = exact_crossings(Sphere{.center = center}, {}, origin, direction);
      const auto there = exact_crossings(Sphere{.center = center * factor, .radius = factor}, {},
                                         origin * factor, direction);
      REQUIRE(here.size() == there.size());
      for (std::size_t k = 0; k < here.size(); ++k) REQUIRE(here[k].t * factor == there[k].t);
    }
  }
}

TEST_CASE("exact sphere: a ray that starts on it meets it again where the identity says") {
  Random random(4);
  for (int i = 0; i < 5000; ++i) {
    const Vec3 point = glm::normalize(random.in_cube());
    const Vec3 direction = random.direction();
    const bool inwards = glm::dot(point, direction) < 0;
    const core::FaceStart start{.face = 0,
                                .side = inwards ? core::Side::inside : core::Side::outside};
    const core::CrossingList found = exact_crossings(Sphere{}, {}, point, direction, start);
    const RealVec p(point);
    const RealVec d(direction);
    const Real other = -2 * dot(p, d) / dot(d, d);
    if (magnitude(other) < 1e-12) continue;
    REQUIRE(found.size() == 2);
    REQUIRE(found[inwards ? 0 : 1].t == 0);
    REQUIRE(is_last_bit(found[inwards ? 1 : 0], other));
  }
}
