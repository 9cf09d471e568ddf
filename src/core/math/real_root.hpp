// Real roots of polynomials as they are, without rounding, and which of two is the larger.
#pragma once

#include <optional>

#include "core/math/dyadic_polynomial.hpp"

namespace crt::core {

/// An algebraic number: a root of a polynomial, told by an interval that has no other.
class RealRoot {
 public:
  /// The number x itself.
  static RealRoot at(const Dyadic& x);

  /// The one root between `low` and `high`, which are no roots. The polynomial must not be 0.
  RealRoot(DyadicPolynomial polynomial, const Dyadic& low, const Dyadic& high);

  /// The root that is within `error` of t, if no other is nearly as near. The polynomial must not
  /// be 0.
  static std::optional<RealRoot> near(const DyadicPolynomial& polynomial, const DoubleDouble& t,
                                      double error);

  /// The root that has `index` others before it, or the last if there are not so many; none if
  /// there is no root. Each counts once, whatever its multiplicity. The polynomial must not be 0.
  static std::optional<RealRoot> of_index(const DyadicPolynomial& polynomial, std::size_t index);

  /// The sign of a - b, however close they are. Both may come out narrower, so that to compare them
  /// again costs less.
  friend int order(RealRoot& a, RealRoot& b);

 private:
  RealRoot() = default;
  bool is_point() const { return sign_low_ == 0; }
  /// Of polynomials of degree 1.
  static int order_of_fractions(const RealRoot& a, const RealRoot& b);
  /// Whether the root is a point that is a root of the other's polynomial within the other's
  /// interval.
  bool is_at_root_of(const RealRoot& other) const;
  /// To a half of the interval, or to far less.
  void narrow();
  /// Cuts off what is on the other side of x than the root.
  void cut_at(const Dyadic& x);

  DyadicPolynomial polynomial_;  ///< has different signs at both ends
  Dyadic low_;
  Dyadic high_;
  int sign_low_ = 0;  ///< of the polynomial; 0 if low and high are the root
  int bits_ = 1;      ///< that the next step is to win
};

}  // namespace crt::core
