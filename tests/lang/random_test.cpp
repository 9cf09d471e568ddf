// rand() and noise() give equal numbers on every platform, and are as random and as smooth as they
// say.
#include "lang/random.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

namespace {

using crt::Vec3;
using crt::lang::gradient_noise;

/// Returns a point that lies nowhere in particular.
Vec3 some_point(int i) {
  return Vec3(std::sin(i * 1.7) * 40, std::cos(i * 2.3) * 40, std::sin(i * 0.9 + 1) * 40);
}

}  // namespace

TEST_CASE("the generator is SplitMix64: its first numbers from the seed 0 are known") {
  crt::lang::Random random;
  CHECK(random.next() == 0xE220A8397B1DCDAFU);
  CHECK(random.next() == 0x6E789E6AA1B965F4U);
  CHECK(random.next() == 0x06C45D188009454FU);
}

TEST_CASE("the generator of 2015 gives what java.util.Random(1337) gives") {
  crt::lang::Random2015 random;
  CHECK(random.next_float() == 0x1.51e251164549dp-1);
  CHECK(random.next_float() == 0x1.60e46a6feaa42p-1);
  CHECK(random.next_float() == 0x1.c43c50fbb9d68p-1);
  for (int i = 3; i < 99; ++i) random.next_float();
  CHECK(random.next_float() == 0x1.567bcceb83aeap-2);
}

TEST_CASE("random numbers fill [0, 1) evenly") {
  crt::lang::Random random;
  constexpr int count = 100'000;
  constexpr int bins = 10;
  int filled[bins] = {};
  for (int i = 0; i < count; ++i) {
    const double number = random.next_float();
    REQUIRE((number >= 0 && number < 1));
    ++filled[static_cast<int>(number * bins)];
  }
  // The bound is six standard deviations of a binomial distribution.
  const double deviation = 6 * std::sqrt(count * 0.1 * 0.9);
  for (const int in_bin : filled) CHECK(std::abs(in_bin - count / bins) < deviation);
}

TEST_CASE("noise is 0 at whole points and everywhere far out, and within [-1, 1]") {
  CHECK(gradient_noise(Vec3(0)) == 0);
  CHECK(gradient_noise(Vec3(-3, 7, 12)) == 0);
  CHECK(gradient_noise(Vec3(1e17, 0.5, 0.5)) == 0);
  CHECK(gradient_noise(Vec3(std::nan(""), 0.5, 0.5)) == 0);
  double least = 0;
  double most = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double value = gradient_noise(some_point(i));
    least = std::min(least, value);
    most = std::max(most, value);
  }
  CHECK(least >= -1);
  CHECK(most <= 1);
  CHECK(least < -0.6);
  CHECK(most > 0.6);
}

TEST_CASE("noise is smooth: across cells its values and slopes agree from both sides") {
  constexpr double step = 1e-6;
  for (int i = 0; i < 200; ++i) {
    Vec3 point = some_point(i);
    point.x = std::round(point.x);  // on the border of two cells
    const Vec3 aside(step, 0, 0);
    const double slope_before = (gradient_noise(point) - gradient_noise(point - aside)) / step;
    const double slope_after = (gradient_noise(point + aside) - gradient_noise(point)) / step;
    CHECK(slope_before == doctest::Approx(slope_after).epsilon(1e-3).scale(1));
  }
}
