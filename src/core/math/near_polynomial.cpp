#include "core/math/near_polynomial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace crt::core {

namespace {

int certain_sign(const Bounded& number) {
  return number.certain_sign();
}
int certain_sign(const Dyadic& number) {
  return number.sign();
}

/// Returns the discriminant of a polynomial of degree 2, 3 or 4 times a positive number. `c` has
/// its coefficients, that of x^0 first.
/// Source: Cremona, Reduction of binary cubic and quartic forms, 1999 (the invariants I and J).
template <class Number>
Number discriminant(const std::vector<Number>& c) {
  const auto times = [](double factor, const Number& number) { return Number{factor} * number; };
  if (c.size() == 3) return c[1] * c[1] - times(4, c[2] * c[0]);
  if (c.size() == 4) {
    const Number middle = c[2] * c[1];
    const Number outer = c[3] * c[0];
    return middle * middle + times(18, middle * outer) - times(27, outer * outer) -
           times(4, c[2] * c[2] * c[2] * c[0] + c[1] * c[1] * c[1] * c[3]);
  }
  const Number i = times(12, c[4] * c[0]) - times(3, c[3] * c[1]) + c[2] * c[2];
  const Number j = c[2] * (times(72, c[4] * c[0]) + times(9, c[3] * c[1]) - times(2, c[2] * c[2])) -
                   times(27, c[4] * c[1] * c[1] + c[0] * c[3] * c[3]);
  return times(4, i * i * i) - j * j;
}

/// Returns whether a quartic has four real roots, or else none, where its discriminant is positive.
template <class Number>
std::optional<bool> has_all_roots(const std::vector<Number>& c) {
  const auto times = [](double factor, const Number& number) { return Number{factor} * number; };
  const Number outer = c[4] * c[2];
  const Number squared = c[3] * c[3];
  const int bend = certain_sign(times(8, outer) - times(3, squared));
  const int level =
      certain_sign(c[4] * c[4] * (times(64, c[4] * c[0]) - times(16, c[3] * c[1])) +
                   times(16, outer * (squared - outer)) - times(3, squared * squared));
  if (bend > 0 || level > 0) return false;
  return bend < 0 && level < 0 ? std::optional(true) : std::nullopt;
}

template <class Number>
std::optional<std::size_t> count_roots(const std::vector<Number>& c) {
  const std::size_t degree = c.size() - 1;
  const int sign = certain_sign(discriminant(c));
  if (sign == 0) return std::nullopt;
  // Of two roots that are not real there is one pair if the discriminant is negative.
  if (sign < 0) return degree - 2;
  if (degree < 4) return degree;
  const std::optional<bool> all = has_all_roots(c);
  if (!all) return std::nullopt;
  return *all ? 4U : 0U;
}

Bounded bounded(const ScaledNumber& number, int exponent) {
  constexpr double roundoff = 0x1p-98;
  constexpr double underflow = 0x1p-1000;
  const DoubleDouble value = ScaledNumber{number.value, number.exponent + exponent}.unscaled();
  return {value, roundoff * std::abs(value.hi) + underflow};
}

}  // namespace

NearPolynomial::NearPolynomial(const DyadicPolynomial& polynomial) {
  const int degree = polynomial.degree();
  std::vector<ScaledNumber> rounded;
  rounded.reserve(static_cast<std::size_t>(degree) + 1);
  for (int i = 0; i <= degree; ++i) {
    rounded.push_back(polynomial.coefficient(static_cast<std::size_t>(i)).rounded());
  }
  // No root is larger than twice the largest of |a_i / a_n|^(1 / (n - i)) (Fujiwara 1916).
  const int leading = rounded.back().exponent;
  std::optional<int> largest;
  for (int i = 0; i < degree; ++i) {
    const ScaledNumber& number = rounded[static_cast<std::size_t>(i)];
    if (number.value.hi == 0) continue;
    const int steps = degree - i;
    const int quotient = number.exponent - leading + 1;
    const int root = quotient > 0 ? (quotient + steps - 1) / steps : -(-quotient / steps);
    largest = std::max(largest.value_or(root), root);
  }
  exponent_ = largest.value_or(0) + 2;
  for (int i = 0; i <= degree; ++i) {
    coefficients_.push_back(
        bounded(rounded[static_cast<std::size_t>(i)], (i - degree) * exponent_ - leading));
  }
}

Bounded NearPolynomial::value(const DoubleDouble& y) const {
  Bounded sum = coefficients_.back();
  for (std::size_t i = coefficients_.size() - 1; i-- > 0;) {
    sum = sum * Bounded{y} + coefficients_[i];
  }
  return sum;
}

NearPolynomial NearPolynomial::derivative() const {
  NearPolynomial result;
  result.exponent_ = exponent_;
  result.coefficients_.reserve(degree());
  for (std::size_t i = 1; i < coefficients_.size(); ++i) {
    result.coefficients_.push_back(Bounded{static_cast<double>(i)} * coefficients_[i]);
  }
  return result;
}

std::vector<DoubleDouble> NearPolynomial::roots() const {
  if (degree() == 1) return {-coefficients_[0].value / coefficients_[1].value};
  const NearPolynomial slope = derivative();
  std::vector<DoubleDouble> ends = slope.roots();
  ends.insert(ends.begin(), DoubleDouble(-1));
  ends.emplace_back(1);
  std::vector<DoubleDouble> result;
  int sign = value(ends[0]).sign();
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const int before = sign;
    sign = value(ends[i]).sign();
    if (sign != before) result.push_back(root_between(slope, ends[i - 1], ends[i], before));
  }
  return result;
}

/// This is Newton's iteration. Where it leaves what is between both sides, that is halved.
DoubleDouble NearPolynomial::root_between(const NearPolynomial& slope, DoubleDouble low,
                                          DoubleDouble high, int sign_low) const {
  const auto halved = [](const DoubleDouble& a) { return DoubleDouble(0.5 * a.hi, 0.5 * a.lo); };
  DoubleDouble y = halved(low + high);
  constexpr int most_steps = 200;
  constexpr double enough = 0x1p-100;
  for (int step = 0; step < most_steps; ++step) {
    const Bounded height = value(y);
    if (!height.is_certain()) break;
    (height.sign() == sign_low ? low : high) = y;
    const DoubleDouble last = y;
    y = y - height.value / slope.value(y).value;
    if (!((y - low).hi > 0 && (high - y).hi > 0)) y = halved(low + high);
    if (std::abs((y - last).hi) <= enough * std::abs(y.hi)) break;
  }
  return y;
}

std::optional<std::size_t> NearPolynomial::root_count() const {
  return count_roots(coefficients_);
}

std::optional<std::size_t> count_simple_roots(const DyadicPolynomial& polynomial,
                                              const NearPolynomial& near) {
  if (polynomial.degree() == 1) return 1;
  constexpr int highest = 4;
  if (polynomial.degree() < 1 || polynomial.degree() > highest) return std::nullopt;
  if (const auto count = near.root_count()) return count;
  std::vector<Dyadic> coefficients;
  for (std::size_t i = 0; i <= near.degree(); ++i) {
    coefficients.push_back(polynomial.coefficient(i));
  }
  return count_roots(coefficients);
}

}  // namespace crt::core
