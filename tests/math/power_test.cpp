#include "core/math/power.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

namespace {

using namespace crt::core;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Returns the error in units of 2^-52 of the true number.
long double error_of(double found, long double truth) {
  return std::abs(found - truth) / std::abs(truth) * 0x1p52L;
}

bool is_nan(double x) {
  return x != x;
}

TEST_CASE("logarithms are true to two units, near 1 as well, and by lanes the same") {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> exponents(-1022, 1024);
  std::uniform_real_distribution<double> small(-60, -1);
  for (std::size_t i = 0; i < 1000000; ++i) {
    const double beside_one = 1 + (i % 4 == 1 ? -1 : 1) * std::exp2(small(engine));
    const double x = i % 2 == 0 ? std::exp2(exponents(engine)) : beside_one;
    const double found = logarithm2(x);
    if (x == 1) {
      REQUIRE(found == 0);
    } else {
      REQUIRE(error_of(found, std::log2(static_cast<long double>(x))) <= 2);
    }
    REQUIRE(double{logarithm2(lanes_of(x))[i % lane_count]} == found);
  }
}

TEST_CASE("powers of two are true to a unit, up to where they end, and by lanes the same") {
  std::mt19937_64 engine(2);
  std::uniform_real_distribution<double> exponents(-1022, 1024);
  for (std::size_t i = 0; i < 1000000; ++i) {
    const double e = exponents(engine);
    const double found = exponential2(e);
    REQUIRE(error_of(found, std::exp2(static_cast<long double>(e))) <= 1);
    REQUIRE(double{exponential2(lanes_of(e))[i % lane_count]} == found);
  }
  for (int e = -1074; e < 1024; ++e) REQUIRE(exponential2(double{1} * e) == std::ldexp(1.0, e));
  CHECK(exponential2(1024.0) == infinity);
  CHECK(exponential2(infinity) == infinity);
  CHECK(exponential2(-1080.0) == 0);
  CHECK(exponential2(-infinity) == 0);
}

TEST_CASE("powers are as true as their documentation says, and by lanes the same") {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> exponents(-1000, 0);
  std::uniform_real_distribution<double> up_to_one(0, 1);
  for (std::size_t i = 0; i < 1000000; ++i) {
    const double base = i % 2 == 0 ? up_to_one(engine) : std::exp2(exponents(engine));
    const double exponent = i % 3 == 0 ? up_to_one(engine) : std::exp2(10 * up_to_one(engine));
    const long double truth =
        std::pow(static_cast<long double>(base), static_cast<long double>(exponent));
    const double found = power(base, exponent);
    if (truth >= std::numeric_limits<double>::min()) {
      REQUIRE(error_of(found, truth) <= 2 + 4 * std::abs(std::log2(truth)));
    } else {
      REQUIRE(found <= 0x1p-1021);
    }
    REQUIRE(double{power(lanes_of(base), lanes_of(exponent))[i % lane_count]} == found);
  }
}

TEST_CASE("rough powers of what is at most 1 are within 10^-9, and by lanes the same") {
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> exponents(-1074, 0);
  std::uniform_real_distribution<double> up_to_one(0, 1);
  std::uniform_real_distribution<double> of_gammas(-1, 1);
  for (std::size_t i = 0; i < 1000000; ++i) {
    const double base = i % 2 == 0 ? up_to_one(engine) : std::exp2(exponents(engine));
    const double exponent = std::pow(10, of_gammas(engine));
    const long double truth =
        std::pow(static_cast<long double>(base), static_cast<long double>(exponent));
    const double found = rough_power(base, exponent);
    REQUIRE(std::abs(found - truth) <= 1e-9L);
    REQUIRE(double{rough_power(lanes_of(base), lanes_of(exponent))[i % lane_count]} == found);
  }
  for (const double exponent : {0.1, 1 / 2.2, 1.0, 10.0}) {
    CHECK(rough_power(0.0, exponent) == doctest::Approx(0).epsilon(1e-9));
    CHECK(rough_power(1.0, exponent) == 1);
  }
}

TEST_CASE("cube roots are true to a unit, and by lanes the same") {
  std::mt19937_64 engine(4);
  std::uniform_real_distribution<double> exponents(-1022, 1024);
  for (std::size_t i = 0; i < 1000000; ++i) {
    const double x = std::exp2(exponents(engine));
    const double found = cube_root(x);
    REQUIRE(error_of(found, std::cbrt(static_cast<long double>(x))) <= 1);
    REQUIRE(double{cube_root(lanes_of(x))[i % lane_count]} == found);
  }
  CHECK(cube_root(0.0) == 0);
  CHECK(cube_root(1.0) == 1);
  CHECK(cube_root(infinity) == infinity);
  CHECK(is_nan(cube_root(std::numeric_limits<double>::quiet_NaN())));
}

TEST_CASE("powers at the ends of what there is") {
  for (const double exponent : {0x1p-1000, 0.5, 1.0, 2.2, 1e300}) {
    CHECK(power(0.0, exponent) == 0);
    CHECK(power(1.0, exponent) == 1);
  }
  CHECK(power(0.0, 0.0) == 1);
  CHECK(power(0.5, 0.0) == 1);
  CHECK(power(0.5, 1e300) == 0);
  CHECK(power(2.0, 1e300) == infinity);
  CHECK(power(infinity, 2.2) == infinity);
  CHECK(power(0.25, 0.5) == 0.5);
  CHECK(is_nan(power(std::numeric_limits<double>::quiet_NaN(), 0.5)));
}

}  // namespace
