#include "core/geometry/extrusion/extrusion.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/vector.hpp"
#include "geometry/exact_tools.hpp"
#include "geometry/line_checks.hpp"
#include "geometry/profiles.hpp"

using namespace crt;
using namespace crt::test;

namespace {

Subject subject_of(const Extrusion& extrusion, double size) {
  const RealProfile profile(extrusion.profile);
  const double lower = std::min(extrusion.from, extrusion.to);
  const double upper = std::max(extrusion.from, extrusion.to);
  const core::Bounds& bounds = extrusion.profile->bounds();
  return {.primitive = extrusion,
          .center = {0.5 * bounds.lower.x + 0.5 * bounds.upper.x,
                     0.5 * bounds.lower.y + 0.5 * bounds.upper.y, 0.5 * lower + 0.5 * upper},
          .size = size,
          .candidates =
              [=](const RealRay& ray) {
                std::vector<Real> all = profile.candidates(ray);
                for (const double height : {lower, upper}) {
                  const auto roots = plane_roots(ray, {0, 0, 1}, {0, 0, height});
                  all.insert(all.end(), roots.begin(), roots.end());
                }
                return all;
              },
          .field =
              [=](const RealVec& p) {
                const Real aside = profile.distance(p);
                const Real above = std::max(Real{lower} - p.z, p.z - Real{upper});
                return std::max(profile.contains(p) ? -aside : aside, above);
              }};
}

Subject random_extrusion(Random& random) {
  const double size = random.power_of_ten(-4, 4);
  const double from = size * random.uniform(-2, 2);
  return subject_of({.profile = make_profile(random_contours(random, size)),
                     .from = from,
                     .to = from + size * random.uniform(-1, 1)},
                    2 * size);
}

Extrusion whole_extrusion(Random& random) {
  const double from = std::floor(random.uniform(-3, 3));
  return {.profile = make_profile(whole_contours(random)),
          .from = from,
          .to = from + 1 + std::floor(random.uniform(0, 4))};
}

/// Checks that two solids are crossed at the same bits, in both tiers.
void check_equal(const Primitive& a, const Primitive& b, const core::ObjectRay& ray) {
  const auto shape_a = core::make_shape(a);
  const auto shape_b = core::make_shape(b);
  const core::CrossingList list_a = crossings(*shape_a, ray);
  core::CrossingList list_b = crossings(*shape_b, ray);
  // Rounding makes a hit of a line that touches a cylinder.
  const bool is_touching = list_a.empty() && list_b.size() == 2 &&
                           list_b[1].t - list_b[0].t <= list_b[0].error + list_b[1].error;
  if (is_touching) list_b.clear();
  REQUIRE(list_a.size() == list_b.size());
  for (std::size_t i = 0; i < list_a.size(); ++i) {
    REQUIRE(list_a[i].t == list_b[i].t);
    REQUIRE(list_a[i].entering == list_b[i].entering);
    const core::SurfacePoint point_a = shape_a->surface_point(ray, list_a[i]);
    const core::SurfacePoint point_b = shape_b->surface_point(ray, list_b[i]);
    REQUIRE(glm::length(point_a.position - point_b.position) <=
            1e-15 * (1 + core::largest_component(point_a.position)));
    // Several faces meet in an edge.
    const core::Bounds bounds = shape_b->bounds();
    int limits = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double place = point_b.position[axis];
      limits += place == bounds.lower[axis] || place == bounds.upper[axis] ? 1 + axis / 2 : 0;
    }
    if (limits < 2) REQUIRE(point_a.normal == point_b.normal);
  }
  const core::CrossingList exact_a = exact_crossings(a, Transform{}, ray.origin, ray.direction);
  const core::CrossingList exact_b = exact_crossings(b, Transform{}, ray.origin, ray.direction);
  REQUIRE(exact_a.size() == exact_b.size());
  for (std::size_t i = 0; i < exact_a.size(); ++i) {
    REQUIRE(exact_a[i].t == exact_b[i].t);
    REQUIRE(exact_a[i].entering == exact_b[i].entering);
  }
}

