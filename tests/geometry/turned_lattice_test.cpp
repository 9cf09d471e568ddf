// Lines through corners, along walls and across the axis of a revolution are inside where both of
// their neighbours are. Here that is computed by its definition, point by point.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/revolution/revolution.hpp"
#include "geometry/exact_tools.hpp"
#include "geometry/line_checks.hpp"
#include "geometry/turned_profiles.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Returns whether both neighbours of a line are in the profile at t. One is a little farther from
/// the axis, and one a little nearer. Those of a line across the axis are higher and lower.
bool is_inside(const RealProfile& profile, const RealRay& ray, Real t) {
  const Real aside = 0x1p-80;
  const RealVec p = ray.at(t);
  const Real squared = p.x * p.x + p.z * p.z;
  if (ray.direction.y == 0) {
    const Real x = square_root(squared);
    return profile.contains({x, p.y + aside, 0}) && profile.contains({x, p.y - aside, 0});
  }
  const Real nearer = squared > aside ? squared - aside : aside / 2;
  return profile.contains({square_root(squared + aside), p.y, 0}) &&
         profile.contains({square_root(nearer), p.y, 0});
}

/// Requires that a list has the true spans, but for those that are as short as rounding.
void check_spans(const Revolution& revolution, const core::ObjectRay& ray,
                 const core::CrossingList& list) {
  const RealProfile profile(revolution.profile);
  const RealRay real(ray);
  std::vector<Real> places;
  for (const Profile::Piece& piece : revolution.profile->pieces()) {
    const std::vector<Real> roots = wall_candidates(*revolution.profile, piece, real);
    places.insert(places.end(), roots.begin(), roots.end());
    // The walls of an arc may cross its chord, too, and a line along a wall has no roots there.
    for (const Vec3& corner : {piece.from, piece.to}) {
      const std::vector<Real> levels = plane_roots(real, {0, 1, 0}, RealVec(corner));
      places.insert(places.end(), levels.begin(), levels.end());
    }
  }
  std::sort(places.begin(), places.end());
  const auto is_listed = [&](Real t) {
    const auto before = std::count_if(list.begin(), list.end(),
                                      [&](const core::Crossing& met) { return Real{met.t} < t; });
    return before % 2 != 0;
  };
  REQUIRE(list.size() % 2 == 0);
  const Real length = square_root(dot(real.direction, real.direction));
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    if ((places[i + 1] - places[i]) * length < 1e-6) continue;
    for (const double share : {0.3, 0.6}) {
      const Real t = places[i] + share * (places[i + 1] - places[i]);
      CAPTURE(static_cast<double>(t));
      REQUIRE(is_listed(t) == is_inside(profile, real, t));
    }
  }
  if (places.empty()) return;
  REQUIRE_FALSE(is_listed(places.front() - 1));
  REQUIRE_FALSE(is_listed(places.back() + 1));
}

void check_both_tiers(const Revolution& revolution, const core::ObjectRay& ray) {
  check_spans(revolution, ray, crossings(*core::make_shape(revolution), ray));
  check_spans(revolution, ray, exact_crossings(revolution, Transform{}, ray.origin, ray.direction));
}

/// Returns a contour of three to six corners of small whole numbers. It may cross itself.
Contour lattice_contour(Random& random) {
  Contour contour(3 + random.bits() % 4);
  for (ProfilePoint& corner : contour) {
    corner.x = static_cast<double>(random.bits() % 4);
    corner.y = static_cast<double>(random.bits() % 5) - 2;
  }
  return contour;
}

Revolution lattice_revolution(Random& random) {
  while (true) {
    try {
      std::vector<Contour> contours = {lattice_contour(random)};
      if (random.one_in(3)) contours.push_back(lattice_contour(random));
      return {.profile = profile_of(contours)};
    } catch (const Error&) {
      continue;
    }
  }
}

/// Returns a corner of a profile, turned by a multiple of a quarter of a turn.
Vec3 turned_corner(const Profile& profile, Random& random) {
  const Vec3 corner = profile.pieces()[random.bits() % profile.pieces().size()].from;
  const double x = random.one_in(2) ? corner.x : -corner.x;
  return random.one_in(3) ? Vec3(0, corner.y, x) : Vec3(x, corner.y, 0);
}

/// Returns a line through one corner or two, from afar. Half of the lines through two are in a
/// plane through the axis, where they may run along a wall.
core::ObjectRay lattice_ray(const Profile& profile, Random& random) {
  const Vec3 first = turned_corner(profile, random);
  Vec3 direction(0.0);
  while (core::largest_component(direction) == 0) {
    direction = random.one_in(3) ? as_vec3(small_vector(random, 3))
                                 : turned_corner(profile, random) - first;
  }
  return {.origin = first - 4.0 * direction, .direction = direction};
}

}  // namespace

