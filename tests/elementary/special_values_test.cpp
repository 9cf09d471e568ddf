// The elementary functions have the special values of the C standard's Annex F.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <crt/elementary.hpp>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace {

using crt::elementary::acos;
using crt::elementary::asin;
using crt::elementary::atan;
using crt::elementary::atan2;
using crt::elementary::cos;
using crt::elementary::exp;
using crt::elementary::hypot;
using crt::elementary::log;
using crt::elementary::log10;
using crt::elementary::log1p;
using crt::elementary::pow;
using crt::elementary::sin;
using crt::elementary::tan;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Says whether two doubles have the same bits.
bool same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

TEST_CASE("zeros keep their signs") {
  for (const double zero : {0.0, -0.0}) {
    CHECK(same(sin(zero), zero));
    CHECK(same(tan(zero), zero));
    CHECK(same(asin(zero), zero));
    CHECK(same(atan(zero), zero));
    CHECK(same(log1p(zero), zero));
    CHECK(same(cos(zero), 1));
    CHECK(same(exp(zero), 1));
    CHECK(same(log(zero), -infinity));
    CHECK(same(log10(zero), -infinity));
    CHECK(same(atan2(zero, 1), zero));
    CHECK(same(atan2(zero, 0), zero));
    CHECK(same(atan2(zero, -0.0), std::copysign(std::numbers::pi, zero)));
    CHECK(same(atan2(zero, -1), std::copysign(std::numbers::pi, zero)));
    CHECK(same(hypot(zero, zero), 0));
    CHECK(same(pow(zero, 3), zero));
    CHECK(same(pow(zero, 2), 0));
    CHECK(same(pow(zero, 0.5), 0));
    CHECK(same(pow(zero, -1), std::copysign(infinity, zero)));
    CHECK(same(pow(zero, -2), infinity));
  }
  CHECK(same(acos(1), 0));
  CHECK(same(log(1), 0));
  CHECK(same(log10(1), 0));
}

TEST_CASE("what has no value is one positive NaN, also of a negative one") {
  for (const double none : {nan, std::copysign(nan, -1.0), infinity, -infinity}) {
    CHECK(same(sin(none), nan));
    CHECK(same(cos(none), nan));
    CHECK(same(tan(none), nan));
    CHECK(same(asin(none), nan));
    CHECK(same(acos(none), nan));
  }
  const double negative = std::copysign(nan, -1.0);
  CHECK(same(exp(negative), nan));
  CHECK(same(log(negative), nan));
  CHECK(same(log10(negative), nan));
  CHECK(same(log1p(negative), nan));
  CHECK(same(atan2(negative, 1), nan));
  CHECK(same(atan2(1, negative), nan));
  CHECK(same(atan(negative), nan));
  CHECK(same(hypot(negative, 1), nan));
  CHECK(same(pow(negative, 1), nan));
  CHECK(same(pow(2, negative), nan));
  CHECK(same(asin(std::nextafter(1.0, 2.0)), nan));
  CHECK(same(acos(-2), nan));
  CHECK(same(log(-1), nan));
  CHECK(same(log10(-1), nan));
  CHECK(same(log1p(-2), nan));
  CHECK(same(pow(-1, 0.5), nan));
}

