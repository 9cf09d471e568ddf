#include "core/math/patch_series.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace crt::core;

namespace {

class Terms {
 public:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(bits_);
  }
  /// Returns a series whose terms fall off as those of a small patch do, with an error or without.
  PatchSeries series(double constant, double spread) {
    PatchSeries result;
    std::size_t place = 0;
    for (std::size_t d = 0; d <= PatchSeries::degree; ++d) {
      for (std::size_t j = 0; j <= d; ++j) {
        result.terms[place++] = std::pow(spread, static_cast<double>(d)) * uniform(-1, 1);
      }
    }
    result.terms[0] = constant;
    result.error = uniform(0, 1) < 0.5 ? 0 : uniform(0, 1) * std::pow(spread, 5);
    return result;
  }

 private:
  std::mt19937_64 bits_{5};
};

long double polynomial(const PatchSeries& a, long double s, long double t) {
  long double sum = 0;
  for (std::size_t i = 0; i <= PatchSeries::degree; ++i) {
    for (std::size_t j = 0; i + j <= PatchSeries::degree; ++j) {
      sum += a.terms[PatchSeries::place(i, j)] * std::pow(s, static_cast<long double>(i)) *
             std::pow(t, static_cast<long double>(j));
    }
  }
  return sum;
}

/// Requires that the result of an operation holds what it does to any functions that the operands
/// hold: those that are off by all of their error, either way, at random places.
template <class Operation, class OfNumbers>
void check_operation(double constant, const Operation& operation, const OfNumbers& of_numbers) {
  Terms terms;
  for (int i = 0; i < 3000; ++i) {
    const double spread = terms.uniform(0, 0.2);
    const PatchSeries a = terms.series(constant * terms.uniform(0.5, 2), spread);
    const PatchSeries b = terms.series(terms.uniform(-1, 1), spread);
    const PatchSeries result = operation(a, b);
    for (int k = 0; k < 4; ++k) {
      const long double s = terms.uniform(-1, 1);
      const long double t = terms.uniform(-1, 1);
      const long double x = polynomial(a, s, t) + a.error * (k % 2 == 0 ? 1 : -1);
      const long double y = polynomial(b, s, t) + b.error * (k / 2 == 0 ? 1 : -1);
      const long double truth = of_numbers(x, y);
      REQUIRE(std::abs(polynomial(result, s, t) - truth) <= result.error + 1e-18L);
      const Interval range = range_of(result);
      REQUIRE(range.lo <= truth);
      REQUIRE(truth <= range.hi);
    }
  }
}

constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("sums and products of series hold those of the functions") {
  using Series = const PatchSeries&;
  check_operation(
      1, [](Series a, Series b) { return a + b; }, [](auto x, auto y) { return x + y; });
  check_operation(
      1, [](Series a, Series b) { return a - b; }, [](auto x, auto y) { return x - y; });
  check_operation(
      1, [](Series a, Series b) { return a * b; }, [](auto x, auto y) { return x * y; });
  check_operation(
      1, [](Series a, Series) { return square(a); }, [](auto x, auto) { return x * x; });
  const Interval third = Interval::of(1) / Interval::of(3);
  check_operation(
      1, [&](Series a, Series) { return a * third + third; },
      [](auto x, auto) { return x / 3 + 1.0L / 3; });
  check_operation(
      1, [&](Series a, Series) { return -a - third; }, [](auto x, auto) { return -x - 1.0L / 3; });
}

TEST_CASE("roots, inverses and positive parts of series hold those of the functions") {
  using Series = const PatchSeries&;
  check_operation(
      2, [](Series a, Series) { return root(a); }, [](auto x, auto) { return std::sqrt(x); });
  check_operation(
      2, [](Series a, Series) { return inverse(a); }, [](auto x, auto) { return 1 / x; });
  check_operation(
      -2, [](Series a, Series) { return inverse(a); }, [](auto x, auto) { return 1 / x; });
  check_operation(
      0.01, [](Series a, Series) { return positive_part(a); },
      [](auto x, auto) { return x > 0 ? x : 0 * x; });
}

TEST_CASE("a root of a series is off by no more than its fifth power") {
  for (const double size : {0.2, 0.02}) {
    const PatchSeries a = PatchSeries::linear(1, size, 0);
    CHECK(root(a).error < 0.1 * std::pow(size, 5));
    CHECK(inverse(a).error < 2 * std::pow(size, 5));
  }
}

TEST_CASE("where a series knows nothing, nothing that is made of it knows anything") {
  const PatchSeries at_zero = PatchSeries::linear(0.1, 1, 0);
  CHECK(root(at_zero).error == infinite);
  CHECK(inverse(at_zero).error == infinite);
  const PatchSeries nothing{.error = infinite};
  CHECK((nothing * Interval{0, 0}).error == infinite);
  CHECK((nothing * PatchSeries{}).error == infinite);
  CHECK((nothing + at_zero).error == infinite);
  CHECK(root(nothing).error == infinite);
  CHECK(range_of(nothing).lo == -infinite);
  CHECK(range_of(nothing).hi == infinite);
}

TEST_CASE("a part of a series is a series of its own") {
  PatchSeries a = PatchSeries::of(Interval{1.5, 1.5});
  a.terms[PatchSeries::place(1, 0)] = 8;
  a.terms[PatchSeries::place(2, 2)] = 9;
  a.terms[PatchSeries::place(1, 3)] = 5;
  for (const double s : {-0.5, 0.5}) {
    for (const double t : {-0.5, 0.5}) {
      const PatchSeries part = part_of(a, s, t, 0.5);
      for (const double x : {-1.0, 0.3, 1.0}) {
        const double there = value_at(a, s + 0.5 * x, t - 0.5 * x);
        CHECK(value_at(part, x, -x) == doctest::Approx(there));
        CHECK(std::abs(there - value_at(a, s, t)) <= change_in_quarter(a));
      }
    }
  }
}