TEST_CASE("a line along a wall of a revolution is inside where both of its neighbours are") {
  const Revolution revolution{.profile = profile_of({{{1, 1}, {1, -1}, {3, 2}, {2, -1}, {3, -2}}})};
  const core::ObjectRay ray{.origin = {7, -8, 0}, .direction = {-2, 3, 0}};
  CHECK(crossings(*core::make_shape(revolution), ray).empty());
  CHECK(exact_crossings(revolution, Transform{}, ray.origin, ray.direction).empty());
}

TEST_CASE("lines through corners of a lattice are in revolutions where both neighbours are") {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const Revolution revolution = lattice_revolution(random);
    for (int k = 0; k < 10; ++k) {
      CAPTURE(i);
      CAPTURE(k);
      check_both_tiers(revolution, lattice_ray(*revolution.profile, random));
    }
  }
}

TEST_CASE("lines through corners of a lattice with arcs are in revolutions where neighbours are") {
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    const Revolution revolution{.profile = whole_turned_profile(random)};
    for (int k = 0; k < 10; ++k) {
      CAPTURE(i);
      CAPTURE(k);
      check_both_tiers(revolution, lattice_ray(*revolution.profile, random));
    }
  }
}

TEST_CASE("walls of a revolution that overlap in part on one surface leave no film") {
  const std::vector<std::vector<Contour>> overlapping = {
      {{{0, 0}, {3, 0}, {3, 4}, {0, 4}}, {{3, 1}, {5, 1}, {5, 3}, {3, 3}}},
      {{{0, 0}, {3, 0}, {1, 4}, {0, 4}}, {{2.5, 1}, {5, 1}, {5, 3}, {1.5, 3}}}};
  const std::vector<Contour> joined = {
      {{0, 0}, {3, 0}, {3, 1}, {5, 1}, {5, 3}, {3, 3}, {3, 4}, {0, 4}},
      {{0, 0}, {3, 0}, {2.5, 1}, {5, 1}, {5, 3}, {1.5, 3}, {1, 4}, {0, 4}}};
  Random random(3);
  for (std::size_t i = 0; i < joined.size(); ++i) {
    const Revolution twice{.profile = profile_of(overlapping[i])};
    const Revolution once{.profile = profile_of({joined[i]})};
    int hits = 0;
    for (int k = 0; k < 4000; ++k) {
      const core::ObjectRay ray = [&] {
        const Vec3 direction = random.direction();
        const Vec3 aim = Vec3(0, 2, 0) + 4.0 * random.in_cube();
        return core::ObjectRay{.origin = aim - random.uniform(0, 20) * direction,
                               .direction = direction};
      }();
      const auto check = [&](const core::CrossingList& list, const core::CrossingList& expected) {
        REQUIRE(list.size() == expected.size());
        for (std::size_t n = 0; n < list.size(); ++n) {
          REQUIRE(std::abs(list[n].t - expected[n].t) <= list[n].error + expected[n].error);
        }
        hits += list.empty() ? 0 : 1;
      };
      check(crossings(*core::make_shape(twice), ray), crossings(*core::make_shape(once), ray));
      check(exact_crossings(twice, Transform{}, ray.origin, ray.direction),
            exact_crossings(once, Transform{}, ray.origin, ray.direction));
    }
    CHECK(hits > 4000);
  }
}

TEST_CASE(
    "walls beside a corner are met where t rounds their bodies' parts of the line to nothing") {
  const Revolution revolution{
      .profile = profile_of({{{0x1.3cbd4e343b732p-18, 0x1.1615237566df9p-28, -0x1.14e868bb1e856p-1},
                              {0, 0x1.15cf448315654p-28},
                              {0x1.3cd447009741p-18, 0x1.4312a6094e413p-29}}})};
  const core::ObjectRay ray{
      .origin = {-0x1.79039e0ee1312p+4, 0x1.95fe91e318c85p+4, 0x1.f3b5864122a62p+3},
      .direction = {0x1.3d998855f3a14p-1, -0x1.56034ce13a4b1p-1, -0x1.a4f57771130dfp-2}};
  // The line enters next to one corner and leaves next to another, by the arc between them.
  const core::CrossingList list = crossings(*core::make_shape(revolution), ray);
  REQUIRE(list.size() == 2);
  CHECK(list[0].t == 37.986349467322796);
  CHECK(list[1].t == 37.986349467505327);
}
