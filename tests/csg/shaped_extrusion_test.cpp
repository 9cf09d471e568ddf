// Shaped extrusions are what their definition says, at random points and along random rays in both
// tiers, and have the volumes of closed forms.
#include "crt/shaped_extrusion.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "crt/prepared_scene.hpp"
#include "crt/query.hpp"
#include "csg/made_solids.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr double pi = std::numbers::pi;

Contour l_shape() {
  return {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
}

/// Returns the distance from the boundary of the L, below 0 inside, by its six sides.
double l_distance(double x, double y) {
  const Contour corners = l_shape();
  double distance = 1e9;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const ProfilePoint& a = corners[i];
    const ProfilePoint& b = corners[(i + 1) % corners.size()];
    const double px = std::clamp(x, std::min(a.x, b.x), std::max(a.x, b.x));
    const double py = std::clamp(y, std::min(a.y, b.y), std::max(a.y, b.y));
    distance = std::min(distance, std::hypot(x - px, y - py));
  }
  const bool is_inside = x > 0 && y > 0 && ((x < 2 && y < 1) || (x < 1 && y < 2));
  return is_inside ? -distance : distance;
}

/// Returns a number that is below 0 in the solid of the L, above 0 outside, as its text defines it.
double value_at(const ShapedExtrusion& solid, const Vec3& p) {
  const double share = p.z / solid.height;
  const double scale = 1 + (solid.taper - 1) * share;
  const double turn = solid.twist * share;
  const double x = (std::cos(turn) * p.x + std::sin(turn) * p.y) / scale;
  const double y = (std::cos(turn) * p.y - std::sin(turn) * p.x) / scale;
  const double across = scale * l_distance(x, y);
  const double ends = std::max(-p.z, p.z - solid.height);
  double value = std::max(across, ends);
  if (solid.bevel > 0) value = std::max(value, across + ends + solid.bevel);
  if (solid.rounding > 0) {
    const double sideways = std::max(across + solid.rounding, 0.0);
    const double upwards = std::max(ends + solid.rounding, 0.0);
    value = std::max(value, std::hypot(sideways, upwards) - solid.rounding);
  }
  return value;
}

std::vector<ShapedExtrusion> all_shapes() {
  const auto profile = make_profile({{l_shape()}});
  return {{.profile = profile, .height = 2, .twist = 1},
          {.profile = profile, .height = 2, .twist = -7, .taper = 1.5},
          {.profile = profile, .height = 1.5, .taper = 0.25},
          {.profile = profile, .height = 1, .bevel = 0.25},
          {.profile = profile, .height = 2, .bevel = 1},
          {.profile = profile, .height = 1, .rounding = 0.3},
          {.profile = profile, .height = 3, .twist = 2, .taper = 0.5, .rounding = 0.2},
          {.profile = profile, .height = 3, .twist = 2, .taper = 0.5, .bevel = 0.2}};
}

}  // namespace

TEST_CASE("points are in a shaped extrusion as its definition says") {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> across(-3.5, 3.5);
  for (const ShapedExtrusion& solid : all_shapes()) {
    const Entity entity = solid;
    CHECK(entity.is_solid());
    std::uniform_real_distribution<double> along(-0.2, solid.height + 0.2);
    for (int i = 0; i < 500; ++i) {
      const Vec3 p(across(random), across(random), along(random));
      const double value = value_at(solid, p);
      if (std::abs(value) < 1e-9) continue;
      CHECK(contains(entity, p) == (value < 0 ? PointSide::inside : PointSide::outside));
    }
  }
}

TEST_CASE("rays meet shaped extrusions where they change sides, in both tiers") {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> any(-3, 3);
  for (const ShapedExtrusion& solid : all_shapes()) {
    for (const Precision precision : {Precision::standard, Precision::exact}) {
      Scene scene;
      scene.settings.precision = precision;
      scene.entities = {solid};
      const PreparedScene prepared = prepare(scene);
      RayQueries queries(prepared);
      std::vector<Hit> hits;
      for (int i = 0; i < 300; ++i) {
        Ray ray{.origin = {any(random), any(random), any(random)}};
        ray.direction =
            Vec3(any(random), any(random), any(random)) * 0.3 + Vec3(0.5, 0.5, 1) - ray.origin;
        queries.crossings(ray, hits);
        // Between crossings the side stays.
        double before = 0;
        bool is_in = value_at(solid, ray.origin) < 0;
        for (const Hit& hit : hits) {
          CHECK(hit.entering != is_in);
          CHECK(std::abs(value_at(solid, hit.position)) < 1e-9);
          const Vec3 between = ray.origin + 0.5 * (before + hit.t) * ray.direction;
          if (hit.t - before > 1e-6) CHECK((value_at(solid, between) < 0) == is_in);
          is_in = hit.entering;
          before = hit.t;
        }
        CHECK_FALSE(is_in);
      }
    }
  }
}

