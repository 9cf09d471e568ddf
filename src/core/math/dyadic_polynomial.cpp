#include "core/math/dyadic_polynomial.hpp"

#include <algorithm>
#include <utility>

namespace crt::core {
namespace {

Dyadic middle(const Dyadic& a, const Dyadic& b) {
  constexpr double half = 0.5;
  return (a + b) * Dyadic(half);
}

bool is_less(const Dyadic& a, const Dyadic& b) {
  return (a - b).sign() < 0;
}

/// Returns a point near the middle that is no root.
Dyadic splitting_point(const DyadicPolynomial& polynomial, const Dyadic& low, const Dyadic& high) {
  Dyadic split = middle(low, high);
  while (polynomial.value(split).sign() == 0) split = middle(low, split);
  return split;
}

void separate(const DyadicPolynomial& polynomial, const SturmChain& chain, const Dyadic& low,
              const Dyadic& high, int depth, std::vector<Dyadic>& separators) {
  const int roots = chain.count(low, high);
  if (roots == 0) return;
  if (roots == 1 || depth == 0) {
    separators.push_back(high);
    return;
  }
  const Dyadic split = splitting_point(polynomial, low, high);
  separate(polynomial, chain, low, split, depth - 1, separators);
  separate(polynomial, chain, split, high, depth - 1, separators);
}

}  // namespace

DyadicPolynomial::DyadicPolynomial(std::vector<Dyadic> coefficients)
    : coefficients_(std::move(coefficients)) {
  trim();
}

void DyadicPolynomial::trim() {
  while (!coefficients_.empty() && coefficients_.back().sign() == 0) coefficients_.pop_back();
}

Dyadic DyadicPolynomial::value(const Dyadic& x) const {
  Dyadic sum;
  for (std::size_t i = coefficients_.size(); i-- > 0;) sum = sum * x + coefficients_[i];
  return sum;
}

DyadicPolynomial DyadicPolynomial::derivative() const {
  std::vector<Dyadic> result;
  for (std::size_t i = 1; i < coefficients_.size(); ++i) {
    result.push_back(Dyadic(static_cast<double>(i)) * coefficients_[i]);
  }
  return DyadicPolynomial(std::move(result));
}

DyadicPolynomial operator+(const DyadicPolynomial& a, const DyadicPolynomial& b) {
  const bool a_is_longer = a.degree() > b.degree();
  std::vector<Dyadic> sum = a_is_longer ? a.coefficients_ : b.coefficients_;
  const std::vector<Dyadic>& other = a_is_longer ? b.coefficients_ : a.coefficients_;
  for (std::size_t i = 0; i < other.size(); ++i) sum[i] = sum[i] + other[i];
  return DyadicPolynomial(std::move(sum));
}

DyadicPolynomial operator-(const DyadicPolynomial& a, const DyadicPolynomial& b) {
  return a + Dyadic(-1) * b;
}

DyadicPolynomial operator*(const DyadicPolynomial& a, const DyadicPolynomial& b) {
  if (a.degree() < 0 || b.degree() < 0) return {};
  std::vector<Dyadic> product(a.coefficients_.size() + b.coefficients_.size() - 1);
  for (std::size_t i = 0; i < a.coefficients_.size(); ++i) {
    for (std::size_t j = 0; j < b.coefficients_.size(); ++j) {
      product[i + j] = product[i + j] + a.coefficients_[i] * b.coefficients_[j];
    }
  }
  return DyadicPolynomial(std::move(product));
}

DyadicPolynomial operator*(const Dyadic& s, const DyadicPolynomial& p) {
  std::vector<Dyadic> result = p.coefficients_;
  for (Dyadic& coefficient : result) coefficient = s * coefficient;
  return DyadicPolynomial(std::move(result));
}

DyadicPolynomial negative_remainder(const DyadicPolynomial& a, const DyadicPolynomial& b) {
  // This is long division, but instead of dividing by b's leading coefficient it multiplies the
  // rest by that coefficient's absolute value.
  const bool negative = b.leading().sign() < 0;
  const Dyadic size = negative ? -b.leading() : b.leading();
  DyadicPolynomial rest = a;
  while (rest.degree() >= b.degree()) {
    const auto shift = static_cast<std::size_t>(rest.degree() - b.degree());
    const Dyadic factor = negative ? -rest.leading() : rest.leading();
    for (Dyadic& coefficient : rest.coefficients_) coefficient = size * coefficient;
    for (std::size_t i = 0; i < b.coefficients_.size(); ++i) {
      rest.coefficients_[i + shift] = rest.coefficients_[i + shift] - factor * b.coefficients_[i];
    }
    rest.trim();
  }
  for (Dyadic& coefficient : rest.coefficients_) coefficient = -coefficient;
  return rest;
}

DyadicPolynomial common_divisor(DyadicPolynomial a, DyadicPolynomial b) {
  while (b.degree() >= 0) a = std::exchange(b, negative_remainder(a, b));
  return a;
}

SturmChain::SturmChain(const DyadicPolynomial& polynomial) {
  chain_.push_back(polynomial);
  DyadicPolynomial next = polynomial.derivative();
  while (next.degree() >= 0) {
    chain_.push_back(std::move(next));
    next = negative_remainder(chain_[chain_.size() - 2], chain_.back());
  }
}

int SturmChain::changes_at(const Dyadic& x) const {
  int changes = 0;
  int before = 0;
  for (const DyadicPolynomial& polynomial : chain_) {
    const int sign = polynomial.value(x).sign();
    if (sign * before < 0) ++changes;
    if (sign != 0) before = sign;
  }
  return changes;
}

int SturmChain::count() const {
  int difference = 0;
  for (std::size_t i = 1; i < chain_.size(); ++i) {
    const int above = chain_[i - 1].leading().sign() * chain_[i].leading().sign();
    const bool odd = (chain_[i - 1].degree() - chain_[i].degree()) % 2 != 0;
    const int below = odd ? -above : above;
    difference += (below < 0 ? 1 : 0) - (above < 0 ? 1 : 0);
  }
  return difference;
}

std::vector<Dyadic> root_separators(const DyadicPolynomial& polynomial) {
  const SturmChain chain(polynomial);
  const int roots = chain.count();
  if (roots == 0) return {};
  Dyadic bound = 1;
  const auto is_bound = [&] {
    return polynomial.value(bound).sign() != 0 && polynomial.value(-bound).sign() != 0 &&
           chain.count(-bound, bound) == roots;
  };
  while (!is_bound()) bound = bound + bound;
  std::vector<Dyadic> separators{-bound};
  constexpr int max_halvings = 1200;
  separate(polynomial, chain, -bound, bound, max_halvings, separators);
  return separators;
}

Dyadic refined_root(const DyadicPolynomial& polynomial, Dyadic low, Dyadic high,
                    const Dyadic& offset, const std::function<bool(const Dyadic& x)>& is_beyond) {
  const DyadicPolynomial derivative = polynomial.derivative();
  // This is Newton's iteration. Every fourth step is a bisection, which converges whatever the
  // function does.
  constexpr int most_steps = 2000;
  constexpr int steps_to_a_halving = 4;
  constexpr int enough_bits = 108;
  Dyadic x = middle(low, high);
  for (int step = 1; step < most_steps; ++step) {
    const Dyadic height = polynomial.value(x);
    if (height.sign() == 0) return x;
    (is_beyond(x) ? high : low) = x;
    const Dyadic slope = derivative.value(x);
    Dyadic next = middle(low, high);
    Dyadic change = high - low;
    if (slope.sign() != 0 && step % steps_to_a_halving != 0) {
      const DoubleDouble newton_step = (-height.rounded() / slope.rounded()).unscaled();
      const Dyadic newton = x + Dyadic(newton_step.hi) + Dyadic(newton_step.lo);
      if (is_less(low, newton) && is_less(newton, high)) {
        next = newton;
        change = newton - x;
      }
    }
    x = next;
    const Dyadic sum = x + offset;
    if (change.sign() == 0 ||
        (sum.sign() != 0 && change.rounded().exponent < sum.rounded().exponent - enough_bits)) {
      break;
    }
  }
  return x;
}

}  // namespace crt::core
