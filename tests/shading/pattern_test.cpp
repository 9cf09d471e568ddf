#include "core/shading/prepared_pattern.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

using namespace crt::core;
using crt::Color;
using crt::Vec3;

namespace {

const Color white = {1, 1, 1};
const Color black = {0, 0, 0};

PreparedPattern prepared(const crt::Pattern& pattern, double gamma = 1) {
  TexturePool textures(gamma);
  return {pattern, textures};
}

Color color_at(const crt::Pattern& pattern, const Vec3& position, const Vec3& normal = {0, 1, 0}) {
  return prepared(pattern).color({.position = position, .normal = normal});
}

double level_at(const crt::Pattern& pattern, const Vec3& position) {
  return color_at(pattern, position).r;
}

/// Returns patterns of every kind, with two colours that differ in alpha.
std::vector<crt::Pattern> all_patterns(double scale) {
  const Color a = {0.9, 0.5, 0.25, 0.75};
  const Color b = {0.1, 0.3, 0.75, 1};
  const auto image = std::make_shared<crt::Image>(3, 3);
  for (int i = 0; i < 9; ++i) image->set(i % 3, i / 3, mix(a, b, i / 8.0));
  const Vec3 offset(0.3, -0.2, 0.7);
  return {
      crt::Checker{.color_a = a, .color_b = b, .scale = scale, .offset = offset},
      crt::Stripes{
          .color_a = a, .color_b = b, .direction = {1, 2, -1}, .scale = scale, .offset = offset},
      crt::Gradient{.color_a = a, .color_b = b, .scale = scale},
      crt::Noise{.color_a = a, .color_b = b, .octaves = 2, .scale = scale},
      crt::Marble{.color_a = a, .color_b = b, .octaves = 2, .scale = scale},
      crt::Wood{.color_a = a, .color_b = b, .octaves = 2, .scale = scale},
      crt::ImageMap{.image = image, .repeat_u = 1 / scale, .repeat_v = -3}};
}

/// Coordinates have all sizes and signs. Some of them are whole, some no numbers.
class Coordinates {
 public:
  double next() {
    constexpr double inf = std::numeric_limits<double>::infinity();
    constexpr double special[] = {
        0.0,        -0.0,       1.0,      -1.0,
        0x1p52,     0x1p53 + 2, -0x1p53,  0x1p53 - 1,
        1 - 0x1p53, 1.7e308,    -1.7e308, 5e-324,
        -5e-324,    inf,        -inf,     std::numeric_limits<double>::quiet_NaN()};
    const double fraction = std::uniform_real_distribution<double>(-1, 1)(engine_);
    switch (engine_() % 4) {
      case 0:
        return special[engine_() % std::size(special)];
      case 1:
        return std::round(1000 * fraction);
      case 2:
        return 20 * fraction;
      default:
        return std::ldexp(fraction, static_cast<int>(engine_() % 2000) - 1000);
    }
  }
  SurfacePoint point() {
    const Vec3 normals[] = {{0, 1, 0}, {0, -1, 0}, {0.6, 0, -0.8}};
    return {.position = {next(), next(), next()},
            .normal = normals[engine_() % 3],
            .u = next(),
            .v = next()};
  }

 private:
  std::mt19937_64 engine_{1};
};

void set_lane(SurfacePointLanes& points, std::size_t lane, const SurfacePoint& point) {
  const std::size_t i = lane;
  points.position.set(lane, point.position);
  points.normal.set(lane, point.normal);
  points.u[i] = point.u;
  points.v[i] = point.v;
}

}  // namespace

TEST_CASE("a checkerboard changes colour from cube to cube, in all directions and below 0") {
  const crt::Checker checker{.scale = 2};
  for (int x = -3; x < 3; ++x) {
    for (int y = -3; y < 3; ++y) {
      for (int z = -3; z < 3; ++z) {
        const Vec3 middle(2 * x + 1, 2 * y + 1, 2 * z + 1);
        CHECK(color_at(checker, middle) == ((x + y + z) % 2 == 0 ? white : black));
      }
    }
  }
}

TEST_CASE(
    "a surface that lies on the border of cubes wears those inside, however its points are "
    "rounded") {
  const crt::Checker checker;
  for (const double rounding : {-1e-15, -1e-300, 0.0, 1e-300, 1e-15}) {
    // The top of a floor shows the cubes below it, from y = -1 to 0.
    CHECK(color_at(checker, {0.5, rounding, 0.5}, {0, 1, 0}) == black);
    // The underside of a ceiling shows those above it.
    CHECK(color_at(checker, {0.5, rounding, 0.5}, {0, -1, 0}) == white);
  }
  CHECK(color_at(checker, {1e6 + 0.5, 1e6, 0.5}, {0, 1, 0}) ==
        color_at(checker, {1e6 + 0.5, 1e6 - 0.5, 0.5}));
}

