#include "core/geometry/revolution/revolution.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/math/vector.hpp"
#include "crt/prepared_scene.hpp"
#include "crt/query.hpp"
#include "crt/scene.hpp"
#include "geometry/exact_tools.hpp"
#include "geometry/line_checks.hpp"
#include "geometry/turned_profiles.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr double whole_turn = 2 * std::numbers::pi;

Subject subject_of(const Revolution& revolution, double size) {
  const RealProfile profile(revolution.profile);
  const core::TurnedProfile turned(revolution);
  const core::Bounds& bounds = revolution.profile->bounds();
  return {.primitive = revolution,
          .center = {0, 0.5 * bounds.lower.y + 0.5 * bounds.upper.y, 0},
          .size = size,
          .candidates =
              [=](const RealRay& ray) {
                std::vector<Real> all;
                const auto add = [&](const std::vector<Real>& roots) {
                  all.insert(all.end(), roots.begin(), roots.end());
                };
                for (const Profile::Piece& piece : turned.profile->pieces()) {
                  add(wall_candidates(*turned.profile, piece, ray));
                }
                for (std::uint32_t end = 0; end < turned.planes; ++end) {
                  add(plane_roots(ray, RealVec(turned.normals[end]), RealVec()));
                }
                return all;
              },
          .field =
              [=](const RealVec& p) {
                const RealVec flat = in_profile(p);
                const Real aside = profile.distance(flat);
                const Real side = profile.contains(flat) ? -aside : aside;
                if (turned.planes == 0) return side;
                const Real first = dot(RealVec(turned.normals[0]), p);
                const Real last = dot(RealVec(turned.normals[turned.planes - 1]), p);
                return std::max(side,
                                turned.is_union ? std::min(first, last) : std::max(first, last));
              }};
}

Subject random_revolution(Random& random) {
  const double size = random.power_of_ten(-4, 4);
  return subject_of({.profile = random_turned_profile(random, size), .angle = random_turn(random)},
                    3 * size);
}

Revolution whole_revolution(Random& random) {
  return {.profile = whole_turned_profile(random), .angle = random_turn(random)};
}

/// Checks that crossings come in order and by turns, and that normals face the ray.
void check_turns(const core::Shape& shape, const core::ObjectRay& ray,
                 const core::CrossingList& list) {
  REQUIRE(list.size() % 2 == 0);
  for (std::size_t i = 0; i < list.size(); ++i) {
    REQUIRE(list[i].entering == (i % 2 == 0));
    if (i > 0) REQUIRE(list[i - 1].t <= list[i].t);
    // On either side of what is as thin as rounding there is the same point.
    const bool is_thin = (i > 0 && list[i].t - list[i - 1].t < 1e-9) ||
                         (i + 1 < list.size() && list[i + 1].t - list[i].t < 1e-9);
    const core::SurfacePoint point = shape.surface_point(ray, list[i]);
    const bool is_apex = std::hypot(point.position.x, point.position.z) < 1e-9;
    if (is_thin || is_apex) continue;
    const double along = glm::dot(point.normal, ray.direction) / glm::length(ray.direction);
    if (std::abs(along) > 1e-6) REQUIRE((along < 0) == list[i].entering);
  }
}

/// Checks that the line is in the solid between crossings by turns.
void check_inside(const Subject& subject, const core::ObjectRay& ray,
                  const core::CrossingList& list) {
  const RealRay real(ray);
  const auto check = [&](double t, bool inside) {
    const Real field = subject.field(real.at(t));
    if (magnitude(field) > 1e-10) REQUIRE((field < 0) == inside);
  };
  for (std::size_t j = 0; j + 1 < list.size(); ++j) {
    for (const double share : {0.21, 0.5, 0.83}) {
      check(list[j].t + share * (list[j + 1].t - list[j].t), j % 2 == 0);
    }
  }
  const double speed = core::largest_component(ray.direction);
  const double first = list.empty() ? 0 : list.front().t;
  const double last = list.empty() ? 0 : list.back().t;
  for (const double ahead : {0.1, 0.7, 2.3, 4.1}) {
    check(first - ahead / speed, false);
    check(last + ahead / speed, false);
  }
}

void check_equal(const core::CrossingList& a, const core::CrossingList& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    REQUIRE(a[i].t == b[i].t);
    REQUIRE(a[i].entering == b[i].entering);
  }
}

