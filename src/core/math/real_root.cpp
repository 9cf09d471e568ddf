#include "core/math/real_root.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/math/isolated_roots.hpp"

namespace crt::core {
namespace {

int compared(const Dyadic& a, const Dyadic& b) {
  return (a - b).sign();
}

constexpr int max_bits = 32;

/// Returns how many bits a straight line between the ends of an interval may well gain: about as
/// many as the interval is narrower than its numbers are large.
int bits_to_try(const Dyadic& low, const Dyadic& high) {
  const int width = (high - low).rounded().exponent;
  const int size = std::max(low.rounded().exponent, high.rounded().exponent);
  return std::clamp((size - width) / 2, 1, max_bits);
}

Dyadic abs(const Dyadic& number) {
  return number.sign() < 0 ? -number : number;
}

/// Returns whether a polynomial surely rises or falls all the way from -reach to reach.
bool is_monotonic(const DyadicPolynomial& polynomial, const Dyadic& reach) {
  if (polynomial.degree() < 1) return false;
  Dyadic change;  // of the slope, at most
  for (int i = polynomial.degree(); i > 1; --i) {
    const Dyadic& coefficient = polynomial.coefficient(static_cast<std::size_t>(i));
    change = reach * (change + Dyadic(i) * abs(coefficient));
  }
  return (abs(polynomial.coefficient(1)) - change).sign() > 0;
}

}  // namespace

RealRoot RealRoot::at(const Dyadic& x) {
  RealRoot root;
  root.polynomial_ = DyadicPolynomial({-x, 1});
  root.low_ = root.high_ = x;
  return root;
}

RealRoot::RealRoot(DyadicPolynomial polynomial, const Dyadic& low, const Dyadic& high)
    : polynomial_(std::move(polynomial)),
      low_(low),
      high_(high),
      sign_low_(polynomial_.value(low).sign()),
      bits_(bits_to_try(low, high)) {
  while (sign_low_ == polynomial_.value(high).sign()) {
    // The root has an even multiplicity, which the common divisor with the derivative makes odd.
    polynomial_ = common_divisor(polynomial_, polynomial_.derivative());
    sign_low_ = polynomial_.value(low).sign();
  }
}

std::optional<RealRoot> RealRoot::near(const DyadicPolynomial& polynomial, const DoubleDouble& t,
                                       double error) {
  const Dyadic middle = Dyadic(t.hi) + Dyadic(t.lo);
  if (error == 0) {
    if (polynomial.value(middle).sign() != 0) return std::nullopt;
    return at(middle);
  }
  // The interval is wider than the error, so that a root just within the error is not at an end.
  const Dyadic margin(2 * error);
  const DyadicPolynomial nearby = about(polynomial, middle);
  const int sign_low = nearby.value(-margin).sign();
  const int sign_high = nearby.value(margin).sign();
  if (sign_low == 0 || sign_high == 0) return std::nullopt;
  const Dyadic low = middle - margin;
  const Dyadic high = middle + margin;
  if (is_monotonic(nearby, margin)) {
    if (sign_low == sign_high) return std::nullopt;
    return RealRoot(polynomial, low, high);
  }
  if (SturmChain(nearby).count(-margin, margin) != 1) return std::nullopt;
  return RealRoot(polynomial, low, high);
}

std::optional<RealRoot> RealRoot::of_index(const DyadicPolynomial& polynomial, std::size_t index) {
  const IsolatedRoots roots = isolated_roots(polynomial);
  if (roots.brackets.empty()) return std::nullopt;
  const auto& [low, high] = roots.brackets[std::min(index, roots.brackets.size() - 1)];
  return RealRoot(roots.polynomial, low, high);
}

bool RealRoot::is_at_root_of(const RealRoot& other) const {
  return is_point() && compared(low_, other.low_) > 0 && compared(low_, other.high_) < 0 &&
         other.polynomial_.value(low_).sign() == 0;
}

void RealRoot::cut_at(const Dyadic& x) {
  const int sign = polynomial_.value(x).sign();
  if (sign != -sign_low_) low_ = x;
  if (sign != sign_low_) high_ = x;
  if (sign == 0) sign_low_ = 0;
}

// Narrows the interval by a step of quadratic interval refinement. A straight line between the ends
// predicts in which of many pieces the root is. If it is there, the next step tries twice as many
// bits.
//
// Source: Abbott, Quadratic interval refinement for real roots, 2006.
void RealRoot::narrow() {
  if (is_point()) return;
  const Dyadic width = high_ - low_;
  if (bits_ == 1) {
    constexpr double half = 0.5;
    cut_at(low_ + width * Dyadic(half));
    bits_ = 2;
    return;
  }
  const ScaledNumber below = polynomial_.value(low_).rounded();
  const ScaledNumber above = polynomial_.value(high_).rounded();
  const double pieces = std::ldexp(1.0, bits_);
  const double share = (below / (below + -above)).unscaled().hi;
  const double piece = std::clamp(std::floor(share * pieces), 0.0, pieces - 1);
  const Dyadic from = low_ + width * Dyadic(piece / pieces);
  const Dyadic to = low_ + width * Dyadic((piece + 1) / pieces);
  cut_at(from);
  if (!is_point() && compared(high_, to) > 0) cut_at(to);
  const bool is_there = is_point() || (compared(low_, from) == 0 && compared(high_, to) == 0);
  bits_ = is_there ? std::min(2 * bits_, max_bits) : bits_ / 2;
}

int RealRoot::order_of_fractions(const RealRoot& a, const RealRoot& b) {
  const auto& p = a.polynomial_;
  const auto& q = b.polynomial_;
  const int sign =
      (q.coefficient(0) * p.coefficient(1) - p.coefficient(0) * q.coefficient(1)).sign();
  return sign * p.leading().sign() * q.leading().sign();
}

Dyadic RealRoot::between(RealRoot& a, RealRoot& b) {
  while (compared(a.high_, b.low_) >= 0) {
    const bool a_is_wider = compared(a.high_ - a.low_, b.high_ - b.low_) > 0;
    (a_is_wider ? a : b).narrow();
  }
  constexpr double half = 0.5;
  Dyadic middle = Dyadic(half) * (a.high_ + b.low_);
  const double rounded = static_cast<float>(middle.rounded().unscaled().hi);
  if (std::isfinite(rounded) && compared(a.high_, rounded) < 0 && compared(rounded, b.low_) < 0) {
    return rounded;
  }
  return middle;
}

DoubleDouble RealRoot::rounded() {
  if (low_.sign() < 0 && high_.sign() > 0) cut_at(Dyadic(0));
  constexpr double precision = 0x1p-108;
  while (!is_point()) {
    const Dyadic& smaller = high_.sign() > 0 ? low_ : high_;
    if (compared(high_ - low_, Dyadic(precision) * abs(smaller)) <= 0) break;
    narrow();
  }
  return low_.rounded().unscaled();
}

int order(RealRoot& a, RealRoot& b) {
  if (a.polynomial_.degree() == 1 && b.polynomial_.degree() == 1)
    return RealRoot::order_of_fractions(a, b);
  // Roots that are not very close differ by then. Only the others are worth the question whether
  // they are one. It is asked earlier of roots that are known to many bits.
  constexpr int steps_before_asking = 4;
  constexpr int steps_of_many_bits = 2;
  constexpr int many_bits = 16;
  bool differ = false;
  for (int step = 0;; ++step) {
    const int a_to_b = compared(a.high_, b.low_);
    if (a_to_b <= 0) return a_to_b == 0 && a.is_point() && b.is_point() ? 0 : -1;
    if (compared(b.high_, a.low_) <= 0) return 1;
    if (a.is_at_root_of(b) || b.is_at_root_of(a)) return 0;
    const bool are_known = step >= steps_of_many_bits && std::min(a.bits_, b.bits_) >= many_bits;
    const bool are_close = are_known || step >= steps_before_asking;
    if (!differ && are_close && !a.is_point() && !b.is_point()) {
      // They are one if their polynomials have a root in common where the intervals overlap.
      const DyadicPolynomial common = common_divisor(a.polynomial_, b.polynomial_);
      const Dyadic& low = compared(a.low_, b.low_) > 0 ? a.low_ : b.low_;
      const Dyadic& high = compared(a.high_, b.high_) < 0 ? a.high_ : b.high_;
      if (SturmChain(common).count(low, high) > 0) return 0;
      differ = true;
    }
    const bool a_is_wider = compared(a.high_ - a.low_, b.high_ - b.low_) > 0;
    (a_is_wider ? a : b).narrow();
  }
}

}  // namespace crt::core