TEST_CASE(
    "a checkerboard's colour is that of its plain formula, also where coordinates are no numbers") {
  const auto is_odd = [](double cell) { return std::fmod(cell, 2) != 0; };
  Coordinates coordinates;
  for (const double scale : {1.0, 0.37, 1e-100, 1e100}) {
    const crt::Checker checker{.scale = scale, .offset = {0.013, 0.3, -7}};
    const PreparedPattern pattern = prepared(checker);
    for (int i = 0; i < 50000; ++i) {
      const SurfacePoint point = coordinates.point();
      const double largest = std::max(
          {std::abs(point.position.x), std::abs(point.position.y), std::abs(point.position.z)});
      const Vec3 under =
          point.position - point.normal * std::max(scale * 0x1p-20, largest * 0x1p-48);
      const Vec3 cell = glm::floor((under - checker.offset) / scale);
      const bool odd = is_odd(cell.x) != (is_odd(cell.y) != is_odd(cell.z));
      REQUIRE(pattern.color(point) == (odd ? checker.color_b : checker.color_a));
    }
  }
}

TEST_CASE("points side by side have the colours that each has by itself") {
  Coordinates coordinates;
  for (const double scale : {1.0, 0.37, 1e-100}) {
    for (const crt::Pattern& description : all_patterns(scale)) {
      const PreparedPattern pattern = prepared(description);
      for (std::uint32_t i = 0; i < 5000; ++i) {
        const std::uint32_t lanes = i % 16;
        SurfacePointLanes points;
        for (std::size_t lane = 0; lane < lane_count; ++lane)
          set_lane(points, lane, coordinates.point());
        const ColorLanes colors = pattern.colors(points, lanes);
        for (std::size_t lane = 0; lane < lane_count; ++lane) {
          if ((lanes >> lane & 1u) == 0) continue;
          const Color alone = pattern.color(lane_of(points, lane));
          REQUIRE(colors.color.lane(lane) == rgb(alone));
          const double alpha = colors.alpha[lane];
          REQUIRE(alpha == alone.a);
        }
      }
    }
  }
}

TEST_CASE("only image maps look at u and v") {
  for (const crt::Pattern& pattern : all_patterns(1)) {
    CHECK(prepared(pattern).uses_uv() == std::holds_alternative<crt::ImageMap>(pattern));
  }
}

TEST_CASE("an offset moves a pattern") {
  const crt::Checker still{.scale = 3};
  const crt::Checker moved{.scale = 3, .offset = {0.7, -0.2, 5}};
  for (double x = -4; x < 4; x += 0.37) {
    const Vec3 place(x, 0.4 * x + 1.1, 0.9);
    CHECK(color_at(moved, place + Vec3(0.7, -0.2, 5)) == color_at(still, place));
  }
}

TEST_CASE("stripes are two bands a period, across their direction only") {
  const crt::Stripes stripes{.direction = {0, 0, 7}, .scale = 4};
  CHECK(color_at(stripes, {0, 0, 1}) == white);
  CHECK(color_at(stripes, {9, -5, 1.9}) == white);
  CHECK(color_at(stripes, {0, 0, 2.1}) == black);
  CHECK(color_at(stripes, {0, 0, 3.9}) == black);
  CHECK(color_at(stripes, {0, 0, 4.1}) == white);
  CHECK(color_at(stripes, {0, 0, -0.1}) == black);
}

TEST_CASE("a gradient goes from one colour to the other and back within a period") {
  const crt::Gradient gradient{.color_a = {1, 0, 0, 1}, .color_b = {0, 1, 0.5, 0}, .scale = 10};
  CHECK(color_at(gradient, {3, 0, 4}) == Color{1, 0, 0, 1});
  CHECK(color_at(gradient, {3, 5, 4}) == Color{0, 1, 0.5, 0});
  const Color middle = color_at(gradient, {0, 2.5, 0});
  CHECK(middle.r == doctest::Approx(0.5));
  CHECK(middle.b == doctest::Approx(0.25));
  CHECK(middle.a == doctest::Approx(0.5));
  for (double y = 0; y < 4.85; y += 0.1) {
    CHECK(color_at(gradient, {0, y, 0}).r == doctest::Approx(color_at(gradient, {0, 10 - y, 0}).r));
    CHECK(color_at(gradient, {0, y, 0}).r >= color_at(gradient, {0, y + 0.1, 0}).r);
  }
}

