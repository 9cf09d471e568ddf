// Quadratics whose coefficients are known without rounding are solved for their roots.
#pragma once

#include <array>

#include "core/math/dyadic_polynomial.hpp"

namespace crt::core {

/// An ExactQuadratic is a t^2 + 2 b t + c, exactly.
struct ExactQuadratic {
  Dyadic a;
  Dyadic b;
  Dyadic c;

  Dyadic discriminant() const { return square(b) - a * c; }

  DyadicPolynomial polynomial() const { return DyadicPolynomial({c, b + b, a}); }

  /// Returns what is left when c is taken as 0 and the root at 0 is divided out.
  DyadicPolynomial beside_zero() const { return DyadicPolynomial({b + b, a}); }

  /// Returns both roots in ascending order, each to about 100 bits. a must not be 0, and the
  /// discriminant must not be negative.
  std::array<DoubleDouble, 2> roots() const;

  /// Returns the root beside 0 if c is taken as 0, to about 100 bits. a must not be 0.
  DoubleDouble root_beside_zero() const { return (-(b + b).rounded() / a.rounded()).unscaled(); }
};

}  // namespace crt::core