/// Checks that crossings come in order and by turns, and that normals face the ray.
void check_turns(const core::Shape& shape, const core::ObjectRay& ray,
                 const core::CrossingList& list) {
  REQUIRE(list.size() % 2 == 0);
  for (std::size_t i = 0; i < list.size(); ++i) {
    REQUIRE(list[i].entering == (i % 2 == 0));
    if (i > 0) REQUIRE(list[i - 1].t <= list[i].t);
    const Vec3 normal = shape.surface_point(ray, list[i]).normal;
    const double along = glm::dot(normal, ray.direction) / glm::length(ray.direction);
    if (std::abs(along) > 1e-9) REQUIRE((along < 0) == list[i].entering);
  }
}

}  // namespace

TEST_CASE("extrusions are crossed where the oracle says") {
  check_against_oracle(random_extrusion, 20000);
}

TEST_CASE("extrusions of any scale have the same bits") {
  check_scaling(random_extrusion, 300);
}

TEST_CASE("extrusions are crossed in reverse by a ray that is turned round") {
  check_reversal(random_extrusion, 5000);
}

TEST_CASE("points of extrusions are on the surface") {
  check_surface_points(random_extrusion, 3000, true);
}

TEST_CASE("rays that start on an extrusion agree with their side") {
  check_starts(random_extrusion, 5000, false);
}

TEST_CASE("the extrusion of a rectangle is a box, to the last bit") {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const bool is_whole = random.one_in(2);
    const auto number = [&] {
      return is_whole ? std::floor(random.uniform(-3, 3)) : random.uniform(-3, 3);
    };
    const Vec3 a(number(), number(), number());
    const Vec3 b(number(), number(), number());
    if (a.x == b.x || a.y == b.y || a.z == b.z) continue;
    const Extrusion extrusion{
        .profile = profile_of({rectangle(a.x, a.y, b.x, b.y)}), .from = a.z, .to = b.z};
    check_equal(extrusion, Box{.corner_a = a, .corner_b = b}, hard_ray(random));
  }
}

TEST_CASE("the extrusion of a circle is a cylinder, to the last bit") {
  Random random(2);
  for (int i = 0; i < 20000; ++i) {
    const double x = std::floor(random.uniform(-3, 3));
    const double y = std::floor(random.uniform(-3, 3));
    const double radius = 0.5 * std::ceil(random.uniform(0, 6));
    const double from = std::floor(random.uniform(-3, 3));
    const double to = from + 0.5 * std::ceil(random.uniform(0, 6));
    const Extrusion extrusion{
        .profile = profile_of({circle(x, y, radius, random.one_in(2))}), .from = from, .to = to};
    check_equal(extrusion, Cylinder{.from = {x, y, from}, .to = {x, y, to}, .radius = radius},
                hard_ray(random));
  }
}

TEST_CASE("lines enter and leave extrusions by turns, also through corners and along faces") {
  Random random(3);
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const Extrusion extrusion = whole_extrusion(random);
    const auto shape = core::make_shape(extrusion);
    const RealProfile profile(extrusion.profile);
    for (int k = 0; k < 20; ++k) {
      const core::ObjectRay ray = hard_ray(random);
      const core::CrossingList list = crossings(*shape, ray);
      check_turns(*shape, ray, list);
      const core::CrossingList exact =
          exact_crossings(extrusion, Transform{}, ray.origin, ray.direction);
      check_turns(*shape, ray, exact);
      hits += exact.empty() ? 0 : 1;
      // Between crossings the line is inside or outside throughout.
      for (std::size_t j = 0; j + 1 < exact.size(); ++j) {
        if (exact[j + 1].t - exact[j].t < 1e-6) continue;
        for (const double share : {0.21, 0.5, 0.83}) {
          const double t = exact[j].t + share * (exact[j + 1].t - exact[j].t);
          const RealVec p = RealRay(ray).at(t);
          if (profile.distance(p) < 1e-12) continue;
          REQUIRE(profile.contains(p) == (j % 2 == 0));
        }
      }
    }
  }
  CHECK(hits > 10000);
}

