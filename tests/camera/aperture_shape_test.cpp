#include "core/camera/aperture_shape.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

using namespace crt::core;
using crt::ApertureShape;

namespace {

constexpr double pi = std::numbers::pi;

/// Calls `visit` for the centres of a fine grid over the unit square. So the effect of a map that
/// keeps areas is known to the accuracy of the grid, without random numbers.
constexpr int grid_side = 1024;
void for_each_point(ApertureShape shape, const std::function<void(const LensPoint&)>& visit) {
  for (int i = 0; i < grid_side; ++i)
    for (int j = 0; j < grid_side; ++j)
      visit(aperture_point(shape, (i + 0.5) / grid_side, (j + 0.5) / grid_side));
}

struct Moments {
  double x = 0, y = 0, xx = 0, yy = 0, xy = 0;
};

Moments moments(ApertureShape shape) {
  Moments sum;
  for_each_point(shape, [&](const LensPoint& p) {
    sum.x += p.x;
    sum.y += p.y;
    sum.xx += p.x * p.x;
    sum.yy += p.y * p.y;
    sum.xy += p.x * p.y;
  });
  constexpr double count = double{grid_side} * grid_side;
  return {sum.x / count, sum.y / count, sum.xx / count, sum.yy / count, sum.xy / count};
}

struct Polygon {
  const char* name;
  ApertureShape shape;
  int sides;
  double first_corner;  ///< angle of a corner, clockwise from the top
};

constexpr std::array<Polygon, 5> polygons = {
    {{"triangle", ApertureShape::triangle, 3, 0},
     {"square", ApertureShape::square, 4, std::numbers::pi / 4},
     {"pentagon", ApertureShape::pentagon, 5, 0},
     {"hexagon", ApertureShape::hexagon, 6, 0},
     {"octagon", ApertureShape::octagon, 8, 0}}};

/// Returns how far `p` lies beyond the polygon's nearest side; negative inside.
double beyond_sides(const Polygon& polygon, const LensPoint& p) {
  const double half_turn = pi / polygon.sides;
  double most = -2;
  for (int side = 0; side < polygon.sides; ++side) {
    const double angle = polygon.first_corner + (2 * side + 1) * half_turn;
    most = std::max(most, p.x * std::sin(angle) + p.y * std::cos(angle) - std::cos(half_turn));
  }
  return most;
}

constexpr double rounding = 1e-15;

}  // namespace

TEST_CASE("polygons lie within their sides and reach their corners") {
  for (const Polygon& polygon : polygons) {
    CAPTURE(polygon.name);
    double most = -2;
    std::vector<double> corner_distance(static_cast<std::size_t>(polygon.sides), 2.0);
    for_each_point(polygon.shape, [&](const LensPoint& p) {
      most = std::max(most, beyond_sides(polygon, p));
      for (int corner = 0; corner < polygon.sides; ++corner) {
        const double angle = polygon.first_corner + corner * 2 * pi / polygon.sides;
        double& nearest = corner_distance[static_cast<std::size_t>(corner)];
        nearest = std::min(nearest, std::hypot(p.x - std::sin(angle), p.y - std::cos(angle)));
      }
    });
    CHECK(most <= rounding);
    for (const double distance : corner_distance) CHECK(distance < 0.01);
  }
}

TEST_CASE("the largest numbers below 1 stay within the shapes") {
  const double last = 1 - 0x1p-53;
  for (const double u : {0.0, 0.5, last})
    for (const double v : {0.0, 0.5, last}) {
      for (const Polygon& polygon : polygons)
        CHECK(beyond_sides(polygon, aperture_point(polygon.shape, u, v)) <= rounding);
      const LensPoint in_circle = circle_point(u, v);
      CHECK(std::hypot(in_circle.x, in_circle.y) <= 1 + rounding);
      const LensPoint in_gaussian = gaussian_point(u, v);
      CHECK(std::hypot(in_gaussian.x, in_gaussian.y) <= 2 + 2 * rounding);
    }
}

TEST_CASE("a regular polygon has its centroid in the middle and the second moments of its area") {
  for (const Polygon& polygon : polygons) {
    CAPTURE(polygon.name);
    const Moments m = moments(polygon.shape);
    // About any axis in its plane, with circumradius 1, the second moment is (2 + cos(2 pi / n)) /
    // 12.
    const double second = (2 + std::cos(2 * pi / polygon.sides)) / 12;
    CHECK(m.x == doctest::Approx(0).epsilon(1e-3));
    CHECK(m.y == doctest::Approx(0).epsilon(1e-3));
    CHECK(m.xy == doctest::Approx(0).epsilon(1e-3));
    CHECK(m.xx == doctest::Approx(second).epsilon(2e-3));
    CHECK(m.yy == doctest::Approx(second).epsilon(2e-3));
  }
}

