// Polynomials with exact coefficients are looked at in double-double, with bounds on the errors.
// That decides nearly all that is asked of their roots.
#pragma once

#include <optional>
#include <vector>

#include "core/math/bounded.hpp"
#include "core/math/dyadic_polynomial.hpp"

namespace crt::core {

/// A NearPolynomial is a polynomial of x = 2^exponent() y, times a power of two. All its roots have
/// |y| < 1.
class NearPolynomial {
 public:
  /// Takes a polynomial of degree 1 or more.
  explicit NearPolynomial(const DyadicPolynomial& polynomial);

  int exponent() const { return exponent_; }
  std::size_t degree() const { return coefficients_.size() - 1; }
  int sign_of_leading() const { return coefficients_.back().sign(); }
  Bounded value(const DoubleDouble& y) const;
  NearPolynomial derivative() const;

  /// Returns about where the sign changes, in order. Some places may be lost.
  std::vector<DoubleDouble> roots() const;
  /// Returns about where the sign changes between two places. `slope` is the derivative, and
  /// `sign_low` the sign at `low`.
  DoubleDouble root_between(const NearPolynomial& slope, DoubleDouble low, DoubleDouble high,
                            int sign_low) const;

  /// Returns the number of real roots, if no two of them may be one. The degree must be 2, 3 or 4.
  std::optional<std::size_t> root_count() const;

 private:
  NearPolynomial() = default;

  std::vector<Bounded> coefficients_;
  int exponent_ = 0;
};

/// Counts the real roots of a polynomial of degree 1 to 4. Returns nothing if two roots are one,
/// and for other degrees.
std::optional<std::size_t> count_simple_roots(const DyadicPolynomial& polynomial,
                                              const NearPolynomial& near);

}  // namespace crt::core
