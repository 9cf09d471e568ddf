#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/exact_tools.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// This torus is about the z axis, with a ring of radius 2.
const Torus ring{.center = {0, 0, 0}, .axis = {0, 0, 1}, .radius = 2, .thickness = 1};

std::size_t count(const Torus& torus, const Vec3& origin, const Vec3& direction,
                  const Transform& to_world = {}) {
  const core::CrossingList found = exact_crossings(torus, to_world, origin, direction);
  for (std::size_t i = 0; i < found.size(); ++i) {
    CHECK(found[i].entering == (i % 2 == 0));
    if (i > 0) CHECK(found[i - 1].t <= found[i].t);
  }
  return found.size();
}

}  // namespace

TEST_CASE("exact torus: lines that touch it miss, and an ulp decides") {
  for (const double far : {1.0, 1e3, 1e9, 1e15}) {
    CAPTURE(far);
    // These go over the top of the ring, along a tangent of the circle of highest points and across
    // it.
    const auto over = [&](double z) { return count(ring, {2, -far, z}, {0, 1, 0}); };
    CHECK(over(1) == 0);
    CHECK(over(std::nextafter(1, 2)) == 0);
    CHECK(over(std::nextafter(1, 0)) == 2);
    const auto across = [&](double z) { return count(ring, {-far, 0, z}, {1, 0, 0}); };
    CHECK(across(1) == 0);
    CHECK(across(std::nextafter(1, 0)) == 4);
    // These are in the plane of the ring, past its outside, and past the hole.
    const auto past = [&](double x) { return count(ring, {x, -far, 0}, {0, 1, 0}); };
    CHECK(past(3) == 0);
    CHECK(past(std::nextafter(3, 0)) == 2);
    CHECK(past(1) == 2);
    CHECK(past(std::nextafter(1, 2)) == 2);
    CHECK(past(std::nextafter(1, 0)) == 4);
    // These are along the axis, touching the hole from within.
    const auto down = [&](double x) { return count(ring, {x, 0, far}, {0, 0, -1}); };
    CHECK(down(1) == 0);
    CHECK(down(std::nextafter(1, 0)) == 0);
    CHECK(down(std::nextafter(1, 2)) == 2);
  }
}

TEST_CASE("exact torus: a span of next to no length is found") {
  // From the highest circle the line goes along the top, and into the tube by next to nothing.
  for (const double dip : {1e-30, 1e-119, 1e-122, 1e-200, 1e-280}) {
    CAPTURE(dip);
    CHECK(count(ring, {2, 0, 1}, {1, 0.3, -dip}) == 2);
    // The other way it also comes into the tube on the other side of the ring.
    CHECK(count(ring, {2, 0, 1}, {1, 0.3, dip}) == 4);
  }
  CHECK(count(ring, {2, 0, 1}, {1, 0.3, 0}) == 0);
}

TEST_CASE("exact torus: the same in a turned space") {
  const Transform turn{
      {3, -4, 0}, {4, 3, 0}, {0, 0, 5}, {0, 0, 0}};  // a turn by the triangle of three, four and
                                                     // five, and a scaling by five
  for (const double far : {1.0, 1e9}) {
    const auto past = [&](double x) { return count(ring, {x, -far, 0}, {0, 1, 0}, turn); };
    CHECK(past(15) == 0);
    CHECK(past(std::nextafter(15, 0)) == 2);
    CHECK(past(5) == 2);
    CHECK(past(std::nextafter(5, 0)) == 4);
  }
}

TEST_CASE("exact torus: a spindle is filled, and its dimples are met at their tips") {
  const Torus spindle{.center = {0, 0, 0}, .axis = {0, 0, 1}, .radius = 3, .thickness = 5};
  // On the axis the surface is at z = 4 and -4.
  const core::CrossingList axis = exact_crossings(spindle, {}, {0, 0, 10}, {0, 0, -1});
  REQUIRE(axis.size() == 2);
  CHECK(axis[0].t == 6);
  CHECK(axis[1].t == 14);
  CHECK(count(spindle, {-20, 0, 4}, {1, 0, 0}) == 2);  // touches the tip of the dimple
  CHECK(count(spindle, {-20, 0, std::nextafter(4, 0)}, {1, 0, 0}) == 2);
  CHECK(count(spindle, {-20, 0, std::nextafter(4, 5)}, {1, 0, 0}) == 4);
  CHECK(count(spindle, {-20, 0, 0}, {1, 0, 0}) == 2);
}

