#include "core/math/tone_curve.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <random>

namespace {

using namespace crt;
using namespace crt::core;

ToneCurve curve_of(ToneMap map, double exposure = 0) {
  Settings settings;
  settings.tone_map = map;
  settings.exposure = exposure;
  return ToneCurve(settings);
}

/// Returns the published curve, before any scale of ours.
long double published(long double x) {
  return x * (2.51L * x + 0.03L) / (x * (2.43L * x + 0.59L) + 0.14L);
}

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

TEST_CASE("without exposure and tone map light stays as it is, to the bit") {
  CHECK(curve_of(ToneMap::none).is_identity());
  CHECK(ToneCurve().is_identity());
  for (const double light : {0.0, 0.3, 1.0, 7.5, -2.0, infinity})
    CHECK(curve_of(ToneMap::none)(light) == light);
  CHECK_FALSE(curve_of(ToneMap::none, 0.5).is_identity());
  CHECK_FALSE(curve_of(ToneMap::filmic).is_identity());
}

TEST_CASE("an exposure of 1 doubles light, and any other one raises 2 to it") {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> exposures(-100, 100);
  for (const double light : {0.0, 0.125, 0.7, 3.0}) {
    CHECK(curve_of(ToneMap::none, 1)(light) == 2 * light);
    CHECK(curve_of(ToneMap::none, -3)(light) == light / 8);
    CHECK(curve_of(ToneMap::filmic, 1)(light) == curve_of(ToneMap::filmic)(2 * light));
  }
  for (int i = 0; i < 1000; ++i) {
    const double exposure = exposures(engine);
    CHECK(curve_of(ToneMap::none, exposure)(1.0) ==
          doctest::Approx(std::exp2(exposure)).epsilon(1e-14));
  }
}

TEST_CASE("the filmic curve rises from 0 to white, and middle grey stays what it is") {
  const ToneCurve filmic = curve_of(ToneMap::filmic);
  CHECK(filmic(0.0) == 0);
  CHECK(filmic(0.18) == doctest::Approx(0.18).epsilon(1e-14));
  double before = 0;
  for (double light = 0x1p-40; light < 0x1p20; light *= 1 + 0x1p-10) {
    const double shown = filmic(light);
    REQUIRE(shown > before);
    before = shown;
  }
  for (const double light : {10.02, 100.0, 1e30, 1e300, infinity}) {
    CHECK(filmic(light) > 1);
    CHECK(filmic(light) < 1.04);  // 2.51 / 2.43
  }
  CHECK(filmic(10.01) < 1);
  for (const double light : {-1.0, -infinity, not_a_number}) CHECK(filmic(light) == 0);
}

TEST_CASE("the filmic curve is the published one of scaled light, and by lanes the same") {
  const ToneCurve filmic = curve_of(ToneMap::filmic, -1.5);
  std::mt19937_64 engine(2);
  std::uniform_real_distribution<double> exponents(-30, 12);
  // The scale is where the published curve has the value of middle grey, found by halving.
  long double low = 0;
  long double high = 0.18L;
  for (int i = 0; i < 80; ++i) {
    const long double middle = (low + high) / 2;
    (published(middle) < 0.18L ? low : high) = middle;
  }
  const long double scale = low / 0.18L * std::exp2(-1.5L);
  for (std::size_t i = 0; i < 10000; ++i) {
    const double light = std::exp2(exponents(engine));
    const double shown = filmic(light);
    CHECK(shown == doctest::Approx(static_cast<double>(published(scale * light))).epsilon(1e-14));
    CHECK(double{filmic(lanes_of(light))[i % lane_count]} == shown);
  }
}

}  // namespace