TEST_CASE("circle, uniform, line and gaussian have the moments of their formulas") {
  const auto check = [](ApertureShape shape, double xx, double yy) {
    const Moments m = moments(shape);
    CHECK(std::abs(m.x) < 1e-3);
    CHECK(std::abs(m.y) < 1e-3);
    CHECK(std::abs(m.xy) < 1e-3);
    CHECK(m.xx == doctest::Approx(xx).epsilon(1e-3));
    CHECK(m.yy == doctest::Approx(yy).epsilon(1e-3));
  };
  check(ApertureShape::circle, 0.25, 0.25);
  check(ApertureShape::uniform, 1.0 / 3, 1.0 / 3);
  check(ApertureShape::line, 1.0 / 3, 0);
  // The mean of r^2 of a normal distribution of variance s^2 that is cut at R, with q = R^2 / (2
  // s^2), is 2 s^2 (1 - (1 + q) e^-q) / (1 - e^-q). Each coordinate has half of it.
  const double q = 8;
  const double mean_square = 0.5 * (1 - (1 + q) * std::exp(-q)) / (1 - std::exp(-q));
  check(ApertureShape::gaussian, mean_square / 2, mean_square / 2);
}

TEST_CASE("equal areas of every polygon and of the disc get equally many points") {
  // These sub-areas have equal size by construction: each of `wedges` equal wedges is cut into
  // `rings` parts of equal area by scaled copies of the proxy.
  constexpr std::size_t rings = 4;
  for (const Polygon& polygon : polygons) {
    CAPTURE(polygon.name);
    const auto wedges =
        2 * static_cast<std::size_t>(polygon.sides);  // by symmetry half a side each
    std::vector<double> counts(wedges * rings, 0.0);
    for_each_point(polygon.shape, [&](const LensPoint& p) {
      const double turn = (std::atan2(p.x, p.y) - polygon.first_corner) / (2 * pi);
      const std::size_t wedge =
          static_cast<std::size_t>((turn - std::floor(turn)) * static_cast<double>(wedges)) %
          wedges;
      const double scale = 1 + beyond_sides(polygon, p) / std::cos(pi / polygon.sides);
      const std::size_t ring = std::min(rings - 1, static_cast<std::size_t>(scale * scale * rings));
      counts[wedge * rings + ring] += 1;
    });
    const double expected = double{grid_side} * grid_side / static_cast<double>(wedges * rings);
    for (const double count : counts) CHECK(count == doctest::Approx(expected).epsilon(0.02));
  }

  constexpr std::size_t sectors = 12;
  std::array<double, sectors * rings> counts{};
  for_each_point(ApertureShape::circle, [&](const LensPoint& p) {
    const double turn = std::atan2(p.y, p.x) / (2 * pi) + 0.5;
    const std::size_t sector = std::min(sectors - 1, static_cast<std::size_t>(turn * sectors));
    const std::size_t ring =
        std::min(rings - 1, static_cast<std::size_t>((p.x * p.x + p.y * p.y) * rings));
    counts[sector * rings + ring] += 1;
  });
  const double expected = double{grid_side} * grid_side / (sectors * rings);
  for (const double count : counts) CHECK(count == doctest::Approx(expected).epsilon(0.02));
}

TEST_CASE("the concentric map keeps neighbours together") {
  constexpr double step = 1.0 / 256;
  for (double u = 0; u < 1 - step; u += step)
    for (double v = 0; v < 1 - step; v += step) {
      const LensPoint here = circle_point(u, v);
      const LensPoint beside = circle_point(u + step, v);
      const LensPoint above = circle_point(u, v + step);
      REQUIRE(std::hypot(beside.x - here.x, beside.y - here.y) < 4 * step);
      REQUIRE(std::hypot(above.x - here.x, above.y - here.y) < 4 * step);
    }
}

TEST_CASE("the gaussian's distances follow its distribution and end at its cut") {
  const double within_cut = 1 - std::exp(-8.0);
  for (const double u : {0.0, 0.1, 0.5, 0.9, 0.999999}) {
    const LensPoint p = gaussian_point(u, 0.3);
    const double square = p.x * p.x + p.y * p.y;
    CHECK((1 - std::exp(-2 * square)) / within_cut == doctest::Approx(u).epsilon(1e-9));
    CHECK(square < 4);
  }
}
