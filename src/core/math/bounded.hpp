// Numbers in double-double have a bound on their error. What they leave open takes exact numbers.
#pragma once

#include <cmath>

#include "core/math/double_double.hpp"

namespace crt::core {

/// A Bounded number has a bound on its error.
struct Bounded {
  DoubleDouble value;
  double error = 0;

  double size() const { return std::abs(value.hi); }
  /// Returns whether the sign is known, and most of the number too.
  bool is_certain() const { return size() > 4 * error; }
  int sign() const { return value.hi > 0 ? 1 : -1; }
  /// Returns the sign, or 0 if it is open.
  int certain_sign() const { return is_certain() ? sign() : 0; }
};

namespace bounded_detail {

/// Adds to an error what an operation's own rounding is at most. That is less than 2^-103, and what
/// underflows.
inline Bounded rounded(const DoubleDouble& value, double error) {
  constexpr double roundoff = 0x1p-100;
  constexpr double underflow = 0x1p-900;
  return {value, error + roundoff * std::abs(value.hi) + underflow};
}

}  // namespace bounded_detail

inline Bounded operator-(const Bounded& a) {
  return {-a.value, a.error};
}
inline Bounded operator+(const Bounded& a, const Bounded& b) {
  return bounded_detail::rounded(a.value + b.value, a.error + b.error);
}
inline Bounded operator-(const Bounded& a, const Bounded& b) {
  return a + -b;
}
inline Bounded operator*(const Bounded& a, const Bounded& b) {
  return bounded_detail::rounded(a.value * b.value,
                                 a.size() * b.error + b.size() * a.error + a.error * b.error);
}

}  // namespace crt::core