TEST_CASE("infinities have their limits") {
  CHECK(same(atan(infinity), std::numbers::pi / 2));
  CHECK(same(atan(-infinity), -std::numbers::pi / 2));
  CHECK(same(atan2(infinity, infinity), std::numbers::pi / 4));
  CHECK(same(atan2(-infinity, -infinity), -3 * std::numbers::pi / 4));
  CHECK(same(atan2(1, infinity), 0));
  CHECK(same(atan2(-1, -infinity), -std::numbers::pi));
  CHECK(same(exp(infinity), infinity));
  CHECK(same(exp(-infinity), 0));
  CHECK(same(exp(710), infinity));
  CHECK(same(exp(-746), 0));
  CHECK(same(log(infinity), infinity));
  CHECK(same(log10(infinity), infinity));
  CHECK(same(log1p(infinity), infinity));
  CHECK(same(log1p(-1), -infinity));
  CHECK(same(hypot(infinity, nan), infinity));
  CHECK(same(hypot(1, nan, -infinity), infinity));
  CHECK(same(pow(nan, 0), 1));
  CHECK(same(pow(1, nan), 1));
  CHECK(same(pow(-1, infinity), 1));
  CHECK(same(pow(0.5, infinity), 0));
  CHECK(same(pow(0.5, -infinity), infinity));
  CHECK(same(pow(2, infinity), infinity));
  CHECK(same(pow(-infinity, 3), -infinity));
  CHECK(same(pow(-infinity, -3), -0.0));
  CHECK(same(pow(-infinity, 2.5), infinity));
  CHECK(same(pow(2, 1024), infinity));
  CHECK(same(pow(-2, 1025), -infinity));
  CHECK(same(pow(2, 1e300), infinity));
  CHECK(same(pow(2, -1e300), 0));
  CHECK(same(pow(std::nextafter(1.0, 2.0), 1e300), infinity));
}

TEST_CASE("what can be exact is") {
  for (int i = -1074; i < 1024; ++i) REQUIRE(same(pow(2, i), std::ldexp(1.0, i)));
  for (int i = 0; i < 23; ++i) {
    REQUIRE(same(log10(pow(10, i)), i));
    REQUIRE(same(pow(pow(10, i), 0.5), std::sqrt(pow(10, i))));
  }
  CHECK(same(pow(2, 10), 1024));
  CHECK(same(pow(-3, 3), -27));
  CHECK(same(pow(27, -1), 1.0 / 27));
  CHECK(same(pow(10, 22), 1e22));
  CHECK(same(hypot(3, 4), 5));
  CHECK(same(hypot(3e300, 4e300), 5e300));
  CHECK(same(hypot(2, 3, 6), 7));
  CHECK(same(hypot(3 * 0x1p-1074, 4 * 0x1p-1074), 5 * 0x1p-1074));
  CHECK(same(sin(std::numbers::pi / 2), 1));
  CHECK(same(sin(std::numbers::pi), 0x1.1a62633145c07p-53));
  CHECK(same(tan(std::numbers::pi / 4), std::nextafter(1.0, 0.0)));
  CHECK(same(atan(1), std::numbers::pi / 4));
  CHECK(same(asin(1), std::numbers::pi / 2));
  CHECK(same(acos(-1), std::numbers::pi));
  CHECK(same(exp(1), std::numbers::e));
  CHECK(same(log(2), std::numbers::ln2));
}

TEST_CASE("the bits are those of every other machine") {
  std::uint64_t digest = 0xcbf29ce484222325;  // FNV-1a, by words
  const auto add = [&](double result) {
    digest = (digest ^ std::bit_cast<std::uint64_t>(result)) * 0x100000001b3;
  };
  std::mt19937_64 engine(1);
  for (int i = 0; i < 100000; ++i) {
    // Any double's bits, and one from -16 to 16.
    const auto any = std::bit_cast<double>(engine());
    const double near = static_cast<double>(engine() >> 11) * 0x1p-48 - 16;
    for (const double x : {any, near}) {
      for (const auto function : {sin, cos, tan, asin, acos, atan, exp, log, log1p, log10})
        add(function(x));
      add(asin(x / 16));
      add(acos(x / 16));
      for (const auto function : {atan2, pow}) add(function(x, near));
      add(pow(near, x));
      add(hypot(x, near, 1));
    }
  }
  CHECK(digest == 10902380288401385088u);
}

TEST_CASE("functions are odd or even to the bit") {
  for (double x = 1e-300; x < 1e300; x *= 1.7) {
    REQUIRE(same(sin(-x), -sin(x)));
    REQUIRE(same(cos(-x), cos(x)));
    REQUIRE(same(tan(-x), -tan(x)));
    REQUIRE(same(atan(-x), -atan(x)));
    REQUIRE(same(atan2(-x, -1), -atan2(x, -1)));
    REQUIRE(same(pow(-x, 3), -pow(x, 3)));
    REQUIRE(same(hypot(-x, 1), hypot(1, x)));
  }
}

}  // namespace
