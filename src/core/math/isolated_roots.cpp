#include "core/math/isolated_roots.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace crt::core {

namespace {

using RoughPolynomial = std::vector<double>;

double value_of(const RoughPolynomial& polynomial, double x) {
  double sum = 0;
  for (std::size_t i = polynomial.size(); i-- > 0;) sum = sum * x + polynomial[i];
  return sum;
}

RoughPolynomial derivative_of(const RoughPolynomial& polynomial) {
  RoughPolynomial result;
  for (std::size_t i = 1; i < polynomial.size(); ++i) {
    result.push_back(static_cast<double>(i) * polynomial[i]);
  }
  return result;
}

/// Returns a polynomial of at least degree 1 in doubles, times a power of two.
RoughPolynomial rough(const DyadicPolynomial& polynomial) {
  std::vector<ScaledNumber> rounded;
  int largest = std::numeric_limits<int>::min();
  for (int i = 0; i <= polynomial.degree(); ++i) {
    rounded.push_back(polynomial.coefficient(static_cast<std::size_t>(i)).rounded());
    if (rounded.back().value.hi != 0) largest = std::max(largest, rounded.back().exponent);
  }
  RoughPolynomial result;
  for (const ScaledNumber& number : rounded) {
    result.push_back(std::ldexp(number.value.hi, number.exponent - largest));
  }
  return result;
}

/// Returns roots in doubles, each between two neighbours of the derivative's. They are as good as
/// rounding lets them be, and some may be lost.
std::vector<double> rough_roots(const RoughPolynomial& polynomial) {
  if (polynomial.size() < 2) return {};
  const double leading = polynomial.back();
  if (polynomial.size() == 2) return {-polynomial[0] / leading};
  double bound = 0;
  for (const double coefficient : polynomial) bound = std::max(bound, std::abs(coefficient));
  bound = 1 + bound / std::abs(leading);
  std::vector<double> ends = rough_roots(derivative_of(polynomial));
  ends.insert(ends.begin(), -bound);
  ends.push_back(bound);
  std::vector<double> roots;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    double low = ends[i];
    double high = ends[i + 1];
    const bool is_below = value_of(polynomial, low) < 0;
    if (is_below == (value_of(polynomial, high) < 0)) continue;
    constexpr int most_steps = 200;
    for (int step = 0; step < most_steps; ++step) {
      const double split = low + 0.5 * (high - low);
      if (!(split > low && split < high)) break;
      ((value_of(polynomial, split) < 0) == is_below ? low : high) = split;
    }
    roots.push_back(low);
  }
  return roots;
}

/// Returns whether some root may have a multiplicity of three: there the slope is next to nothing.
bool may_be_multiple(const RoughPolynomial& polynomial, const std::vector<double>& roots) {
  const RoughPolynomial slope = derivative_of(polynomial);
  return std::any_of(roots.begin(), roots.end(), [&](double root) {
    double size = 0;
    for (std::size_t i = slope.size(); i-- > 0;) {
      size = size * std::abs(root) + std::abs(slope[i]);
    }
    constexpr double plainly = 0x1p-20;
    return !(std::abs(value_of(slope, root)) > plainly * size);
  });
}

using Brackets = std::vector<IsolatedRoots::Bracket>;

/// Guesses brackets of `count` roots from roots in doubles. Returns none if that fails, or if some
/// root may be a multiple one. As the sign changes in all brackets, and there are no more roots,
/// each has one.
Brackets guessed_brackets(const DyadicPolynomial& polynomial, std::size_t count) {
  const RoughPolynomial doubles = rough(polynomial);
  const std::vector<double> roots = rough_roots(doubles);
  if (roots.size() != count || may_be_multiple(doubles, roots)) return {};
  const double largest = std::max(std::abs(roots.front()), std::abs(roots.back()));
  constexpr double share = 0x1p-40;
  const double margin = share * (largest > 0 ? largest : 1);
  if (!std::isfinite(largest)) return {};
  Brackets brackets;
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0 && !(roots[i] - roots[i - 1] > 4 * margin)) return {};
    const Dyadic low = roots[i] - margin;
    const Dyadic high = roots[i] + margin;
    if (polynomial.value(low).sign() * polynomial.value(high).sign() >= 0) return {};
    brackets.push_back({low, high});
  }
  return brackets;
}

/// Finds brackets of `count` roots, each of which changes the sign.
Brackets brackets_of(const DyadicPolynomial& polynomial, std::size_t count) {
  Brackets brackets = guessed_brackets(polynomial, count);
  if (!brackets.empty()) return brackets;
  const std::vector<Dyadic> separators = root_separators(polynomial);
  for (std::size_t i = 1; i < separators.size(); ++i) {
    brackets.push_back({separators[i - 1], separators[i]});
  }
  return brackets;
}

/// Returns a / b times some number, where b divides a.
DyadicPolynomial exact_quotient(DyadicPolynomial a, const DyadicPolynomial& b) {
  DyadicPolynomial quotient;
  while (a.degree() >= b.degree()) {
    std::vector<Dyadic> power(static_cast<std::size_t>(a.degree() - b.degree()) + 1);
    power.back() = a.leading();
    const DyadicPolynomial factor(std::move(power));
    quotient = b.leading() * quotient + factor;
    a = b.leading() * a - factor * b;
  }
  return quotient;
}

}  // namespace

IsolatedRoots isolated_roots(const DyadicPolynomial& polynomial) {
  const auto count = static_cast<std::size_t>(SturmChain(polynomial).count());
  if (count == 0) return {};
  Brackets guessed = guessed_brackets(polynomial, count);
  if (!guessed.empty()) return {polynomial, std::move(guessed)};
  const DyadicPolynomial common = common_divisor(polynomial, polynomial.derivative());
  // Roots of a high multiplicity would take long to find.
  DyadicPolynomial simple = common.degree() < 1 ? polynomial : exact_quotient(polynomial, common);
  Brackets brackets = brackets_of(simple, count);
  return {std::move(simple), std::move(brackets)};
}

}  // namespace crt::core