/// Checks that two solids are crossed at the same bits, in both tiers.
void check_equal(const Primitive& a, const Primitive& b, const core::ObjectRay& ray) {
  check_equal(crossings(*core::make_shape(a), ray), crossings(*core::make_shape(b), ray));
  check_equal(exact_crossings(a, Transform{}, ray.origin, ray.direction),
              exact_crossings(b, Transform{}, ray.origin, ray.direction));
}

core::ObjectRay plain_ray(Random& random) {
  const Vec3 direction = random.direction();
  return {.origin = 1.5 * random.in_cube() - random.uniform(-1, 6) * direction,
          .direction = direction};
}

}  // namespace

TEST_CASE("revolutions are crossed where the oracle says") {
  check_against_oracle(random_revolution, 20000);
}

TEST_CASE("revolutions of any scale have the same bits") {
  check_scaling(random_revolution, 300);
}

TEST_CASE("revolutions are crossed in reverse by a ray that is turned round") {
  check_reversal(random_revolution, 5000);
}

TEST_CASE("points of revolutions are on the surface") {
  check_surface_points(random_revolution, 3000, true);
}

TEST_CASE("rays that start on a revolution agree with their side") {
  check_starts(random_revolution, 5000, false);
}

TEST_CASE("revolutions of simple profiles are the other primitives, to the last bit") {
  Random random(1);
  for (int i = 0; i < 5000; ++i) {
    const double x = random.uniform(0.2, 2);
    const double top = random.uniform(0.1, 2);
    const double radius = random.uniform(0.1, 1);
    const core::ObjectRay ray = plain_ray(random);
    check_equal(Revolution{.profile = profile_of({rectangle(0, -1, x, top)})},
                Cylinder{.from = {0, -1, 0}, .to = {0, top, 0}, .radius = x}, ray);
    check_equal(Revolution{.profile = profile_of({{{0, -1}, {x, -1}, {radius, top}, {0, top}}})},
                Cone{.from = {0, -1, 0}, .to = {0, top, 0}, .radius = x, .radius2 = radius}, ray);
    check_equal(Revolution{.profile = profile_of({{{0, -1}, {x, -1}, {0, top}}})},
                Cone{.from = {0, -1, 0}, .to = {0, top, 0}, .radius = x, .radius2 = 0}, ray);
    const auto half = profile_of({{{0, top - radius}, {0, top + radius, 1}}});
    check_equal(Revolution{.profile = half},
                Sphere{.center = half->arcs()[0].center, .radius = half->arcs()[0].radius}, ray);
    // Both half circles have the same center and radius.
    const double height = std::floor(random.uniform(-64, 64)) / 64;
    const double tube = std::ceil(random.uniform(0, 64)) / 64;
    check_equal(Revolution{.profile = profile_of({circle(2, height, tube)})},
                Torus{.center = {0, height, 0}, .radius = 2, .thickness = tube}, ray);
  }
}

TEST_CASE("arcs about a center on the axis are spheres, also where rounding put it beside that") {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    // A ball on a stem: its arc goes from the stem to the tip.
    const double radius = random.uniform(0.5, 1);
    const double stem = random.uniform(0.1, 0.4);
    const double turned = std::numbers::pi / 2 + std::acos(stem / radius);
    const double low = -std::sqrt(radius * radius - stem * stem);
    const auto profile =
        profile_of({{{0, -2}, {stem, -2}, {stem, low}, {0, radius, std::tan(turned / 4)}}});
    const core::Surface surface =
        core::make_shape(Revolution{.profile = profile})->surface(core::face_of_wall(2, false));
    REQUIRE(surface.kind == core::SurfaceKind::sphere);
    const Profile::Arc& arc = profile->arcs()[0];
    const core::ObjectRay ray{.origin = {-3, random.uniform(0.1, 0.4), random.uniform(-0.2, 0.2)},
                              .direction = {1, random.uniform(-0.05, 0.05), 0}};
    check_equal(Revolution{.profile = profile},
                Sphere{.center = {0, arc.center.y, 0}, .radius = arc.radius}, ray);
  }
}

