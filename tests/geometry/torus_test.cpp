#include "core/geometry/torus/torus.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/oracle.hpp"
#include "geometry/torus_oracle.hpp"

using namespace crt;
using namespace crt::test;

namespace {

Subject torus_subject(const Torus& torus) {
  const RealVec center(torus.center);
  const RealVec axis = normalized(RealVec(torus.axis));
  const Real ring = torus.radius;
  const Real tube = torus.thickness;
  return {.primitive = torus,
          .center = torus.center,
          .size = torus.radius + torus.thickness,
          .candidates =
              [=](const RealRay& ray) { return torus_candidates(ray, center, axis, ring, tube); },
          .field =
              [=](const RealVec& p) {
                const RealVec q = p - center;
                const Real z = dot(q, axis);
                const Real out = length(cross(q, axis)) - ring;
                return square_root(out * out + z * z) - tube;
              }};
}

/// Returns rings, and sometimes a horn or a spindle.
Subject random_torus(Random& random) {
  const double radius = random.power_of_ten(-6, 6);
  const double share = random.one_in(4) ? random.uniform(1, 4)
                                        : (random.one_in(8) ? 1 : random.power_of_ten(-1.5, 0));
  return torus_subject({.center = random.in_cube() * (radius * random.power_of_ten(-2, 2)),
                        .axis = random.direction() * random.power_of_ten(-9, 9),
                        .radius = radius,
                        .thickness = radius * share});
}

core::CrossingList crossings(const Torus& torus, const core::ObjectRay& ray) {
  core::CrossingList result;
  core::make_shape(torus)->crossings(ray, result);
  return result;
}

}  // namespace

TEST_CASE("torus: crossings are the true ones within their error") {
  check_against_oracle(random_torus, 20000);
}
TEST_CASE("torus: powers of two scale it to the bit") {
  check_scaling(random_torus, 2000);
}
TEST_CASE("torus: a ray turned round meets the same points") {
  check_reversal(random_torus, 20000);
}
TEST_CASE("torus: points, normals and (u, v)") {
  check_surface_points(random_torus, 10000, true);
}
TEST_CASE("torus: a ray that starts on it obeys its side") {
  check_starts(random_torus, 100000, false);
}

TEST_CASE("torus: what is before the beginning of a ray only counts") {
  Random random(29);
  int before = 0;
  for (int i = 0; i < 50000; ++i) {
    const Subject subject = random_torus(random);
    const auto shape = core::make_shape(subject.primitive);
    core::ObjectRay ray;
    ray.direction = random.direction();
    ray.origin = subject.center + subject.size * random.in_cube() -
                 random.uniform(0, 2) * ray.direction * subject.size;
    core::CrossingList all;
    shape->crossings(ray, all);
    if (!all.empty() && !random.one_in(4)) {
      const core::SurfacePoint start = shape->surface_point(ray, all.back());
      ray.origin = start.position;
      ray.direction = random.direction();
      ray.start = {.face = 0, .side = random.one_in(2) ? core::Side::outside : core::Side::inside};
      all.clear();
      shape->crossings(ray, all);
    }
    ray.begin = 0;
    core::CrossingList found;
    shape->crossings(ray, found);
    REQUIRE(found.size() == all.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      REQUIRE(found[k].root == all[k].root);
      REQUIRE(found[k].entering == all[k].entering);
      REQUIRE((found[k].t < 0) == (all[k].t < 0));
      if (found[k].t < 0) {
        ++before;
        REQUIRE(std::abs(found[k].t - all[k].t) <= found[k].error);
      } else {
        REQUIRE(found[k].t == all[k].t);
        REQUIRE(found[k].error == all[k].error);
      }
    }
  }
  CHECK(before > 5000);
}

TEST_CASE("torus: thin rings are met as often as they are crossed") {
  Random random(31);
  int hits = 0;
  for (int i = 0; i < 4000; ++i) {
    const double thickness = random.power_of_ten(-7, -2);
    const Subject subject = torus_subject({.axis = random.direction(), .thickness = thickness});
    const auto shape = core::make_shape(subject.primitive);
    // The ray goes through a point of the ring, so that it hits it, thin as it is.
    const core::AxisFrame frame = core::frame_about(std::get<Torus>(subject.primitive).axis);
    const double angle = random.uniform(0, 6.3);
    const Vec3 target = std::cos(angle) * frame.zero + std::sin(angle) * frame.quarter +
                        random.uniform(-0.5, 0.5) * thickness * random.direction();
    const Vec3 direction = random.direction();
    const core::ObjectRay ray{.origin = target - direction * random.power_of_ten(-1, 3),
                              .direction = direction};
    core::CrossingList found;
    shape->crossings(ray, found);
    REQUIRE(found.size() % 2 == 0);
    REQUIRE(found.size() >= 2);
    for (const core::Crossing& crossing : found) {
      const RealRay real(ray);
      const Real off = magnitude(subject.field(real.at(crossing.t)));
      REQUIRE(off <= 1.01 * crossing.error);
      ++hits;
    }
  }
  CHECK(hits > 8000);
}

