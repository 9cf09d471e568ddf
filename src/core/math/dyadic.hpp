// Exact arithmetic: sums, differences and products of doubles without any rounding, for the signs
// of polynomials that rounded arithmetic leaves open.
//
// Why not expansions of doubles (Shewchuk, Adaptive precision floating-point arithmetic and fast
// robust geometric predicates, 1997)? Because their terms are doubles too: the discriminant of a
// sphere in a rotated space has degree 16 in the inputs and would over- or underflow at sizes that
// are legal here. Here the exponent has a word of its own. As there, this is the last resort behind
// filters, so clear before fast.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/double_double.hpp"

namespace crt::core {

/// value * 2^exponent, with 1/2 <= |value.hi| < 1 (or value 0).
struct ScaledNumber {
  DoubleDouble value;
  int exponent = 0;

  /// The nearest double-double that has a finite or infinite double in front.
  DoubleDouble unscaled() const;
};

ScaledNumber operator+(const ScaledNumber& a, const ScaledNumber& b);
ScaledNumber operator-(const ScaledNumber& a);
/// b must not be 0.
ScaledNumber operator/(const ScaledNumber& a, const ScaledNumber& b);
/// a must not be negative.
ScaledNumber sqrt(const ScaledNumber& a);

/// A number m 2^e with whole m and e, of any size.
class Dyadic {
 public:
  Dyadic() = default;    ///< 0
  Dyadic(double value);  // NOLINT(google-explicit-constructor): exact; must be finite

  /// -1, 0 or 1.
  int sign() const { return limbs_.empty() ? 0 : (negative_ ? -1 : 1); }

  /// To about 100 bits.
  ScaledNumber rounded() const;

  /// Of memory, beside the object itself.
  std::size_t more_bytes() const { return limbs_.capacity() * sizeof(Limb); }

  friend Dyadic operator-(Dyadic a);
  friend Dyadic operator+(const Dyadic& a, const Dyadic& b);
  friend Dyadic operator-(const Dyadic& a, const Dyadic& b);
  friend Dyadic operator*(const Dyadic& a, const Dyadic& b);

 private:
  using Limb = std::uint64_t;

  /// -1, 0 or 1, without regard to the signs.
  static int compare_sizes(const Dyadic& a, const Dyadic& b);
  static Dyadic sum_of_sizes(const Dyadic& a, const Dyadic& b);
  /// |a| must be greater than |b|.
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
