#include "crt/helix.hpp"

#include <doctest/doctest.h>

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

/// Returns a number that is below 0 in the helix along y, which begins at z, by its definition.
double value_at(const Helix& helix, const Vec3& p) {
  const double away = std::hypot(p.x, p.z);
  // A right one goes from z towards -x, as a common screw does (see thread_test.cpp).
  const double angle = std::atan2(helix.left ? p.x : -p.x, p.z) / (2 * pi);
  const double turns = p.y / helix.pitch - angle;
  const double h = helix.pitch * (turns - std::round(turns));
  const double around = 2 * pi * helix.radius;
  const double cosine = around / std::hypot(around, helix.pitch);
  return std::max(
      {std::hypot(away - helix.radius, h * cosine) - helix.thickness, -p.y, p.y - helix.to.y});
}

}  // namespace

TEST_CASE("points are in a helix, and rays meet it, as its definition says") {
  std::mt19937_64 random(5);
  for (const bool left : {false, true}) {
    for (const double pitch : {1.0, 3.0, 10.0}) {
      const Helix helix{.to = {0, 4, 0},
                        .radius = 2,
                        .thickness = std::min(0.35 * pitch, 1.2),
                        .pitch = pitch,
                        .left = left};
      Scene scene;
      scene.entities = {helix};
      std::uniform_real_distribution<double> any(-4, 4);
      int inside = 0;
      for (int i = 0; i < 2000; ++i) {
        const Vec3 p(any(random), any(random) + 2, any(random));
        const double value = value_at(helix, p);
        if (std::abs(value) < 1e-5) continue;
        inside += value < 0 ? 1 : 0;
        CHECK(contains(scene.entities[0], p) ==
              (value < 0 ? PointSide::inside : PointSide::outside));
      }
      CHECK(inside > 50);
      for (const Precision precision : {Precision::standard, Precision::exact}) {
        scene.settings.precision = precision;
        const PreparedScene prepared = prepare(scene);
        RayQueries queries(prepared);
        std::vector<Hit> hits;
        for (int i = 0; i < 100; ++i) {
          const Vec3 from(any(random) * 2, any(random) + 2, 9);
          queries.crossings({.origin = from, .direction = Vec3(0, 2, 0) - from}, hits);
          bool is_in = false;
          for (const Hit& hit : hits) {
            CHECK(hit.entering != is_in);
            CHECK(std::abs(value_at(helix, hit.position)) < 1e-5);
            is_in = hit.entering;
          }
        }
      }
    }
  }
}

TEST_CASE("a helix has the volume of its wire") {
  // The section along the axis is an ellipse about the wire's middle (Pappus).
  const Helix helix{.to = {0, 0, 2}, .radius = 1, .thickness = 0.25, .pitch = 1};
  const double cosine = 2 * pi / std::hypot(2 * pi, 1.0);
  const Interval found = volume(helix, {.relative_width = 0.1});
  const double ends = 1;  // of whole turns the flat ends cut as much as they leave
  CHECK(found.contains(ends * 2 * pi * pi * 0.25 * 0.25 / cosine * 2));
}

TEST_CASE("what a helix can't be is said") {
  CHECK(fault_of(Helix{.thickness = 0.95}) == "thickness must be at most 0.9 of the radius");
  CHECK(fault_of(Helix{.thickness = 0.5}) == "pitch must leave a tenth of it between the turns");
  CHECK(fault_of(Helix{.to = {0, 0, 1e5}}) == "pitch must be at least a 10000th of the length");
  CHECK(fault_of(Helix{.radius = 0}).find("radius") == 0);
  CHECK(fault_of(Helix{.to = {0, 0, 0}}).find("to must differ from from") == 0);
}