TEST_CASE("exact torus: powers of two scale it to the bit") {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Torus torus{.center = random.in_cube(),
                      .axis = random.direction(),
                      .radius = random.uniform(0.3, 1),
                      .thickness = random.uniform(0.1, 1)};
    const Vec3 direction = random.direction();
    const Vec3 origin = random.in_cube() * 4.0;
    const auto here = exact_crossings(torus, {}, origin, direction);
    for (const int power : {-300, -1, 300}) {
      const double factor = std::ldexp(1.0, power);
      const Torus scaled{.center = torus.center * factor,
                         .axis = torus.axis,
                         .radius = torus.radius * factor,
                         .thickness = torus.thickness * factor};
      const auto there = exact_crossings(scaled, {}, origin * factor, direction);
      REQUIRE(here.size() == there.size());
      for (std::size_t k = 0; k < here.size(); ++k) REQUIRE(here[k].t * factor == there[k].t);
    }
  }
}

TEST_CASE("exact torus: t is where G vanishes, to the last bit") {
  Random random(2);
  int hits = 0;
  for (int i = 0; i < 4000; ++i) {
    const Torus torus{.center = random.in_cube(),
                      .axis = {0, 0, 1},
                      .radius = random.uniform(0.3, 1),
                      .thickness = random.power_of_ten(-3, 0)};
    const Vec3 origin = random.in_cube() * random.power_of_ten(0, 6);
    const Vec3 direction = torus.center + random.in_cube() - origin;
    const auto level = [&](Real t) {
      const RealVec p = RealVec(origin) - RealVec(torus.center) + t * RealVec(direction);
      const Real outward = square_root(p.x * p.x + p.y * p.y) - Real{torus.radius};
      return outward * outward + p.z * p.z - Real{torus.thickness} * Real{torus.thickness};
    };
    for (const core::Crossing& crossing : exact_crossings(torus, {}, origin, direction)) {
      ++hits;
      const Real ulp = std::nextafter(std::abs(crossing.t), HUGE_VAL) - std::abs(crossing.t);
      const Real before = level(Real{crossing.t} - 0.51 * ulp);
      const Real after = level(Real{crossing.t} + 0.51 * ulp);
      // A grazing line has both its crossings within an ulp.
      if ((before < 0) == (after < 0))
        CHECK(magnitude(before) < 1e-12);
      else
        CHECK((before > 0) == crossing.entering);
    }
  }
  CHECK(hits > 1500);
}

TEST_CASE("exact torus: a ray that starts on it meets the rest as the standard tier has it") {
  Random random(3);
  int compared = 0;
  for (int i = 0; i < 5000; ++i) {
    const double u = random.uniform(0, 6.28);
    const double v = random.uniform(0, 6.28);
    const Vec3 normal{std::cos(u) * std::cos(v), std::sin(u) * std::cos(v), std::sin(v)};
    const Vec3 point = Vec3(2 * std::cos(u), 2 * std::sin(u), 0) + normal;
    const Vec3 direction = random.direction();
    if (std::abs(glm::dot(direction, normal)) < 1e-6) continue;
    core::ObjectRay ray{.origin = point, .direction = direction};
    ray.start = {
        .face = 0,
        .side = glm::dot(direction, normal) < 0 ? core::Side::inside : core::Side::outside};
    core::CrossingList standard;
    core::make_shape(ring)->crossings(ray, standard);
    const core::CrossingList found = exact_crossings(ring, {}, point, direction, ray.start);
    REQUIRE(found.size() == standard.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      REQUIRE(found[k].entering == standard[k].entering);
      REQUIRE((found[k].t == 0) == (standard[k].t == 0));
      REQUIRE(std::abs(found[k].t - standard[k].t) <= standard[k].error + 1e-12);
      ++compared;
    }
  }
  CHECK(compared > 5000);
}