TEST_CASE("lines enter and leave revolutions by turns, also through corners and along faces") {
  Random random(3);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Revolution revolution = whole_revolution(random);
    const auto shape = core::make_shape(revolution);
    const Subject subject = subject_of(revolution, 6);
    for (int k = 0; k < 20; ++k) {
      CAPTURE(i);
      CAPTURE(k);
      const core::ObjectRay ray = hard_ray(random);
      const core::CrossingList list = crossings(*shape, ray);
      check_turns(*shape, ray, list);
      check_inside(subject, ray, list);
      const core::CrossingList exact =
          exact_crossings(revolution, Transform{}, ray.origin, ray.direction);
      check_turns(*shape, ray, exact);
      check_inside(subject, ray, exact);
      hits += exact.empty() ? 0 : 1;
    }
  }
  CHECK(hits > 10000);
}

TEST_CASE("lines find all walls that they cross among a thousand") {
  Contour wave = {{0, 0}};
  for (int i = 0; i <= 1000; ++i) {
    const double height = 0.005 * i;
    wave.push_back({2 + 0.5 * std::sin(40 * height), height, i % 3 == 0 ? 0.4 : 0.0});
  }
  wave.push_back({0, 5});
  const Revolution revolution{.profile = profile_of({wave}), .angle = 4};
  const auto shape = core::make_shape(revolution);
  const Subject subject = subject_of(revolution, 5);
  Random random(8);
  std::size_t most = 0;
  for (int i = 0; i < 300; ++i) {
    core::ObjectRay ray = plain_ray(random);
    ray.origin.y += random.uniform(0, 5);
    const core::CrossingList list = crossings(*shape, ray);
    check_turns(*shape, ray, list);
    check_inside(subject, ray, list);
    most = std::max(most, list.size());
  }
  // Along the side there are many waves.
  for (int i = 0; i < 20; ++i) {
    const core::ObjectRay ray{.origin = {2 + random.uniform(-0.4, 0.4), -1, 0.01},
                              .direction = {0, 1, random.uniform(-0.01, 0.01)}};
    const core::CrossingList list = crossings(*shape, ray);
    check_turns(*shape, ray, list);
    check_inside(subject, ray, list);
    most = std::max(most, list.size());
  }
  CHECK(most > 40);
}

TEST_CASE("lines along walls and through corners are inside where all around them is") {
  // A cylinder of two rectangles that share a wall, with a corner halfway up.
  const Contour inner = rectangle(0, 0, 1, 4);
  const Contour outer = {{1, 0}, {2, 0}, {2, 1}, {2, 4}, {1, 4}};
  const auto shape = core::make_shape(Revolution{.profile = profile_of({inner, outer})});
  const auto count = [&](const Vec3& origin, const Vec3& direction) {
    const core::ObjectRay ray{.origin = origin, .direction = direction};
    const core::CrossingList list = crossings(*shape, ray);
    check_turns(*shape, ray, list);
    return list.size();
  };
  CHECK(count({1, -5, 0}, {0, 1, 0}) == 2);  // along the wall inside
  CHECK(count({0, -5, 0}, {0, 1, 0}) == 2);  // along the axis
  CHECK(count({2, -5, 0}, {0, 1, 0}) == 0);  // along the outer wall
  CHECK(count({-5, 1, 0}, {1, 0, 0}) == 2);  // through the corner halfway up
  CHECK(count({-5, 1, 1}, {1, 0, 0}) == 2);
  CHECK(count({-5, 1, 2}, {1, 0, 0}) == 0);  // touching the side there
  CHECK(count({-5, 4, 0}, {1, 0, 0}) == 0);  // in the plane of the top
  CHECK(count({-5, 0, 0.5}, {1, 0, 0}) == 0);
  CHECK(count({-4, 3, 0}, {2, -2, 0}) == 2);  // slanting through the corner halfway up
}

