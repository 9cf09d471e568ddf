// A double-double is a number of about 106 bits as the unevaluated sum of two doubles. This file
// has its arithmetic, and the error-free transformations that it is built on. All of it needs
// round-to-nearest and no contraction of a * b + c by the compiler. So the build says
// -ffp-contract=off, and every fma is written.
//
// Sources: Knuth, The Art of Computer Programming vol. 2, 4.2.2 (two_sum); Dekker, A floating-point
// technique for extending the available precision, 1971 (quick_two_sum); Joldes, Muller, Popescu,
// Tight and rigorous error bounds for basic building blocks of double-word arithmetic, 2017
// (the operators: algorithms 6, 12 and 17).
#pragma once

#include <cmath>

namespace crt::core {

/// A DoubleDouble is hi + lo, with |lo| at most half an ulp of hi.
struct DoubleDouble {
  double hi = 0;
  double lo = 0;

  constexpr DoubleDouble() = default;
  constexpr DoubleDouble(double value) : hi(value) {}  // NOLINT(google-explicit-constructor): exact
  constexpr DoubleDouble(double high, double low) : hi(high), lo(low) {}

  constexpr double value() const { return hi + lo; }
};

/// Returns a + b exactly.
constexpr DoubleDouble two_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  const double a_part = sum - b_part;
  return {sum, (a - a_part) + (b - b_part)};
}

/// Returns a + b exactly, if |a| >= |b| or a is 0.
constexpr DoubleDouble quick_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// Returns a * b exactly, unless it underflows.
inline DoubleDouble two_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

inline DoubleDouble operator-(const DoubleDouble& a) {
  return {-a.hi, -a.lo};
}

inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble high = two_sum(a.hi, b.hi);
  const DoubleDouble low = two_sum(a.lo, b.lo);
  const DoubleDouble first = quick_two_sum(high.hi, high.lo + low.hi);
  return quick_two_sum(first.hi, low.lo + first.lo);
}

inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
  return a + -b;
}

inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble high = two_product(a.hi, b.hi);
  const double cross = std::fma(a.lo, b.hi, std::fma(a.hi, b.lo, a.lo * b.lo));
  return quick_two_sum(high.hi, high.lo + cross);
}

inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const double quotient = a.hi / b.hi;
  const DoubleDouble remainder = a - b * DoubleDouble(quotient);
  return quick_two_sum(quotient, remainder.value() / b.hi);
}

inline DoubleDouble sqrt(const DoubleDouble& a) {
  if (!(a.hi > 0)) return {std::sqrt(a.hi)};
  const double root = std::sqrt(a.hi);
  const DoubleDouble remainder = a - two_product(root, root);
  return quick_two_sum(root, remainder.hi / (2 * root));
}

}  // namespace crt::core
