// Polynomials in the parameter of a line, in fractions (GMP), and the places of their roots by
// Sturm's theorem. Nothing here is rounded, and nothing is shared with src/core.
//
// Source: Basu, Pollack, Roy, Algorithms in Real Algebraic Geometry, 2006, section 2.2 (Sturm).
#pragma once

#include <gmpxx.h>

#include <vector>

namespace crt::test {

/// A LinePolynomial is a polynomial in t. It has the operations of a Field, so that one template
/// makes both.
class LinePolynomial {
 public:
  // NOLINTNEXTLINE(google-explicit-constructor): numbers are polynomials, as they are fields
  LinePolynomial(double constant);
  /// Makes the polynomial of these coefficients, that of t^0 first.
  explicit LinePolynomial(std::vector<mpq_class> coefficients);

  LinePolynomial operator+(const LinePolynomial& other) const;
  LinePolynomial operator-(const LinePolynomial& other) const;
  LinePolynomial operator*(const LinePolynomial& other) const;

  bool is_zero() const { return coefficients_.empty(); }
  int sign_at(const mpq_class& t) const;
  LinePolynomial derivative() const;
  /// Returns the polynomial that has each root once, with the sign of this one beyond all of them.
  LinePolynomial without_multiples() const;
  /// Returns the polynomial without the root t, which it must have.
  LinePolynomial without_root(const mpq_class& t) const;

 private:
  friend class SturmChain;
  struct Division;
  static Division divided(const LinePolynomial& a, const LinePolynomial& b);
  void trim();
  void make_whole();  // multiplied by what is above 0, into whole numbers without common factors

  std::vector<mpq_class> coefficients_;
};

inline LinePolynomial pow(const LinePolynomial& base, int exponent) {
  LinePolynomial result = base;
  for (int i = 1; i < exponent; ++i) result = result * base;
  return result;
}

/// A LineRoot is the only root of a polynomial between two fractions, or the fraction that both
/// are.
class LineRoot {
 public:
  explicit LineRoot(const mpq_class& place) : lower_(place), upper_(place) {}
  /// Takes the polynomial that has this one root, which is simple, between two that are none.
  LineRoot(const LinePolynomial* of, const mpq_class& lower, const mpq_class& upper)
      : of_(of), lower_(lower), upper_(upper) {}

  const mpq_class& lower() const { return lower_; }
  const mpq_class& upper() const { return upper_; }
  /// Returns -1, 0 or 1 where the root is below, at or above a fraction.
  int compared_to(const mpq_class& t);
  /// Halves the span until it is at most as wide.
  void narrow(const mpq_class& width);

 private:
  void halve() { compared_to((lower_ + upper_) / 2); }

  const LinePolynomial* of_ = nullptr;
  mpq_class lower_;
  mpq_class upper_;
};

/// Returns the roots between two fractions, in ascending order, of a polynomial that has each root
/// once, and none at these fractions. It must outlive them.
std::vector<LineRoot> roots_between(const LinePolynomial& of, const mpq_class& from,
                                    const mpq_class& to);

}  // namespace crt::test
