// Roots of quadratics whose coefficients are known without rounding.
#pragma once

#include <array>

#include "core/math/dyadic_polynomial.hpp"

namespace crt::core {

/// a t^2 + 2 b t + c, exactly.
struct ExactQuadratic {
  Dyadic a;
  Dyadic b;
  Dyadic c;

  Dyadic discriminant() const { return square(b) - a * c; }

  DyadicPolynomial polynomial() const { return DyadicPolynomial({c, b + b, a}); }

  /// If c is taken as 0, what is left when the root at 0 is divided out.
  DyadicPolynomial beside_zero() const { return DyadicPolynomial({b + b, a}); }

  /// Both roots in ascending order, each to about 100 bits. a must not be 0, the discriminant not
  /// negative.
  std::array<DoubleDouble, 2> roots() const;

  /// If c is taken as 0, the root beside 0, to about 100 bits. a must not be 0.
  DoubleDouble root_beside_zero() const { return (-(b + b).rounded() / a.rounded()).unscaled(); }
};

}  // namespace crt::core
