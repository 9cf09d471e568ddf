#include "core/math/quick_angle.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <crt/elementary.hpp>
#include <numbers>
#include <random>

namespace {

using namespace crt::core;

/// Checks an angle, and that lanes have the same bits.
void check_angle(double y, double x) {
  const double found = quick_atan2(y, x);
  INFO("(", x, ", ", y, ")");
  // The elementary function has an error of 2^-52 at most.
  REQUIRE(std::abs(found - crt::elementary::atan2(y, x)) <= 0x1p-50 - 0x1p-52);
  const Lanes by_lanes = quick_atan2(lanes_of(1, y, -2, y), lanes_of(3, x, 0, -x));
  REQUIRE(double{by_lanes[1]} == found);
  REQUIRE(double{by_lanes[0]} == quick_atan2(1.0, 3.0));
  REQUIRE(double{by_lanes[3]} == quick_atan2(y, -x));
}

TEST_CASE("quick angles are true to 2^-50 all around, and by lanes the same") {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> turns(-std::numbers::pi, std::numbers::pi);
  std::uniform_real_distribution<double> sizes(-300, 300);
  for (int i = 0; i < 300000; ++i) {
    const double angle = turns(engine);
    const double size = i % 2 == 0 ? 1 : std::exp2(sizes(engine));
    check_angle(size * std::sin(angle), size * std::cos(angle));
  }
}

TEST_CASE("quick angles are true beside axes, diagonals and where the polynomial changes") {
  std::mt19937_64 engine(2);
  std::uniform_real_distribution<double> exponents(-80, -1);
  for (int i = 0; i < 300000; ++i) {
    const double beside = (i % 2 == 0 ? 1 : -1) * std::exp2(exponents(engine));
    const double angle = (i % 16) * std::numbers::pi / 8;
    const double x = std::cos(angle);
    const double y = std::sin(angle);
    check_angle(y + beside * x, x - beside * y);
  }
}

TEST_CASE("quick angles along axes are quarters of turns, and there is one of nothing") {
  CHECK(quick_atan2(0.0, 2.0) == 0);
  CHECK(quick_atan2(2.0, 0.0) == std::numbers::pi / 2);
  CHECK(quick_atan2(-2.0, 0.0) == -std::numbers::pi / 2);
  CHECK(quick_atan2(0.0, -2.0) == std::numbers::pi);
  CHECK(quick_atan2(-0.0, -2.0) == std::numbers::pi);
  CHECK(quick_atan2(0.0, 0.0) == 0);
}

}  // namespace
