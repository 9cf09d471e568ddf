// These functions enclose the real roots of polynomials for certain. Number is a Ball or an
// Interval.
#pragma once

#include <algorithm>
#include <cmath>

#include "oracle/few.hpp"
#include "oracle/interval.hpp"

namespace crt::test {

inline constexpr std::size_t highest_degree = 4;

/// Holds the coefficients, the constant one first.
template <class Number>
using Polynomial = Few<Number, highest_degree + 1>;

/// A SignChange is where a polynomial changes its sign.
template <class Number>
struct SignChange {
  Number x;
  int after = 0;  ///< the sign beyond x
};

template <class Number>
struct SignChanges {
  int before = 0;                              ///< the sign at -infinity
  Few<SignChange<Number>, highest_degree> at;  ///< in no particular order
};

template <class Number>
Number evaluate(const Polynomial<Number>& p, const Number& x) {
  Number result = p.back();
  for (std::size_t i = p.size() - 1; i-- > 0;) result = result * x + p[i];
  return result;
}

template <class Number>
Polynomial<Number> derivative(const Polynomial<Number>& p) {
  Polynomial<Number> result;
  for (std::size_t i = 1; i < p.size(); ++i)
    result.push_back(p[i] * Number(static_cast<double>(i)));
  return result;
}

/// Returns a power of two beyond all roots (twice Fujiwara's bound).
template <class Number>
double bound_of_roots(const Polynomial<Number>& p) {
  const std::size_t degree = p.size() - 1;
  const int leading = std::ilogb(p.back().value());
  int exponent = -1000;
  for (std::size_t i = 0; i < degree; ++i) {
    if (p[i].largest_size() == 0) continue;
    const int steps = static_cast<int>(degree - i);
    const int quotient = std::ilogb(p[i].largest_size()) + 1 - leading;
    exponent =
        std::max(exponent, quotient >= 0 ? (quotient + steps - 1) / steps : quotient / steps);
  }
  if (exponent > 1000) throw Undecided{};
  return std::ldexp(1.0, exponent + 2);
}

/// Returns a root between two points of different sign to the precision of doubles: by Newton's
/// iteration, or else by halving.
template <class Number>
double rounded_root(const Polynomial<Number>& p, double low, double high, int sign_low) {
  constexpr int most_steps = 100;
  constexpr double converged = 0x1p-48;
  std::array<double, highest_degree + 1> c{};
  for (std::size_t i = 0; i < p.size(); ++i) c[i] = p[i].value();
  double x = (low + high) / 2;
  for (int step = 0; step < most_steps; ++step) {
    double height = 0;
    double rate = 0;
    for (std::size_t i = p.size(); i-- > 0;) {
      rate = rate * x + height;
      height = height * x + c[i];
    }
    ((height > 0) == (sign_low > 0) ? low : high) = x;
    double next = x - height / rate;
    // Newton from far away comes nearer by a constant factor only, so the step halves now and then.
    if (!(low < next && next < high) || step % 4 == 3) next = (low + high) / 2;
    const double moved = std::abs(next - x);
    x = next;
    if (moved <= converged * std::abs(x)) break;
  }
  return x;
}

/// Returns the one root between two points of different sign: a guess, and an enclosure that is
/// proved by signs.
template <class Number>
Number enclose(const Polynomial<Number>& p, const Polynomial<Number>& slope, const Number& from,
               const Number& to, int sign_low) {
  constexpr int most_steps = 400;
  constexpr int max_widenings = 12;
  constexpr double widening = 8;
  if (p[0].is_zero() && from.certain_sign() < 0 && to.certain_sign() > 0) return Number(0.0);
  constexpr int max_bits = 900;  // of the remaining distance, as long as doubles hold it
  const double shortest =
      std::ldexp((to - from).largest_size(), -std::min(Number::precision(), max_bits));
  Number low = from;
  Number high = to;
  Number x(rounded_root(p, low.value(), high.value(), sign_low));
  double margin = 0;
  for (int step = 0; step < most_steps; ++step) {
    if (!low.surely_below(x) || !x.surely_below(high)) x = ((low + high) * Number(0.5)).middle();
    const Number height = evaluate(p, x);
    if (height.is_zero()) return x;
    const double rate = evaluate(slope, x).value();
    margin = height.largest_size() / std::abs(rate);
    const int sign = height.certain_sign();
    if (sign == 0) break;
    (sign == sign_low ? low : high) = x;
    if (margin < shortest) break;
    x = (x - height.middle() / Number(rate)).middle();
  }
  margin = std::max(margin, shortest);
  for (int i = 0; i < max_widenings && std::isfinite(margin); ++i, margin *= widening) {
    const Number left = (x - Number(2 * margin)).middle();
    const Number right = (x + Number(2 * margin)).middle();
    if (evaluate(p, left).certain_sign() == sign_low &&
        evaluate(p, right).certain_sign() == -sign_low && from.surely_below(left) &&
        right.surely_below(to))
      return hull(left, right);
  }
  if (!is_last_try()) throw Undecided{};
  return hull(low, high);
}

template <class Number>
SignChanges<Number> quadratic_changes(const Polynomial<Number>& p, int leading) {
  SignChanges<Number> result{.before = leading, .at = {}};
  const Number half_b = p[1] * Number(0.5);
  const Number discriminant = square(half_b) - p[2] * p[0];
  if (discriminant.sign() <= 0) return result;
  const Number root = sqrt(discriminant);
  const bool falling = half_b.value() < 0;
  const Number sum = falling ? root - half_b : -(half_b + root);
  // The slope at (-b / 2 + root) / a is 2 root, whatever the sign of a.
  result.at.push_back({sum / p[2], falling ? 1 : -1});
  result.at.push_back({p[0] / sum, falling ? -1 : 1});
  return result;
}

/// Returns every place where the polynomial changes its sign. Degrees up to 2 are by formula.
/// Above, roots are isolated by those of the derivative. Throws Undecided if the precision does not
/// suffice. With the highest precision, extrema that cannot be distinguished from 0 are double
/// roots, which are left out.
template <class Number>
SignChanges<Number> sign_changes(const Polynomial<Number>& polynomial) {
  Polynomial<Number> p = polynomial;
  while (!p.empty() && p.back().sign() == 0) p.pop_back();
  if (p.empty()) return {};
  const int leading = p.back().sign();
  const bool even = p.size() % 2 == 1;
  if (p.size() == 1) return {.before = leading, .at = {}};
  if (p.size() == 2) return {.before = -leading, .at = {{-p[0] / p[1], leading}}};
  if (p.size() == 3) return quadratic_changes(p, leading);

  const Polynomial<Number> slope = derivative(p);
  auto extrema = sign_changes(slope).at;
  for (std::size_t i = 1; i < extrema.size(); ++i) {
    for (std::size_t k = i; k > 0 && is_less(extrema[k].x, extrema[k - 1].x); --k)
      std::swap(extrema[k], extrema[k - 1]);
  }
  const Number bound(bound_of_roots(p));
  SignChanges<Number> result{.before = even ? leading : -leading, .at = {}};
  Number low = -bound;
  int sign_low = result.before;
  const auto up_to = [&](const Number& high, int sign_high) {
    if (sign_high != sign_low)
      result.at.push_back({enclose(p, slope, low.middle(), high.middle(), sign_low), sign_high});
    low = high;
    sign_low = sign_high;
  };
  for (const auto& extremum : extrema) {
    // This is on the whole enclosure: the extreme value itself has this sign, and all between it
    // and the middle.
    const int sign = evaluate(p, extremum.x).sign();
    if (sign != 0) up_to(extremum.x, sign);
  }
  up_to(bound, leading);
  return result;
}

}  // namespace crt::test
