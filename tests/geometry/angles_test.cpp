#include "core/geometry/angles.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

using namespace crt::core;

namespace {

/// Returns the turn of (x, y), in [-1/2, 1/2], to more digits than a double has.
long double true_turn(double x, double y) {
  return std::atan2(static_cast<long double>(y), static_cast<long double>(x)) /
         (2 * std::numbers::pi_v<long double>);
}

/// Coordinates are of all sizes that are at least 1e-290. The two of a point are alike or far from
/// each other.
class Coordinates {
 public:
  std::array<double, 2> next() {
    const int size = sizes_(engine_);
    return {scaled(size),
            scaled(size - (engine_() % 2 == 0 ? 0 : static_cast<int>(engine_() % 60)))};
  }

 private:
  double scaled(int exponent) {
    const double number = std::ldexp(fractions_(engine_), exponent);
    return engine_() % 2 == 0 ? number : -number;
  }

  std::mt19937_64 engine_{1};
  std::uniform_int_distribution<int> sizes_{-900, 1000};
  std::uniform_real_distribution<double> fractions_{0.5, 1};
};

}  // namespace

TEST_CASE("angles are the true ones to a few roundings") {
  Coordinates coordinates;
  for (std::size_t i = 0; i < 1000000; ++i) {
    const auto [x, y] = coordinates.next();
    const long double true_angle = true_turn(x, y);
    const double quarter = quarter_turn(std::abs(x), std::abs(y));
    const long double true_quarter = true_turn(std::abs(x), std::abs(y));
    REQUIRE(std::abs(quarter - true_quarter) <= 0x1p-53L);
    REQUIRE(std::abs(quarter - true_quarter) <= 0x1p-51L * true_quarter);
    const double angle = turn(x, y);
    REQUIRE(angle >= 0);
    REQUIRE(angle < 1);
    const long double apart = std::abs(angle - true_angle);
    REQUIRE(std::min(apart, std::abs(1 - apart)) <= 0x1.8p-53L);
    REQUIRE(std::abs(latitude(std::abs(x), y) - (0.5L + 2 * true_turn(std::abs(x), y))) <=
            0x1.8p-52L);
  }
}

TEST_CASE("angles of the axes and of what is half way between them are exact") {
  for (const double size : {1.0, 1e-300, 5e-324, 1e300}) {
    CHECK(turn(size, 0.0) == 0);
    CHECK(turn(size, size) == 0.125);
    CHECK(turn(0.0, size) == 0.25);
    CHECK(turn(-size, size) == 0.375);
    CHECK(turn(-size, 0.0) == 0.5);
    CHECK(turn(-size, -0.0) == 0.5);
    CHECK(turn(-size, -size) == 0.625);
    CHECK(turn(0.0, -size) == 0.75);
    CHECK(turn(size, -size) == 0.875);
    CHECK(turn(size, -0.0) == 0);
    CHECK(latitude(size, 0.0) == 0.5);
    CHECK(latitude(0.0, size) == 1);
    CHECK(latitude(0.0, -size) == 0);
  }
  CHECK(turn(0.0, 0.0) == 0);
  CHECK(turn(-0.0, -0.0) == 0);
  // A whole turn counts as none.
  CHECK(turn(1.0, -1e-30) == 0);
}

TEST_CASE("angles side by side are what each is by itself, to the last bit") {
  Coordinates coordinates;
  for (int i = 0; i < 100000; ++i) {
    Lanes x;
    Lanes y;
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const auto next = coordinates.next();
      x[lane] = next[0];
      y[lane] = next[1];
    }
    const Lanes turns = turn(x, y);
    const Lanes latitudes = latitude(abs(x), y);
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const double one_turn = turn(double{x[lane]}, double{y[lane]});
      const double one_latitude = latitude(std::abs(double{x[lane]}), double{y[lane]});
      REQUIRE(double{turns[lane]} == one_turn);
      REQUIRE(double{latitudes[lane]} == one_latitude);
    }
  }
}

TEST_CASE("sine and cosine up to an eighth of a turn are the true ones") {
  std::mt19937_64 engine(2);
  std::uniform_real_distribution<double> eighths(-1, 1);
  for (std::size_t i = 0; i < 1000000; ++i) {
    const double q = i == 0 ? 0 : i == 1 ? 1 : i == 2 ? -1 : eighths(engine);
    const long double angle = std::numbers::pi_v<long double> / 4 * q;
    const auto [sine, cosine] = of_eighth_turns(q);
    REQUIRE(std::abs(sine - std::sin(angle)) <= 0x1p-52L);
    REQUIRE(std::abs(cosine - std::cos(angle)) <= 0x1p-52L);
    const auto by_lanes = of_eighth_turns(lanes_of(q));
    REQUIRE(by_lanes.sine[i % lane_count] == sine);
    REQUIRE(by_lanes.cosine[i % lane_count] == cosine);
  }
}