TEST_CASE("a wall that goes to the axis makes an apex, through which lines pass either way") {
  const auto count = [](const std::vector<Contour>& contours, const Vec3& origin,
                        const Vec3& direction) {
    const auto shape = core::make_shape(Revolution{.profile = profile_of(contours)});
    return crossings(*shape, {.origin = origin, .direction = direction}).size();
  };
  const std::vector<Contour> around = {{{0, 0}, {1, -1}, {1, 1}}};
  CHECK(count(around, {-3, 0, 0}, {1, 0, 0}) == 2);
  CHECK(count(around, {-2, -1, 0}, {2, 1, 0}) == 2);
  CHECK(count(around, {-1, -2, 0}, {1, 2, 0}) == 0);
  CHECK(count(around, {0, -3, 0}, {0, 1, 0}) == 0);   // along the axis
  CHECK(count(around, {-2, -2, 0}, {1, 1, 0}) == 0);  // along both sides
  const std::vector<Contour> within = {{{0, 0}, {1, 1}, {0, 1}}, {{0, 0}, {1, -1}, {0, -1}}};
  CHECK(count(within, {-3, 0, 0}, {1, 0, 0}) == 0);
  CHECK(count(within, {-2, -1, 0}, {2, 1, 0}) == 0);
  CHECK(count(within, {-1, -2, 0}, {1, 2, 0}) == 2);
  CHECK(count(within, {0, -3, 0}, {0, 1, 0}) == 2);
  CHECK(count(within, {-2, -2, 0}, {1, 1, 0}) == 0);
  const std::vector<Contour> below = {{{0, 0}, {1, -1}, {0, -1}}};
  CHECK(count(below, {-1, -2, 0}, {1, 2, 0}) == 2);
  CHECK(count(below, {-2, 0, 0}, {1, 0, 0}) == 0);
}

TEST_CASE("an angle of less than a turn leaves two flat ends") {
  const auto at = [](double angle, const Vec3& origin, const Vec3& direction) {
    const auto shape = core::make_shape(
        Revolution{.profile = profile_of({rectangle(1, 0, 2, 1)}), .angle = angle});
    const core::ObjectRay ray{.origin = origin, .direction = direction};
    const core::CrossingList list = crossings(*shape, ray);
    check_turns(*shape, ray, list);
    std::vector<double> places;
    for (const core::Crossing& crossing : list) places.push_back(crossing.t);
    return places;
  };
  using Places = std::vector<double>;
  constexpr double quarter = whole_turn / 4;
  CHECK(at(quarter, {-5, 0.5, 0}, {1, 0, 0}) == Places{});
  CHECK(at(1.5 * quarter, {-5, 0.5, 0}, {1, 0, 0}) == Places{6, 7});
  CHECK(at(2 * quarter, {-5, 0.5, 0}, {1, 0, 0}) == Places{6, 7});
  CHECK(at(3 * quarter, {-5, 0.5, 0}, {1, 0, 0}) == Places{6, 7});
  CHECK(at(3.5 * quarter, {-5, 0.5, 0}, {1, 0, 0}) == Places{3, 4, 6, 7});
  CHECK(at(quarter, {1.5, 0.5, -5}, {0, 0, 1}).size() == 2);
  CHECK(at(quarter, {1.5, 0.5, -5}, {0, 0, 1}).front() == 5);
  CHECK(at(3 * quarter, {-1.5, 0.5, 5}, {0, 0, -1}).front() == 5);
}

TEST_CASE("the planes of ends have the nearest sine and cosine of the angle") {
  Random random(9);
  const auto profile = profile_of({rectangle(1, 0, 2, 1)});
  const auto check = [](double found, long double truth) {
    const double ulp = std::nextafter(std::abs(found), HUGE_VAL) - std::abs(found);
    REQUIRE(std::abs(static_cast<long double>(found) - truth) <= 0.501L * ulp);
  };
  for (int i = 0; i < 20000; ++i) {
    const double angle = i == 0 ? 1 : random.uniform(1e-3, whole_turn - 1e-3);
    const core::TurnedProfile turned(Revolution{.profile = profile, .angle = angle});
    check(turned.normals[1].x, std::cos(static_cast<long double>(angle)));
    check(turned.normals[1].z, -std::sin(static_cast<long double>(angle)));
  }
}

TEST_CASE("a face that is flush with another solid's opens it") {
  const Entity vase =
      revolved(profile_of({{{0, 0}, {2, 0}, {1, 2}, {0, 2}}}), {1, 2, 3}, {1, 4, 3}, whole_turn);
  const Entity cone = Cone{.from = {1, 2, 3}, .to = {1, 4, 3}, .radius = 2, .radius2 = 1};
  Random random(7);
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    for (const Entity& nothing : {vase - cone, cone - vase}) {
      Scene scene;
      scene.entities = {nothing};
      scene.settings.precision = precision;
      const PreparedScene prepared = prepare(scene);
      for (int i = 0; i < 2000; ++i) {
        const core::ObjectRay ray = plain_ray(random);
        REQUIRE(
            crossings(prepared, {.origin = ray.origin + Vec3(1, 3, 3), .direction = ray.direction})
                .empty());
      }
    }
  }
}
