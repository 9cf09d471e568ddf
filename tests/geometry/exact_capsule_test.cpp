#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/exact_tools.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Returns the sign of r less the distance of the line from the segment, for whole numbers: 1 if
/// the line passes through the capsule, 0 if it touches, -1 if it misses.
int side_of_line(const WholeRay& ray, const WholeVec& from, const WholeVec& to, Whole radius) {
  const auto sign = [](Whole x) { return x > 0 ? 1 : (x < 0 ? -1 : 0); };
  const WholeVec& d = ray.direction;
  const WholeVec axis = to - from;
  const WholeVec w = ray.weight * from - ray.origin;
  const WholeVec m = cross(d, axis);
  const Whole squared_m = dot(m, m);
  const Whole scaled = ray.weight * radius;
  // The line is nearest to the endless axis at this share of it, times m^2 and the weight.
  const Whole share = squared_m == 0 ? -1 : dot(cross(w, d), m);
  if (share > 0 && share < squared_m * ray.weight) {
    const Whole distance = dot(w, m);
    return sign(scaled * scaled * squared_m - distance * distance);
  }
  int best = -1;
  for (const WholeVec& end : {from, to}) {
    const WholeVec moment = cross(ray.weight * end - ray.origin, d);
    best = std::max(best, sign(scaled * scaled * dot(d, d) - dot(moment, moment)));
  }
  return best;
}

}  // namespace

TEST_CASE("exact capsule: whole-number lines that miss, touch and hit are separated") {
  Random random(1);
  int touching = 0;
  int hits = 0;
  for (int i = 0; i < 60000; ++i) {
    const WholeRay ray = small_ray(random);
    const WholeVec from = small_vector(random, 4);
    const WholeVec to = small_vector(random, 4);
    if (from == to) continue;
    const Whole radius = 1 + static_cast<Whole>(random.bits() % 5);
    const core::CrossingList found = exact_crossings(
        Capsule{.from = as_vec3(from), .to = as_vec3(to), .radius = static_cast<double>(radius)},
        ray);
    const int side = side_of_line(ray, from, to, radius);
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

TEST_CASE("exact capsule: a line through a seam belongs to the side where it goes on between") {
  const Capsule capsule{.from = {0, 0, 0}, .to = {0, 4, 0}, .radius = 5};
  // Each line passes (-3, 0, 4) exactly, which is on the seam at `from`.
  const auto through = [&](const Vec3& direction) {
    return exact_crossings(capsule, {}, Vec3(-3, 0, 4) - 8.0 * direction, direction);
  };
  const auto upwards = through({1, 0.25, 0});
  REQUIRE(upwards.size() == 2);
  CHECK(upwards[0].t == 8);
  CHECK(upwards[0].face == 0);
  const auto downwards = through({1, -0.25, 0});
  REQUIRE(downwards.size() == 2);
  CHECK(downwards[0].t == 8);
  CHECK(downwards[0].face == 1);
  const auto level = through({1, 0, 0});
  REQUIRE(level.size() == 2);
  CHECK(level[0].face == 1);
  CHECK(level[0].t == 8);
  CHECK(level[1].t == 14);
  // The tangent plane there holds these.
  CHECK(through({0, 1, 0}).empty());
  CHECK(through({4, 0, 3}).empty());
  CHECK(through({4, 1, 3}).empty());
}

TEST_CASE("exact capsule: one ulp decides along the side") {
  const Capsule capsule{.from = {0, 0, 0}, .to = {0, 4, 0}, .radius = 1};
  for (const double far : {1.0, 1e3, 1e9, 1e15}) {
    CHECK(exact_crossings(capsule, {}, {1, -far, 0}, {0, 1, 0}).empty());
    CHECK(exact_crossings(capsule, {}, {1, -far, 0x1p-1000}, {0, 1, 0}).empty());
    const auto inside = exact_crossings(capsule, {}, {1 - 0x1p-53, -far, 0}, {0, 1, 0});
    REQUIRE(inside.size() == 2);
    CHECK(inside[0].face == 1);
    CHECK(inside[1].face == 2);
    const Real depth = square_root(1 - Real(1 - 0x1p-53) * Real(1 - 0x1p-53));
    CHECK(is_last_bit(inside[0], Real(far) - depth));
    CHECK(is_last_bit(inside[1], Real(far) + 4 + depth));
  }
}

TEST_CASE("exact capsule: where two spheres all but coincide, the outer one is crossed") {
  // The line is below the seam at `from`, where the sphere about it holds all of the other. The two
  // cross the line at places that no double-double separates.
  const Capsule capsule{.from = {0, 0, 0}, .to = {0, 0x1p-200, 0}, .radius = 1};
  for (const double height : {-0.5, -0x1p-100}) {
    const auto found = exact_crossings(capsule, {}, {-2, height, 0}, {1, 0, 0});
    REQUIRE(found.size() == 2);
    CHECK(found[0].face == 1);
    CHECK(found[1].face == 1);
  }
  const auto above = exact_crossings(capsule, {}, {-2, 0.5, 0}, {1, 0, 0});
  REQUIRE(above.size() == 2);
  CHECK(above[0].face == 2);
  CHECK(above[1].face == 2);
}

TEST_CASE("exact capsule: a ray that starts on it has a root at 0 and the other at the last bit") {
  Random random(4);
  const Capsule capsule{.from = {0, 0, 0}, .to = {0, 3, 0}, .radius = 1};
  int starts = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 aim = Vec3(0, 1.5, 0) + 2.0 * random.in_cube();
    const Vec3 first = random.direction();
    for (const core::Crossing& crossing : exact_crossings(capsule, {}, aim - 5.0 * first, first)) {
      const core::ObjectRay ray{.origin = aim - 5.0 * first, .direction = first};
      const core::SurfacePoint point = core::make_shape(capsule)->surface_point(ray, crossing);
      const Vec3 direction = random.direction();
      const bool inwards = glm::dot(point.normal, direction) < 0;
      const core::FaceStart start{.face = crossing.face,
                                  .side = inwards ? core::Side::inside : core::Side::outside};
      const auto found = exact_crossings(capsule, {}, point.position, direction, start);
      REQUIRE((found.size() == 2 || (found.empty() && !inwards)));
      if (found.empty()) continue;
      REQUIRE(found[inwards ? 0 : 1].t == 0);
      REQUIRE(found[inwards ? 0 : 1].face == crossing.face);
      REQUIRE(found[inwards ? 1 : 0].t * (inwards ? 1 : -1) > 0);
      ++starts;
    }
  }
  CHECK(starts > 10000);
}

TEST_CASE("exact capsule: if only the first crossing is asked for, it is the same") {
  Random random(5);
  const Capsule capsule{.from = {0, 0, 0}, .to = {1, 2, 0}, .radius = 0.75};
  const auto shape = core::make_exact_shape(capsule);
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