TEST_CASE("both tiers tell which parts of whole-number lines are inside") {
  Random random(4);
  for (int i = 0; i < 20000; ++i) {
    const Extrusion extrusion = whole_extrusion(random);
    const core::ObjectRay ray = hard_ray(random);
    core::CrossingList list = crossings(*core::make_shape(extrusion), ray);
    core::CrossingList exact = exact_crossings(extrusion, Transform{}, ray.origin, ray.direction);
    // What only one tier sees is no longer than rounding.
    const auto drop_short = [](core::CrossingList& crossed) {
      for (std::size_t k = 0; k + 1 < crossed.size();) {
        if (crossed[k + 1].t - crossed[k].t <= 1e-6) {
          const auto at = crossed.begin() + static_cast<std::ptrdiff_t>(k);
          crossed.erase(at, at + 2);
        } else {
          ++k;
        }
      }
    };
    drop_short(list);
    drop_short(exact);
    REQUIRE(list.size() == exact.size());
    for (std::size_t k = 0; k < list.size(); ++k) {
      // A gap that is as short as a line grazes may be none in the standard tier.
      constexpr double no_gap = 1e-7;
      REQUIRE(std::abs(list[k].t - exact[k].t) <= list[k].error + exact[k].error + no_gap);
    }
  }
}

TEST_CASE("a star that crosses itself has a hollow middle, with normals that face right") {
  Contour star;
  for (int i = 0; i < 5; ++i) {
    const double angle = 0.8 * std::numbers::pi * i;
    star.push_back({std::sin(angle), std::cos(angle)});
  }
  const auto shape = core::make_shape(Extrusion{.profile = profile_of({star})});
  const core::ObjectRay ray{.origin = {-3, 0.01, 0.5}, .direction = {1, 0, 0}};
  const core::CrossingList list = crossings(*shape, ray);
  CHECK(list.size() == 4);
  check_turns(*shape, ray, list);
  CHECK(crossings(*shape, {.origin = {0, 0.01, 5}, .direction = {0, 0, -1}}).empty());
  CHECK(crossings(*shape, {.origin = {0, 0.9, 5}, .direction = {0, 0, -1}}).size() == 2);
}

TEST_CASE("lines along z meet what is in the profile, and not its boundary") {
  const auto shape = core::make_shape(Extrusion{
      .profile =
          profile_of({rectangle(0, 0, 2, 2), rectangle(2, 0, 4, 2), circle(1, 1, 0.5, true)})});
  const auto count = [&](double x, double y) {
    return crossings(*shape, {.origin = {x, y, -4}, .direction = {0, 0, 1}}).size();
  };
  CHECK(count(0.25, 0.25) == 2);
  CHECK(count(1, 1) == 0);    // in the hole
  CHECK(count(1.5, 1) == 0);  // on its circle
  CHECK(count(0, 1) == 0);    // on the outer boundary
  CHECK(count(0, 0) == 0);    // in a corner
  CHECK(count(2, 1) == 2);    // on a piece that both rectangles have
  CHECK(count(3, 1) == 2);
  CHECK(count(5, 1) == 0);
}

TEST_CASE("whole-number lines along z meet an extrusion exactly where a profile is around them") {
  Random random(5);
  for (int i = 0; i < 4000; ++i) {
    const Extrusion extrusion = whole_extrusion(random);
    const auto shape = core::make_shape(extrusion);
    const RealProfile profile(extrusion.profile);
    for (double x = -3; x <= 3; x += 0.5) {
      const core::ObjectRay ray{.origin = {x, std::floor(random.uniform(-6, 7)) / 2, -9},
                                .direction = {0, 0, 1}};
      const bool is_met = !crossings(*shape, ray).empty();
      REQUIRE(is_met ==
              !exact_crossings(extrusion, Transform{}, ray.origin, ray.direction).empty());
      const RealVec p(ray.origin);
      if (profile.distance(p) > 1e-12) REQUIRE(is_met == profile.contains(p));
    }
  }
}