TEST_CASE("shaped extrusions have the volumes of closed forms") {
  const auto square = make_profile({{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}});
  const auto check_roughly = [](const ShapedExtrusion& solid, double truth) {
    const Interval found = volume(solid, {.relative_width = 1e-2});
    CHECK(found.contains(truth));
    CHECK(found.width() <= 1.1e-2 * truth);
  };
  check_roughly({.profile = square, .height = 3, .twist = 1.5}, 12);
  check_roughly({.profile = square, .height = 3, .taper = 0.5}, 12 * (1 + 0.5 + 0.25) / 3);
  // Two frustums of pyramids and what is between them.
  const double b = 0.25;
  const double top = (2 - 2 * b) * (2 - 2 * b);
  check_roughly({.profile = square, .height = 2, .bevel = b},
                4 * (2 - 2 * b) + 2 * b * (4 + top + std::sqrt(4 * top)) / 3);
  check_roughly({.profile = square, .height = 2, .bevel = 1}, 2 * 4.0 / 3);
  // A cylinder with rounded edges, by Pappus.
  const auto disc = make_profile({{{{1, 0, 1}, {-1, 0, 1}}}});
  const double r = 0.25;
  const double cut = (1 - pi / 4) * r * r;  // of the square in a corner of the section
  const double away = 1 - r * (10 - 3 * pi) / (12 - 3 * pi);  // its centroid from the axis
  check_roughly({.profile = disc, .height = 1, .rounding = r}, pi - 2 * cut * 2 * pi * away);
}

TEST_CASE("without a shape it is an extrusion, and its ends are flush with others") {
  const auto square = make_profile({{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}});
  check_volume(ShapedExtrusion{.profile = square, .height = 2}, 8);
  const Entity twisted = ShapedExtrusion{.profile = square, .height = 2, .twist = 0.5};
  const Entity below = Box{.corner_a = {-3, -3, -1}, .corner_b = {3, 3, 0}};
  // No film is left between both, and none of what a box takes away to the end.
  CHECK(contains(twisted + below, {0.3, 0.2, 0}) == PointSide::inside);
  const Entity rest = twisted - Entity(Box{.corner_a = {-3, -3, 0}, .corner_b = {3, 3, 2}});
  Scene scene;
  scene.entities = {rest};
  CHECK_FALSE(intersect(prepare(scene), {.origin = {0.1, 0.2, -5}}).has_value());
}

TEST_CASE("what a shaped extrusion can't be is said") {
  const auto square = make_profile({{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}});
  CHECK(fault_of(ShapedExtrusion{}).find("profile") == 0);
  CHECK(fault_of(ShapedExtrusion{.profile = square, .height = 0}).find("height") == 0);
  CHECK(fault_of(ShapedExtrusion{.profile = square, .taper = 0}) ==
        "taper must be from 0.001 to 1000");
  CHECK(fault_of(ShapedExtrusion{.profile = square, .twist = 1e4}) ==
        "twist must be at most 1000 turns");
  CHECK(fault_of(ShapedExtrusion{.profile = square, .bevel = 0.51}) ==
        "bevel must be at most half of the height");
  CHECK(fault_of(ShapedExtrusion{.profile = square, .bevel = 0.1, .rounding = 0.1}) ==
        "rounding must be 0 if there is a bevel");
  const auto crossing = make_profile({{{{0, 0}, {2, 2}, {2, 0}, {0, 2}}}});
  CHECK(
      fault_of(ShapedExtrusion{.profile = crossing, .twist = 1}).find("contours must not cross") !=
      std::string::npos);
}
