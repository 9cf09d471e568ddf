#include "core/shading/noise.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace crt::core;
using crt::Vec3;

namespace {

/// Returns the most that the gradients of the corners of a cell can add up to at a point of it.
double largest_possible_sum(const Vec3& p) {
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    double distances[3];
    for (int axis = 0; axis < 3; ++axis) {
      const double s = p[axis];
      const double fade = s * s * s * (s * (s * 6 - 15) + 10);
      const bool upper = (corner >> axis & 1) != 0;
      weight *= upper ? fade : 1 - fade;
      distances[axis] = std::abs(s - (upper ? 1 : 0));
    }
    std::sort(distances, distances + 3);
    sum += weight * (distances[1] + distances[2]);
  }
  return sum;
}

}  // namespace

TEST_CASE("noise is normalised by the most that its gradients can add up to") {
  constexpr double divisor = 1.0363538112118028;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  double largest = largest_possible_sum({0.518508, 0.355257, 0.5});
  for (int i = 0; i < 300'000; ++i) {
    largest = std::max(largest,
                       largest_possible_sum({uniform(random), uniform(random), uniform(random)}));
  }
  CHECK(largest <= divisor);
  CHECK(largest == doctest::Approx(divisor).epsilon(1e-9));
}

TEST_CASE("noise fills most of [-1, 1], has a mean of 0 and is symmetric") {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1000, 1000);
  double sum = 0;
  double least = 0;
  double most = 0;
  constexpr int count = 300'000;
  for (int i = 0; i < count; ++i) {
    const double value = gradient_noise({uniform(random), uniform(random), uniform(random)});
    least = std::min(least, value);
    most = std::max(most, value);
    sum += value;
  }
  CHECK(std::abs(sum / count) < 0.005);
  CHECK(most > 0.75);
  CHECK(most <= 1);
  CHECK(least < -0.75);
  CHECK(least >= -1);
}

TEST_CASE("noise is 0 at whole coordinates and has no other zeros in common between seeds") {
  CHECK(gradient_noise({3, -7, 12}) == 0);
  CHECK(gradient_noise({0, 0, 0}, 5) == 0);
  CHECK(gradient_noise({0.3, 0.4, 0.5}, 1) != gradient_noise({0.3, 0.4, 0.5}, 2));
}

TEST_CASE("noise and its slope are continuous across the borders of cells") {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-20, 20);
  constexpr double step = 1e-6;
  for (int i = 0; i < 2000; ++i) {
    Vec3 border(uniform(random), uniform(random), uniform(random));
    const int axis = i % 3;
    border[axis] = std::round(border[axis]);
    Vec3 before = border;
    Vec3 after = border;
    before[axis] -= step;
    after[axis] += step;
    const double here = gradient_noise(border);
    const double slope_before = (here - gradient_noise(before)) / step;
    const double slope_after = (gradient_noise(after) - here) / step;
    REQUIRE(std::abs(slope_before) < 5);
    REQUIRE(std::abs(slope_after - slope_before) < 1e-3);
  }
}

TEST_CASE("noise does not repeat after 256 cells, as a table of permutations would make it") {
  int same = 0;
  for (int i = 0; i < 100; ++i) {
    const Vec3 place(i + 0.3, 0.7, 0.2);
    if (gradient_noise(place) == gradient_noise(place + Vec3(256, 0, 0))) ++same;
  }
  CHECK(same < 5);
}

TEST_CASE("noise takes any coordinate there is") {
  for (const double huge :
       {1e15, 4503599627370497.5, 1e19, 1e100, 1e300, 1.7e308, -1e19, -1.7e308}) {
    for (const Vec3& place :
         {Vec3(huge, 0.5, 0.5), Vec3(huge, huge, huge), Vec3(0.5, 0.25, -huge)}) {
      CHECK(std::abs(gradient_noise(place)) <= 1);
      CHECK(std::abs(fractal_noise(place, 16)) <= 1);
    }
  }
  const double inf = std::numeric_limits<double>::infinity();
  CHECK(std::abs(gradient_noise({inf, inf - inf, -inf})) <= 1);
}

TEST_CASE("octaves add detail and stay in range") {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(-50, 50);
  for (int i = 0; i < 5000; ++i) {
    const Vec3 place(uniform(random), uniform(random), uniform(random));
    REQUIRE(fractal_noise(place, 1) == gradient_noise(place, 0));
    for (const int octaves : {2, 5, 16}) REQUIRE(std::abs(fractal_noise(place, octaves)) <= 1);
  }
  CHECK(fractal_noise({1, 2, 3}, 4) != 0);
}