TEST_CASE("noise lies between its two colours and scales with its scale") {
  const crt::Noise small{.octaves = 3, .scale = 1};
  const crt::Noise large{.octaves = 3, .scale = 8};
  for (double x = 0; x < 10; x += 0.31) {
    const Vec3 place(x, 1.3, -x);
    CHECK(level_at(small, place) >= 0);
    CHECK(level_at(small, place) <= 1);
    CHECK(level_at(small, place) == level_at(large, 8.0 * place));
  }
}

TEST_CASE("marble without turbulence is a wave, with it a shifted one") {
  const crt::Marble calm{.direction = {1, 0, 0}, .turbulence = 0, .scale = 2};
  CHECK(level_at(calm, {0, 5, 5}) == 1);
  CHECK(level_at(calm, {1, -5, 5}) == 0);
  CHECK(level_at(calm, {2, 0, 0}) == 1);
  const crt::Marble veined{.direction = {1, 0, 0}, .turbulence = 1, .scale = 2};
  CHECK(level_at(veined, {0.3, 5, 5}) != level_at(veined, {0.3, 4, 5}));
}

TEST_CASE("wood without turbulence has rings about its line") {
  const crt::Wood wood{.color_a = white,
                       .color_b = black,
                       .direction = {0, 2, 0},
                       .turbulence = 0,
                       .offset = {1, 0, 0}};
  CHECK(level_at(wood, {1, 0, 0}) == 1);
  CHECK(level_at(wood, {1, 9, 0}) == 1);
  CHECK(level_at(wood, {1.5, -3, 0}) == doctest::Approx(0));
  CHECK(level_at(wood, {1, 0, 2.5}) == doctest::Approx(0));
  CHECK(level_at(wood, {1.6, 0, 0.8}) == doctest::Approx(1));
}

TEST_CASE(
    "an image map lies upright, from u = 0 at its left and v = 0 at its lower edge, and repeats") {
  const auto image = std::make_shared<crt::Image>(4, 2);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 4; ++x) image->set(x, y, {x / 4.0, y / 2.0, 0, 1});
  }
  const PreparedPattern map = prepared(crt::ImageMap{.image = image, .repeat_u = 2, .repeat_v = 3});
  for (const double turns : {-5.0, 0.0, 1.0, 1e6}) {
    for (int y = 0; y < 2; ++y) {
      for (int x = 0; x < 4; ++x) {
        const double u = ((x + 0.5) / 4 + turns) / 2;
        const double v = ((2 - y - 0.5) / 2 + turns) / 3;
        const Color color = map.color({.u = u, .v = v});
        CHECK(color.r == doctest::Approx(x / 4.0).epsilon(1e-6));
        CHECK(color.g == doctest::Approx(y / 2.0).epsilon(1e-6));
      }
    }
  }
}

TEST_CASE("a pattern is opaque if all its colours are") {
  const Color glass = {1, 1, 1, 0.5};
  CHECK(prepared(crt::Checker{}).opaque());
  CHECK_FALSE(prepared(crt::Checker{.color_b = glass}).opaque());
  CHECK_FALSE(prepared(crt::Wood{.color_a = glass}).opaque());
  const auto image = std::make_shared<crt::Image>(2, 1);
  CHECK(prepared(crt::ImageMap{.image = image}).opaque());
  image->set(1, 0, glass);
  CHECK_FALSE(prepared(crt::ImageMap{.image = image}).opaque());
}

TEST_CASE("every pattern takes any point that a ray can reach") {
  const auto image = std::make_shared<crt::Image>(3, 3);
  const std::vector<crt::Pattern> patterns = {
      crt::Checker{.scale = 1e-100},
      crt::Stripes{.scale = 1e-100},
      crt::Gradient{.scale = 1e-100},
      crt::Noise{.octaves = 16, .scale = 1e-100},
      crt::Marble{.turbulence = 1e100, .scale = 1e-100},
      crt::Wood{.turbulence = 1e100, .scale = 1e-100},
      crt::ImageMap{.image = image, .repeat_u = 1e100, .repeat_v = 1e100}};
  for (const crt::Pattern& pattern : patterns) {
    const PreparedPattern ready = prepared(pattern);
    for (const double far : {0.0, 1.0, 1e20, 1e200, 1.7e308}) {
      for (const double sign : {-1.0, 1.0}) {
        const double c = sign * far;
        const Color color =
            ready.color({.position = {c, -c, c}, .normal = {0.6, 0, 0.8}, .u = c, .v = -c});
        REQUIRE(color.r >= 0);
        REQUIRE(color.r <= 1);
      }
    }
  }
}
