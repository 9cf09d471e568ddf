// Arithmetic with error bounds on lanes is here. It gives in each lane the bits that
// core/math/vector.hpp and double_double.hpp give for one number.
#pragma once

#include "core/math/vector.hpp"
#include "core/simd/lanes.hpp"

namespace crt::core {

inline Lanes rounding_of(const Lanes& x) {
  return unit_roundoff * abs(x);
}
inline Lanes power_of_two_below(const Lanes& x) {
  constexpr std::uint64_t exponent_bits = 0x7ff0000000000000;
  constexpr double smallest = 0x1p-1022;
  const auto power = bits_as<Lanes>(bits_as<WordLanes>(x) & exponent_bits);
  return max(power, lanes_of(smallest));
}
inline Lanes inverse_of_power(const Lanes& x) {
  constexpr std::uint64_t inverse_of_one = 0x7fe0000000000000u;
  return bits_as<Lanes>(inverse_of_one - bits_as<WordLanes>(x));
}
inline Lanes difference_of_products(const Lanes& a, const Lanes& b, const Lanes& c,
                                    const Lanes& d) {
  const Lanes product = c * d;
  const Lanes rest = fma(-c, d, product);
  return fma(a, b, -product) + rest;
}

/// A DoubleDoubleLanes holds four numbers of about 106 bits. The operators are those of
/// double_double.hpp.
struct DoubleDoubleLanes {
  Lanes hi{};
  Lanes lo{};

  Lanes value() const { return hi + lo; }
};

/// Returns lanes that all hold the number.
inline DoubleDoubleLanes lanes_of(const DoubleDouble& value) {
  return {lanes_of(value.hi), lanes_of(value.lo)};
}

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

inline DoubleDoubleLanes two_product(const Lanes& a, const Lanes& b) {
  const Lanes product = a * b;
  return {product, fma(a, b, -product)};
}

inline DoubleDoubleLanes operator+(const DoubleDoubleLanes& a, const DoubleDoubleLanes& b) {
  const DoubleDoubleLanes high = two_sum(a.hi, b.hi);
  const DoubleDoubleLanes low = two_sum(a.lo, b.lo);
  const DoubleDoubleLanes first = quick_two_sum(high.hi, high.lo + low.hi);
  return quick_two_sum(first.hi, low.lo + first.lo);
}

inline DoubleDoubleLanes operator*(const DoubleDoubleLanes& a, const Lanes& b) {
  const Lanes product = a.hi * b;
  return quick_two_sum(product, fma(a.hi, b, -product) + a.lo * b);
}
inline DoubleDoubleLanes operator*(const DoubleDoubleLanes& a, double b) {
  return a * lanes_of(b);
}

}  // namespace crt::core
