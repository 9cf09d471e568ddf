// Arithmetic with intervals is rounded outwards: a result surely holds all that its operands allow.
//
// A bound is computed in round-to-nearest and then moved outwards by more than its rounding. For
// the elementary functions (crt/elementary.hpp) that is four units in the last place, of which they
// take about a half.
//
// Source: Rump, Fast and parallel interval arithmetic, 1999; Moore, Kearfott, Cloud, Introduction
// to interval analysis, 2009. Tests: tests/math/interval_test.cpp
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace crt::core {

/// An Interval has all numbers from lo to hi. An unbounded one has an infinite end. A lower end is
/// never +infinity, an upper one never -infinity, and none is NaN.
struct Interval {
  double lo;
  double hi;

  static constexpr double largest = std::numeric_limits<double>::max();
  static constexpr Interval everything() {
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }
  static constexpr Interval of(double x) { return {x, x}; }

  bool contains(double x) const { return lo <= x && x <= hi; }
  bool is_point() const { return lo == hi; }
  double width() const { return hi - lo; }
  /// Returns the number in the middle, rounded.
  double middle() const { return 0.5 * lo + 0.5 * hi; }
  double magnitude() const { return std::max(-lo, hi); }
};

/// These return a bound below or above what was rounded to x by an operation of IEEE 754.
inline double rounded_down(double x) {
  constexpr double smallest = std::numeric_limits<double>::min();
  const double finite = std::min(x, Interval::largest);
  return std::fma(-0x1p-52, std::abs(finite), finite) - smallest;
}
inline double rounded_up(double x) {
  return -rounded_down(-x);
}
/// These do so for sums, which are exact where they are 0 or below all normal numbers.
inline double sum_down(double x) {
  const double finite = std::min(x, Interval::largest);
  return std::fma(-0x1p-52, std::abs(finite), finite);
}
inline double sum_up(double x) {
  return -sum_down(-x);
}
/// Returns the numbers that an elementary function may have rounded to some from lo to hi.
inline Interval around(double lo, double hi) {
  constexpr double last_places = 0x1p-50;
  constexpr double smallest = std::numeric_limits<double>::min();
  const double low = std::min(lo, Interval::largest);
  const double high = std::max(hi, -Interval::largest);
  return {low - (last_places * std::abs(low) + smallest),
          high + (last_places * std::abs(high) + smallest)};
}

inline Interval hull(const Interval& a, const Interval& b) {
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}

inline Interval operator-(const Interval& a) {
  return {-a.hi, -a.lo};
}
inline Interval operator+(const Interval& a, const Interval& b) {
  return {sum_down(a.lo + b.lo), sum_up(a.hi + b.hi)};
}
inline Interval operator-(const Interval& a, const Interval& b) {
  return {sum_down(a.lo - b.hi), sum_up(a.hi - b.lo)};
}

namespace interval_detail {

/// Returns a product of bounds. 0 times what is unbounded is 0.
inline double product(double a, double b) {
  return a == 0 || b == 0 ? 0 : a * b;
}

}  // namespace interval_detail

inline Interval operator*(const Interval& a, const Interval& b) {
  double p = a.lo * b.lo;
  double q = a.lo * b.hi;
  double r = a.hi * b.lo;
  double s = a.hi * b.hi;
  if (!((p + q) + (r + s) < Interval::largest)) [[unlikely]] {
    using interval_detail::product;
    p = product(a.lo, b.lo);
    q = product(a.lo, b.hi);
    r = product(a.hi, b.lo);
    s = product(a.hi, b.hi);
  }
  const double lo = std::min(std::min(p, q), std::min(r, s));
  const double hi = std::max(std::max(p, q), std::max(r, s));
  return {rounded_down(lo), rounded_up(hi)};
}

inline Interval square(const Interval& a) {
  const double high = std::max(-a.lo, a.hi);
  const double low = std::max({a.lo, -a.hi, 0.0});
  return {std::max(0.0, rounded_down(low * low)), rounded_up(high * high)};
}

/// Returns all quotients a / b of which b is not 0.
inline Interval operator/(const Interval& a, const Interval& b) {
  constexpr double unbounded = std::numeric_limits<double>::infinity();
  if (b.lo < 0 && b.hi > 0) return Interval::everything();
  // The inverse of an infinite end is 0.
  return a * Interval{b.hi == 0 ? -unbounded : rounded_down(1 / b.hi),
                      b.lo == 0 ? unbounded : rounded_up(1 / b.lo)};
}

// These are the elementary functions. What is outside of where a function has a value must
// have been cut off.

Interval square_root(const Interval& a);
Interval exponential(const Interval& a);
Interval logarithm(const Interval& a);
Interval sine(const Interval& a);
Interval cosine(const Interval& a);
/// A Wave has the sine and the cosine of all numbers of an interval, and those of a narrow interval
/// in it.
struct Wave {
  Interval sine_in_middle;
  Interval cosine_in_middle;
  Interval sine;
  Interval cosine;
};
Wave wave(const Interval& middle, const Interval& all);
/// Has no bounds across a pole.
Interval tangent(const Interval& a);
Interval arc_sine(const Interval& a);
Interval arc_cosine(const Interval& a);
Interval arc_tangent(const Interval& a);
/// Returns a to the power of a whole number above 0.
Interval whole_power(const Interval& a, double exponent);
/// Returns a >= 0 to the power of a number above 0.
Interval power(const Interval& a, double exponent);
/// Returns whether an interval may have a point offset + k period, for a whole k.
bool may_contain_turn(const Interval& a, double offset, double period);

}  // namespace crt::core
