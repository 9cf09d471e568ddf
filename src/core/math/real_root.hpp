// Real roots of polynomials are compared exactly, without rounding.
#pragma once

#include <optional>

#include "core/math/dyadic_polynomial.hpp"

namespace crt::core {

/// A RealRoot is an algebraic number: a root of a polynomial, in an interval that has no other.
class RealRoot {
 public:
  /// Returns the number x itself.
  static RealRoot at(const Dyadic& x);

  /// Makes the one root between `low` and `high`, which are no roots. The polynomial must not be 0.
  RealRoot(DyadicPolynomial polynomial, const Dyadic& low, const Dyadic& high);

  /// Returns the root that is within `error` of t, if no other is nearly as near. The polynomial
  /// must not be 0.
  static std::optional<RealRoot> near(const DyadicPolynomial& polynomial, const DoubleDouble& t,
                                      double error);

  /// Returns the root that has `index` others before it, or the last if there are not so many, or
  /// nothing if there is no root. Each root counts once, whatever its multiplicity. The polynomial
  /// must not be 0.
  static std::optional<RealRoot> of_index(const DyadicPolynomial& polynomial, std::size_t index);

  /// Returns the sign of a - b, however close they are. Both intervals may get narrower, so that
  /// comparing them again costs less.
  friend int order(RealRoot& a, RealRoot& b);

  /// Returns a number between a and b, where a < b.
  static Dyadic between(RealRoot& a, RealRoot& b);
  /// Return some number below the root, and some number above it.
  Dyadic below() const { return is_point() ? low_ - Dyadic(1) : low_; }
  Dyadic above() const { return is_point() ? high_ + Dyadic(1) : high_; }
  /// Returns the number to about 100 bits.
  DoubleDouble rounded();

 private:
  RealRoot() = default;
  bool is_point() const { return sign_low_ == 0; }
  /// Compares roots of polynomials of degree 1.
  static int order_of_fractions(const RealRoot& a, const RealRoot& b);
  /// Returns whether the interval is a point that is a root of the other's polynomial within the
  /// other's interval.
  bool is_at_root_of(const RealRoot& other) const;
  /// Narrows the interval to a half or to far less.
  void narrow();
  /// Cuts off the part on the other side of x from the root.
  void cut_at(const Dyadic& x);

  DyadicPolynomial polynomial_;  ///< has different signs at both ends
  Dyadic low_;
  Dyadic high_;
  int sign_low_ = 0;  ///< the sign of the polynomial at low, or 0 if low and high are the root
  int bits_ = 1;      ///< the number of bits that the next step tries to gain
};

int order(RealRoot& a, RealRoot& b);

}  // namespace crt::core
