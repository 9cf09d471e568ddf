#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/geometry/rounded_box/rounded_box.hpp"
#include "geometry/exact_tools.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Returns the sign of r less the distance of the line from a box, for whole numbers: 1 if the line
/// passes through the rounded box, 0 if it touches, -1 if it misses. The distance is least at a
/// plane of the box, or where the line is nearest to an edge, a corner or a face between.
int side_of_line(const WholeRay& ray, const WholeVec& lower, const WholeVec& upper, Whole radius) {
  int best = -1;
  const WholeVec& d = ray.direction;
  // The place is numerator / denominator, with denominator > 0.
  const auto look_at = [&](Whole numerator, Whole denominator) {
    Whole squared = 0;
    const Whole scale = ray.weight * denominator;
    for (std::size_t i = 0; i < 3; ++i) {
      const Whole p = ray.origin[i] * denominator + numerator * d[i];
      const Whole below = lower[i] * scale - p;
      const Whole above = p - upper[i] * scale;
      const Whole beyond = std::max<Whole>({below, above, 0});
      squared += beyond * beyond;
    }
    const Whole difference = radius * scale * radius * scale - squared;
    best = std::max(best, difference > 0 ? 1 : (difference < 0 ? -1 : 0));
  };
  for (std::size_t i = 0; i < 3; ++i) {
    if (d[i] == 0) continue;
    const Whole sign = d[i] > 0 ? 1 : -1;
    look_at(sign * (lower[i] * ray.weight - ray.origin[i]), sign * d[i]);
    look_at(sign * (upper[i] * ray.weight - ray.origin[i]), sign * d[i]);
  }
  for (int parts = 0; parts < 27; ++parts) {
    const int sides[] = {parts % 3, parts / 3 % 3, parts / 9};
    Whole speed = 0;
    Whole rate = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (sides[i] == 2) continue;
      const Whole corner = (sides[i] == 0 ? lower : upper)[i];
      speed += d[i] * d[i];
      rate += (ray.origin[i] - ray.weight * corner) * d[i];
    }
    if (speed > 0) look_at(-rate, speed);
  }
  return best;
}

}  // namespace

TEST_CASE("exact rounded box: whole-number lines that miss, touch and hit are separated") {
  Random random(1);
  int touching = 0;
  int hits = 0;
  for (int i = 0; i < 60000; ++i) {
    const WholeRay ray = small_ray(random);
    const WholeVec lower = small_vector(random, 4);
    WholeVec upper = lower;
    for (Whole& coordinate : upper) coordinate += static_cast<Whole>(random.bits() % 4);
    const Whole radius = 1 + static_cast<Whole>(random.bits() % 4);
    const double r = static_cast<double>(radius);
    const core::CrossingList found = exact_crossings(
        RoundedBox{.corner_a = as_vec3(lower) - r, .corner_b = as_vec3(upper) + r, .radius = r},
        ray);
    const int side = side_of_line(ray, lower, upper, radius);
    REQUIRE(found.size() == (side > 0 ? 2 : 0));
    touching += side == 0 ? 1 : 0;
    hits += side > 0 ? 1 : 0;
    if (found.empty()) continue;
    REQUIRE(found[0].entering);
    REQUIRE_FALSE(found[1].entering);
  }
  CHECK(touching > 100);
  CHECK(hits > 5000);
}

TEST_CASE("exact rounded box: a line through a seam belongs to the face where it is before") {
  const RoundedBox box{.corner_a = {-5, -5, -5}, .corner_b = {7, 9, 6}, .radius = 5};
  // The inner box is from 0 to (2, 4, 1). Each line passes (-3, 0, -4), on the seam of the edge
  // along y and a corner.
  const auto through = [&](const Vec3& direction) {
    return exact_crossings(box, {}, Vec3(-3, 0, -4) - 8.0 * direction, direction);
  };
  const auto upwards = through({1, 0.25, 0});
  REQUIRE(upwards.size() == 2);
  CHECK(upwards[0].t == 8);
  CHECK(upwards[0].face == 10);
  const auto downwards = through({1, -0.25, 0});
  REQUIRE(downwards.size() == 2);
  CHECK(downwards[0].t == 8);
  CHECK(downwards[0].face == 18);
  // The tangent plane there holds these.
  CHECK(through({0, 1, 0}).empty());
  CHECK(through({4, 0, -3}).empty());
  CHECK(through({4, 1, -3}).empty());
}