TEST_CASE("torus: rays through the middle and along the axis") {
  // A ring has four crossings across, and none through the hole.
  const Torus ring{};
  const auto across = crossings(ring, {.origin = {-5, 0, 0}, .direction = {1, 0, 0}});
  REQUIRE(across.size() == 4);
  CHECK(across[0].t == doctest::Approx(3.75).epsilon(1e-15));
  CHECK(across[1].t == doctest::Approx(4.25).epsilon(1e-15));
  CHECK(across[2].t == doctest::Approx(5.75).epsilon(1e-15));
  CHECK(across[3].root == 3);
  CHECK(crossings(ring, {.origin = {0, -5, 0}, .direction = {0, 1, 0}}).empty());
  CHECK(crossings(ring, {.origin = {1, -5, 0}, .direction = {0, 1, 0}}).size() == 2);
  CHECK(crossings(ring, {.origin = {0.75, -5, 0}, .direction = {0, 1, 0}}).empty());
  // A plane that lies on top of it touches a whole circle.
  CHECK(crossings(ring, {.origin = {-5, 0.25, 0.3}, .direction = {1, 0, 0}}).empty());
  // A horn is touched at its middle, and a spindle has no hollow.
  const Torus horn{.radius = 1, .thickness = 1};
  CHECK(crossings(horn, {.origin = {0, -5, 0}, .direction = {0, 1, 0}}).empty());
  const Torus spindle{.radius = 1, .thickness = 2};
  const auto through = crossings(spindle, {.origin = {0, -5, 0}, .direction = {0, 1, 0}});
  REQUIRE(through.size() == 2);
  CHECK(through[0].t == doctest::Approx(5 - std::sqrt(3.0)).epsilon(1e-15));
  CHECK(through[1].t == doctest::Approx(5 + std::sqrt(3.0)).epsilon(1e-15));
  const auto level = crossings(spindle, {.origin = {-5, 0, 0}, .direction = {1, 0, 0}});
  REQUIRE(level.size() == 2);
  CHECK(level[0].t == doctest::Approx(2).epsilon(1e-15));
}

TEST_CASE("torus: points on its axis and seams have finite coordinates") {
  const Torus spindle{.radius = 1, .thickness = 2};
  const auto shape = core::make_shape(spindle);
  const core::ObjectRay ray{.origin = {0, -5, 0}, .direction = {0, 1, 0}};
  for (const core::Crossing& crossing : crossings(spindle, ray)) {
    const core::SurfacePoint point = shape->surface_point(ray, crossing);
    CHECK(std::isfinite(point.u + point.v));
    CHECK(glm::length(point.normal) == doctest::Approx(1).epsilon(1e-15));
    CHECK((point.normal.y > 0) == !crossing.entering);
  }
  const core::SurfacePoint outermost = core::make_shape(Torus{})->surface_point(
      {.origin = {1.25, 0, 0}, .direction = {1, 0, 0}}, {});
  CHECK(outermost.u == 0.25);
  CHECK(outermost.v == 0);
  CHECK(outermost.normal == Vec3(1, 0, 0));
}

TEST_CASE("torus: its box is tight") {
  const core::Bounds bounds = core::make_shape(Torus{.axis = {0, 7, 0}})->bounds();
  CHECK(bounds.upper.x == doctest::Approx(1.25).epsilon(1e-14));
  CHECK(bounds.upper.y == doctest::Approx(0.25).epsilon(1e-14));
}

TEST_CASE("torus: extreme shapes give finite answers") {
  Random random(37);
  for (int i = 0; i < 5000; ++i) {
    const Torus torus{.axis = random.direction(),
                      .radius = random.power_of_ten(-100, 100),
                      .thickness = random.power_of_ten(-100, 100)};
    const auto shape = core::make_shape(torus);
    const core::ObjectRay ray{.origin = random.power_of_ten(-100, 100) * random.in_cube(),
                              .direction = random.direction() * random.power_of_ten(-150, 150)};
    core::CrossingList found;
    shape->crossings(ray, found);
    REQUIRE(found.size() % 2 == 0);
    for (const core::Crossing& crossing : found) {
      REQUIRE(std::isfinite(crossing.t));
      REQUIRE(std::isfinite(crossing.error));
      const core::SurfacePoint point = shape->surface_point(ray, crossing);
      REQUIRE(std::isfinite(glm::dot(point.normal, point.normal)));
      REQUIRE(std::isfinite(point.position.x + point.u + point.v));
    }
  }
}
