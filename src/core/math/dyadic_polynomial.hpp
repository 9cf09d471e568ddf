// Polynomials have exact coefficients, and their real roots are isolated without rounding.
#pragma once

#include <functional>
#include <vector>

#include "core/math/dyadic.hpp"

namespace crt::core {

class DyadicPolynomial {
 public:
  DyadicPolynomial() = default;  ///< 0
  /// Takes the coefficient of x^0 first.
  explicit DyadicPolynomial(std::vector<Dyadic> coefficients);

  /// Returns the degree, -1 for the polynomial 0.
  int degree() const { return static_cast<int>(coefficients_.size()) - 1; }
  /// Returns the coefficient of x^i, where i is no more than the degree.
  const Dyadic& coefficient(std::size_t i) const { return coefficients_[i]; }
  /// Returns the coefficient of the highest power. The polynomial must not be 0.
  const Dyadic& leading() const { return coefficients_.back(); }
  Dyadic value(const Dyadic& x) const;
  DyadicPolynomial derivative() const;

  friend DyadicPolynomial operator+(const DyadicPolynomial& a, const DyadicPolynomial& b);
  friend DyadicPolynomial operator-(const DyadicPolynomial& a, const DyadicPolynomial& b);
  friend DyadicPolynomial operator*(const DyadicPolynomial& a, const DyadicPolynomial& b);
  friend DyadicPolynomial operator*(const Dyadic& s, const DyadicPolynomial& p);

  /// Returns the remainder of a / b times some negative number. b must not be 0.
  friend DyadicPolynomial negative_remainder(const DyadicPolynomial& a, const DyadicPolynomial& b);

 private:
  void trim();

  std::vector<Dyadic> coefficients_;  ///< the last is not 0
};

/// Returns the polynomial of the highest degree that divides both. One of them must not be 0.
DyadicPolynomial common_divisor(DyadicPolynomial a, DyadicPolynomial b);

/// A SturmChain counts real roots, each once whatever its multiplicity.
/// Source: Sturm's theorem, as in Basu, Pollack, Roy, Algorithms in Real Algebraic Geometry,
/// 2006, 2.2.2.
class SturmChain {
 public:
  /// Makes the chain of a polynomial, which must not be 0.
  explicit SturmChain(const DyadicPolynomial& polynomial);

  /// Counts all real roots.
  int count() const;
  /// Counts the roots between two points that are no roots.
  int count(const Dyadic& low, const Dyadic& high) const {
    return changes_at(low) - changes_at(high);
  }

 private:
  int changes_at(const Dyadic& x) const;
  std::vector<DyadicPolynomial> chain_;
};

/// Returns points in ascending order such that one real root lies between each two of them, or no
/// points if there is no root. The polynomial must not be 0. Roots that are closer than 2^-1200 of
/// the largest are not separated. Above degree 4 it takes long: the numbers of the Sturm chain grow
/// exponentially with the degree.
std::vector<Dyadic> root_separators(const DyadicPolynomial& polynomial);

/// Returns the root between low and high, where `is_beyond` changes from false to true. The
/// iteration ends when root + offset is known to more than 100 bits.
Dyadic refined_root(const DyadicPolynomial& polynomial, Dyadic low, Dyadic high,
                    const Dyadic& offset, const std::function<bool(const Dyadic& x)>& is_beyond);

}  // namespace crt::core
