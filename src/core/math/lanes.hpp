// Four doubles side by side: what vector instructions do in one step, on every target with the same bits as
// one by one. Vectors of GCC and Clang, which turn them into what the machine has.
#pragma once

#include <array>
#include <cmath>

#ifdef __AVX__
#include <immintrin.h>
#endif

namespace crt::core {

using Lanes = double __attribute__((vector_size(32)));
/// What comparing two of them gives: all bits of a lane set where it is true.
using LaneMask = decltype(Lanes{} < Lanes{});
inline constexpr int lane_count = 4;

inline Lanes lanes_of(double value) {
  return Lanes{value, value, value, value};
}

inline Lanes min(const Lanes& a, const Lanes& b) {
  return a < b ? a : b;
}

inline Lanes max(const Lanes& a, const Lanes& b) {
  return a < b ? b : a;
}

inline Lanes sqrt(const Lanes& a) {
  Lanes result;
  for (int i = 0; i < lane_count; ++i) result[i] = std::sqrt(a[i]);
  return result;
}

inline Lanes fma(const Lanes& a, const Lanes& b, const Lanes& c) {
  Lanes result;
  for (int i = 0; i < lane_count; ++i) result[i] = std::fma(a[i], b[i], c[i]);
  return result;
}

/// The absolute value, of a double or of lanes.
template <class Real>
Real size_of(const Real& x) {
  return x < 0.0 ? -x : x;
}

/// Of vectors by component, of doubles or of lanes.
template <class Real>
Real dot(const std::array<Real, 3>& a, const std::array<Real, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Four numbers of about 106 bits; the operators are those of double_double.hpp.
struct DoubleDoubleLanes {
  Lanes hi{};
  Lanes lo{};
};

inline DoubleDoubleLanes quick_two_sum(const Lanes& a, const Lanes& b) {
  const Lanes sum = a + b;
  return {sum, b - (sum - a)};
}

inline DoubleDoubleLanes two_sum(const Lanes& a, const Lanes& b) {
  const Lanes sum = a + b;
  const Lanes b_part = sum - a;
  const Lanes a_part = sum - b_part;
  return {sum, (a - a_part) + (b - b_part)};
}

inline DoubleDoubleLanes operator+(const DoubleDoubleLanes& a, const DoubleDoubleLanes& b) {
  const DoubleDoubleLanes high = two_sum(a.hi, b.hi);
  const DoubleDoubleLanes low = two_sum(a.lo, b.lo);
  const DoubleDoubleLanes first = quick_two_sum(high.hi, high.lo + low.hi);
  return quick_two_sum(first.hi, low.lo + first.lo);
}

inline DoubleDoubleLanes operator*(const DoubleDoubleLanes& a, double b) {
  const Lanes factor = lanes_of(b);
  const Lanes product = a.hi * factor;
  return quick_two_sum(product, fma(a.hi, factor, -product) + a.lo * factor);
}

}  // namespace crt::core
