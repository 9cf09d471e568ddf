#include "core/math/interval.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

using namespace crt::core;

namespace {

class Numbers {
 public:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(bits_);
  }
  /// Returns a number of any size, of either sign, or a small whole one.
  double any() {
    if (uniform(0, 1) < 0.3) return std::floor(uniform(-4, 5));
    return std::exp(uniform(-20, 20)) * (uniform(0, 1) < 0.5 ? 1 : -1);
  }
  /// Returns an interval from `least` on, of which some are points.
  Interval interval(double least, double greatest) {
    const double a = std::clamp(any(), least, greatest);
    const double b = uniform(0, 1) < 0.2 ? a : std::clamp(a + any(), least, greatest);
    return {std::min(a, b), std::max(a, b)};
  }
  double within(const Interval& i) { return std::clamp(uniform(i.lo, i.hi), i.lo, i.hi); }

 private:
  std::mt19937_64 bits_{7};
};

/// Requires that the range of a function holds its true values.
template <class Range, class Function>
void check_range(const Range& range, const Function& function, double least = -1e9,
                 double greatest = 1e9) {
  Numbers numbers;
  for (int i = 0; i < 20000; ++i) {
    const Interval x = numbers.interval(least, greatest);
    const Interval y = range(x);
    REQUIRE(y.lo <= y.hi);
    for (const double place : {x.lo, x.hi, numbers.within(x), numbers.within(x)}) {
      const long double truth = function(static_cast<long double>(place));
      REQUIRE(y.lo <= truth);
      REQUIRE(truth <= y.hi);
    }
  }
}

/// Requires that a result holds those of all numbers of both operands.
template <class Range, class Function>
void check_ranges(const Range& range, const Function& function) {
  Numbers numbers;
  for (int i = 0; i < 20000; ++i) {
    const Interval a = numbers.interval(-1e9, 1e9);
    const Interval b = numbers.interval(-1e9, 1e9);
    const Interval c = range(a, b);
    for (const double x : {a.lo, a.hi, numbers.within(a)}) {
      for (const double y : {b.lo, b.hi, numbers.within(b)}) {
        const long double truth = function(x, y);
        if (!std::isfinite(truth)) continue;
        REQUIRE(c.lo <= truth);
        REQUIRE(truth <= c.hi);
      }
    }
  }
}

}  // namespace

TEST_CASE("the four operations hold what their operands allow") {
  using Long = long double;
  check_ranges([](auto a, auto b) { return a + b; }, [](Long a, Long b) { return a + b; });
  check_ranges([](auto a, auto b) { return a - b; }, [](Long a, Long b) { return a - b; });
  check_ranges([](auto a, auto b) { return a * b; }, [](Long a, Long b) { return a * b; });
  check_ranges([](auto a, auto b) { return a / b; }, [](Long a, Long b) { return a / b; });
}

TEST_CASE("functions hold the true values of every number of an interval") {
  using Long = long double;
  check_range([](auto x) { return square(x); }, [](Long x) { return x * x; });
  check_range(
      square_root, [](Long x) { return std::sqrt(x); }, 0);
  check_range(
      exponential, [](Long x) { return std::exp(x); }, -800, 700);
  check_range(
      logarithm, [](Long x) { return std::log(x); }, 1e-300);
  check_range(sine, [](Long x) { return std::sin(x); });
  check_range(cosine, [](Long x) { return std::cos(x); });
  const auto middle = [](const Interval& x) {
    const double center = x.lo + 0.5 * (x.hi - x.lo);
    return Interval{center, center};
  };
  check_range([&](auto x) { return wave(middle(x), x).sine; }, [](Long x) { return std::sin(x); });
  check_range([&](auto x) { return wave(middle(x), x).cosine; },
              [](Long x) { return std::cos(x); });
  check_range(
      [](auto x) {
        return wave(x, {x.lo - 0.01, x.hi + 0.05}).sine_in_middle;
      },
      [](Long x) { return std::sin(x); });
  check_range(
      [](auto x) {
        return wave(x, {x.lo - 0.01, x.hi + 0.05}).cosine_in_middle;
      },
      [](Long x) { return std::cos(x); });
  check_range(tangent, [](Long x) { return std::tan(x); });
  check_range(
      arc_sine, [](Long x) { return std::asin(x); }, -1, 1);
  check_range(
      arc_cosine, [](Long x) { return std::acos(x); }, -1, 1);
  check_range(arc_tangent, [](Long x) { return std::atan(x); });
  for (const double n : {2.0, 3.0, 4.0, 7.0, 8.0, 9.0, 12.0}) {
    check_range([n](auto x) { return whole_power(x, n); },
                [n](Long x) { return std::pow(x, static_cast<Long>(n)); });
  }
  for (const double e : {0.3, 0.5, 1.7, 6.5}) {
    check_range([e](auto x) { return power(x, e); },
                [e](Long x) { return std::pow(x, static_cast<Long>(e)); }, 0);
  }
}

TEST_CASE("intervals are narrow where functions are smooth, and turns are seen") {
  CHECK(sine({1, 1}).width() < 1e-14);
  CHECK(sine({1, 2}).hi == 1);
  CHECK(sine({4, 5}).lo == -1);
  CHECK(sine({2, 4}).hi < 0.91);
  CHECK(cosine({-0.1, 0.1}).hi == 1);
  CHECK(square({-1, 2}).lo == 0);
  CHECK(whole_power({-2, 1}, 4).lo == 0);
  CHECK(whole_power({-2, 1}, 3).lo < -7.9);
  CHECK(tangent({1, 2}).hi == HUGE_VAL);
  CHECK(tangent({2, 3}).hi < 0);
}

TEST_CASE("unbounded intervals stay without NaN") {
  const Interval all = Interval::everything();
  const std::vector<Interval> some = {
      all, {0, 0}, {0, HUGE_VAL}, {-HUGE_VAL, 0}, {-1e308, 1e308}, {1e-308, 1e308}};
  for (const Interval& a : some) {
    for (const Interval& b : some) {
      for (const Interval& c : {a + b, a - b, a * b, a / b, square(a), exponential(a), sine(a),
                                arc_tangent(a), whole_power(a, 3), whole_power(a, 10)}) {
        CHECK(c.lo <= c.hi);
        CHECK(c.lo < HUGE_VAL);
        CHECK(c.hi > -HUGE_VAL);
      }
    }
  }
}