TEST_CASE("exact rounded box: one ulp decides along a face and along an edge") {
  const RoundedBox box{.corner_a = {-1, 0, -1}, .corner_b = {1, 4, 1}, .radius = 0.5};
  for (const double far : {1.0, 1e3, 1e9, 1e15}) {
    for (const double z : {0.0, 0.5}) {
      CHECK(exact_crossings(box, {}, {1, -far, z}, {0, 1, 0}).empty());
      const auto inside = exact_crossings(box, {}, {1 - 0x1p-53, -far, z}, {0, 1, 0});
      REQUIRE(inside.size() == 2);
      const Real beside = Real(0.5) - Real(0x1p-53);
      const Real depth = Real(0.5) - square_root(Real(0.25) - beside * beside);
      CHECK(is_last_bit(inside[0], Real(far) + depth));
      CHECK(is_last_bit(inside[1], Real(far) + 4 - depth));
    }
  }
}

TEST_CASE("exact rounded box: the inner box is not rounded") {
  // 0.1 + 0.2 is no double. So neither is the inner box, and the edges have their center there.
  const RoundedBox box{.corner_a = {0.1, 0.1, 0}, .corner_b = {3, 3, 9}, .radius = 0.2};
  const Real center = Real(0.1) + Real(0.2);
  for (const double z : {4.0, 5.0}) {
    const double height = 0.15;
    const auto found = exact_crossings(box, {}, {-1, height, z}, {1, 0, 0});
    REQUIRE(found.size() == 2);
    const Real beside = center - Real(height);
    const Real chord = square_root(Real(0.2) * Real(0.2) - beside * beside);
    CHECK(is_last_bit(found[0], center - chord + 1));
  }
}

TEST_CASE("exact rounded box: a ray that starts on it has a root at 0 and another beyond") {
  Random random(4);
  const RoundedBox box{.corner_a = {-1, -1, -1}, .corner_b = {1, 2, 1.5}, .radius = 0.4};
  int starts = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 aim = Vec3(0, 0.5, 0.25) + 1.5 * random.in_cube();
    const Vec3 first = random.direction();
    for (const core::Crossing& crossing : exact_crossings(box, {}, aim - 5.0 * first, first)) {
      const core::ObjectRay ray{.origin = aim - 5.0 * first, .direction = first};
      const core::SurfacePoint point = core::make_shape(box)->surface_point(ray, crossing);
      const Vec3 direction = random.direction();
      const bool inwards = glm::dot(point.normal, direction) < 0;
      const core::FaceStart start{.face = crossing.face,
                                  .side = inwards ? core::Side::inside : core::Side::outside};
      const auto found = exact_crossings(box, {}, point.position, direction, start);
      REQUIRE((found.size() == 2 || (found.empty() && !inwards)));
      if (found.empty()) continue;
      REQUIRE(found[inwards ? 0 : 1].t == 0);
      REQUIRE(found[inwards ? 0 : 1].face == crossing.face);
      const core::Crossing& other = found[inwards ? 1 : 0];
      REQUIRE(other.t * (inwards ? 1 : -1) > 0);
      const core::ObjectRay plain{.origin = point.position, .direction = direction, .start = start};
      core::CrossingList standard;
      core::make_shape(box)->crossings(plain, standard);
      REQUIRE(standard.size() == 2);
      const core::Crossing& rounded = standard[inwards ? 1 : 0];
      REQUIRE(std::abs(rounded.t - other.t) <= rounded.error + other.error);
      ++starts;
    }
  }
  CHECK(starts > 10000);
}

TEST_CASE("exact rounded box: if only the first crossing is asked for, it is the same") {
  Random random(5);
  const RoundedBox box{.corner_a = {-1, -1, -1}, .corner_b = {1, 2, 1.5}, .radius = 0.75};
  const auto shape = core::make_exact_shape(box);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 direction = random.direction();
    core::ObjectRay near{.origin = 2.0 * random.in_cube() - random.uniform(-1, 3) * direction,
                         .direction = direction};
    const core::ExactRay ray{
        .near = near, .world_origin = near.origin, .world_direction = near.direction};
    core::CrossingList all;
    shape->crossings(ray, all);
    near.first_wanted_after = random.uniform(-2, 2);
    core::CrossingList first;
    shape->crossings(ray, first);
    REQUIRE(first.size() <= all.size());
    const bool is_enough = !all.empty() && near.is_first_wanted(all[0]);
    if (!is_enough) REQUIRE(first.size() == all.size());
    for (std::size_t k = 0; k < first.size(); ++k) {
      REQUIRE(first[k].t == all[k].t);
      REQUIRE(first[k].face == all[k].face);
    }
  }
}
