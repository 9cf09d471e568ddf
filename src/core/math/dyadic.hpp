// Dyadic numbers have exact arithmetic: sums, differences and products of doubles without any
// rounding. They decide the signs of polynomials where rounded arithmetic leaves them undecided.
//
// Expansions of doubles would not do (Shewchuk, Adaptive precision floating-point arithmetic and
// fast robust geometric predicates, 1997), as their terms are doubles too. The discriminant of a
// sphere in a rotated space has degree 16 in the inputs, and would over- or underflow at sizes that
// are legal here. A Dyadic has a word of its own for the exponent. Like expansions it is the last
// resort behind filters, so the code is clear before it is fast.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/double_double.hpp"

namespace crt::core {

/// A ScaledNumber is value * 2^exponent, with 1/2 <= |value.hi| < 1 (or value 0).
struct ScaledNumber {
  DoubleDouble value;
  int exponent = 0;

  /// Returns the nearest double-double whose high part is a finite or infinite double.
  DoubleDouble unscaled() const;
};

ScaledNumber operator+(const ScaledNumber& a, const ScaledNumber& b);
ScaledNumber operator-(const ScaledNumber& a);
/// Divides by b, which must not be 0.
ScaledNumber operator/(const ScaledNumber& a, const ScaledNumber& b);
/// Returns the square root of a, which must not be negative.
ScaledNumber sqrt(const ScaledNumber& a);

/// A Dyadic is a number m 2^e with whole m and e, of any size.
class Dyadic {
 public:
  Dyadic() = default;    ///< 0
  Dyadic(double value);  // NOLINT(google-explicit-constructor): exact; must be finite

  /// Returns -1, 0 or 1.
  int sign() const { return limbs_.empty() ? 0 : (negative_ ? -1 : 1); }

  /// Returns the number rounded to about 100 bits.
  ScaledNumber rounded() const;

  /// Returns the bytes of memory that the number takes beside the object itself.
  std::size_t more_bytes() const { return limbs_.capacity() * sizeof(Limb); }

  friend Dyadic operator-(Dyadic a);
  friend Dyadic operator+(const Dyadic& a, const Dyadic& b);
  friend Dyadic operator-(const Dyadic& a, const Dyadic& b);
  friend Dyadic operator*(const Dyadic& a, const Dyadic& b);

 private:
  using Limb = std::uint64_t;

  /// Compares without regard to the signs and returns -1, 0 or 1.
  static int compare_sizes(const Dyadic& a, const Dyadic& b);
  static Dyadic sum_of_sizes(const Dyadic& a, const Dyadic& b);
  /// Returns |a| - |b|. |a| must be greater than |b|.
  static Dyadic difference_of_sizes(const Dyadic& a, const Dyadic& b);
  Limb limb_at(int place) const;
  int top() const { return base_ + static_cast<int>(limbs_.size()); }
  /// Drops zeros at both ends.
  void trim();

  bool negative_ = false;
  int base_ = 0;             ///< limb i counts 2^(64 (i + base))
  std::vector<Limb> limbs_;  ///< the lowest first; none for 0
};

inline Dyadic square(const Dyadic& a) {
  return a * a;
}

}  // namespace crt::core
