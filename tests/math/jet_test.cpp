#include "core/math/jet.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/math/patch_series.hpp"

using namespace crt::core;

namespace {

class Places {
 public:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(bits_);
  }
  Interval interval() {
    const double a = uniform(-2, 2);
    const double b = uniform(0, 1) < 0.2 ? a : a + std::exp(uniform(-8, 0));
    return {a, b};
  }
  double within(const Interval& i) { return std::clamp(uniform(i.lo, i.hi), i.lo, i.hi); }

 private:
  std::mt19937_64 bits_{11};
};

using Point = std::array<Jet, 3>;

Point jets_of(const std::array<Interval, 3>& box) {
  Point point{};
  for (std::size_t i = 0; i < 3; ++i) {
    point[i].value = box[i];
    point[i].slope[i] = Interval::of(1);
  }
  return point;
}

/// Requires of a function of jets, and of the same one of numbers, that values and slopes hold what
/// happens between any two points of a box.
template <class OfJets, class OfNumbers>
void check_function(const OfJets& of_jets, const OfNumbers& of_numbers) {
  Places places;
  for (int i = 0; i < 5000; ++i) {
    const std::array<Interval, 3> box = {places.interval(), places.interval(), places.interval()};
    const Jet result = of_jets(jets_of(box));
    std::array<std::array<long double, 3>, 2> points;
    std::array<long double, 2> values;
    for (std::size_t k = 0; k < 2; ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis) points[k][axis] = places.within(box[axis]);
      values[k] = of_numbers(points[k][0], points[k][1], points[k][2]);
      REQUIRE(result.value.lo <= values[k]);
      REQUIRE(values[k] <= result.value.hi);
    }
    long double low = 0;
    long double high = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const long double step = points[1][axis] - points[0][axis];
      const Interval& slope = result.slope[axis];
      if (step == 0) continue;
      low += std::min(slope.lo * step, slope.hi * step);
      high += std::max(slope.lo * step, slope.hi * step);
    }
    const long double rounding = 1e-17L;
    REQUIRE(low - rounding <= values[1] - values[0]);
    REQUIRE(values[1] - values[0] <= high + rounding);
  }
}

}  // namespace

TEST_CASE("sums and products of jets have the slopes of the numbers they stand for") {
  const Interval seven = Interval::of(7);
  check_function([&](const Point& p) { return p[0] * p[1] - square(p[2]) * seven + p[1] + seven; },
                 [](auto x, auto y, auto z) { return x * y - z * z * 7 + y + 7; });
  check_function([&](const Point& p) { return -(p[0] - seven) * (p[1] + p[2]); },
                 [](auto x, auto y, auto z) { return -(x - 7) * (y + z); });
}

TEST_CASE("a root of jets has its slopes, which nothing bounds where it may be 0") {
  check_function([](const Point& p) { return root(square(p[0]) + square(p[1])); },
                 [](auto x, auto y, auto) { return std::sqrt(x * x + y * y); });
  const Jet at_zero = root(square(jets_of({Interval{-1, 1}, Interval{}, Interval{}})[0]));
  CHECK(at_zero.value.contains(0));
  CHECK(at_zero.value.contains(1));
  CHECK(at_zero.slope[0].lo == -std::numeric_limits<double>::infinity());
}

TEST_CASE("what is cut off at 0 has the slopes of both sides") {
  const auto cut = [](auto x) { return x > 0 ? x : 0 * x; };
  check_function(
      [](const Point& p) { return positive_part(p[0]) + square(positive_part(p[1] - p[2])); },
      [&](auto x, auto y, auto z) { return cut(x) + cut(y - z) * cut(y - z); });
  const Jet above = positive_part(jets_of({Interval{1, 2}, Interval{}, Interval{}})[0]);
  CHECK(above.value.lo == 1);
  CHECK(above.slope[0].is_point());
  const Jet below = positive_part(jets_of({Interval{-2, -1}, Interval{}, Interval{}})[0]);
  CHECK(below.value.magnitude() < 1e-300);
  CHECK(below.slope[0].magnitude() < 1e-300);
}

TEST_CASE("the inverse and the root of intervals hold what they must") {
  CHECK(inverse(Interval{-1, 1}).hi == std::numeric_limits<double>::infinity());
  CHECK(inverse(Interval{2, 4}).contains(0.3));
  CHECK(root(Interval{-1, 4}).lo == 0);
}

TEST_CASE("jets of series have the slopes of jets of intervals") {
  // x y at x = 1 + s, y = 2 + t.
  const PatchSeries x = PatchSeries::linear(1, 1, 0);
  const PatchSeries y = PatchSeries::linear(2, 0, 1);
  const PatchSeries one = PatchSeries::of(Interval::of(1));
  const PatchSeries none = PatchSeries::of(Interval::of(0));
  const JetOf<PatchSeries> product =
      JetOf<PatchSeries>{x, {one, none, none}} * JetOf<PatchSeries>{y, {none, one, none}};
  CHECK(product.value.terms[PatchSeries::place(1, 1)] == 1);
  CHECK(product.slope[0].terms[0] == 2);
  CHECK(product.slope[0].terms[PatchSeries::place(0, 1)] == 1);
  CHECK(product.slope[1].terms[PatchSeries::place(1, 0)] == 1);
  CHECK(product.slope[2].spread() < 1e-300);
}
