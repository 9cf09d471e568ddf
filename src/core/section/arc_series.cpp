#include "core/section/arc_series.hpp"

#include <cmath>

#include "core/section/circle_fit.hpp"
#include "crt/elementary.hpp"

namespace crt::core {

std::array<PatchSeries, 2> arc_series(const ContourPiece& arc, double rounding) {
  // At the angle s a from the middle of an arc of 2 a, and half a chord of length 1, the place is
  // sin(s a) / sin(a) along the chord and (cos(a) - cos(s a)) / sin(a) to the left of it.
  std::array<double, PatchSeries::degree + 1> along{0, 1};
  std::array<double, PatchSeries::degree + 1> left{};
  double off = 0;
  if (arc.is_arc()) {
    const double a = 2 * elementary::atan(arc.bulge);
    const double sine = elementary::sin(a);
    const double a2 = a * a;
    const double scale = a / sine;
    along = {0, scale, 0, -scale * a2 / 6, 0, scale * a2 * a2 / 120, 0};
    const double by_a = scale * a;
    const double square = by_a / 2;
    const double fourth = by_a * a2 / 24;
    const double sixth = by_a * a2 * a2 / 720;
    left = {-square + fourth - sixth, 0, square, 0, -fourth, 0, sixth};
    // The terms that follow are less than these.
    const double rest = std::abs(scale) * a2 * a2 * a2;
    off = rest / 5040 + 2 * rest * std::abs(a) / 40320 + 0x1p-48;
  }
  const double x = 0.5 * (arc.to.x - arc.from.x);
  const double y = 0.5 * (arc.to.y - arc.from.y);
  const double half = std::abs(x) + std::abs(y);
  PatchSeries first;
  PatchSeries second;
  for (std::size_t i = 0; i < along.size(); ++i) {
    const std::size_t place = PatchSeries::place(i, 0);
    first.terms[place] = x * along[i] - y * left[i];
    second.terms[place] = y * along[i] + x * left[i];
  }
  first.terms[0] += 0.5 * arc.from.x + 0.5 * arc.to.x;
  second.terms[0] += 0.5 * arc.from.y + 0.5 * arc.to.y;
  first.error = second.error = half * (off + 0x1p-48) + rounding;
  return {first, second};
}

Interval segment_area(const Interval& chord, double bulge) {
  if (bulge == 0) return {0, 0};
  // The area is h^2 (1 + b^2)^2 / (2 b^2) atan(b) - h^2 (1 - b^2) / (2 b) for half a chord h. As a
  // series in b, each term bounds the rest.
  const Interval b = Interval::of(bulge);
  const Interval b2 = square(b);
  const Interval four = Interval::of(4);
  Interval sum = four / Interval::of(3);
  Interval power = Interval::of(1);
  constexpr int terms = 7;
  for (int k = 1; k <= terms; ++k) {
    power = power * b2;
    const Interval term =
        four * power / Interval::of((2.0 * k - 1) * (2.0 * k + 1) * (2.0 * k + 3));
    if (k == terms) {
      sum = sum + Interval{-term.hi, term.hi};
    } else {
      sum = k % 2 == 1 ? sum + term : sum - term;
    }
  }
  return square(chord * Interval::of(0.5)) * b * sum;
}

double bulge_through(const PlanePoint& from, const PlanePoint& between, const PlanePoint& to) {
  // As seen from there, the ends are half a turn less half of the arc's angle apart.
  const double ax = between.x - from.x;
  const double ay = between.y - from.y;
  const double bx = to.x - between.x;
  const double by = to.y - between.y;
  const double half = elementary::atan2(ax * by - ay * bx, ax * bx + ay * by);
  return elementary::sin(0.5 * half) / elementary::cos(0.5 * half);
}

}  // namespace crt::core
