#include "core/math/isolated_roots.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/math/near_polynomial.hpp"

namespace crt::core {

namespace {

using Brackets = std::vector<IsolatedRoots::Bracket>;

/// A SignsNear has the signs of a polynomial at numbers of two doubles, by which it makes brackets.
class SignsNear {
 public:
  SignsNear(const DyadicPolynomial& polynomial, const NearPolynomial& near)
      : polynomial_(polynomial), near_(near), slope_(near.derivative()) {}

  /// Returns brackets that make all changes of the sign which it finds.
  Brackets brackets() const {
    std::vector<DoubleDouble> ends{-1};
    if (near_.degree() > 1) {
      for (const DoubleDouble& turn : slope_.roots()) ends.push_back(turn);
    }
    ends.emplace_back(1);
    const int last = near_.sign_of_leading();
    int sign = near_.degree() % 2 == 0 ? last : -last;
    Brackets found;
    for (std::size_t i = 1; i < ends.size(); ++i) {
      const int before = sign;
      sign = i + 1 < ends.size() ? sign_at(ends[i]) : last;
      if (before * sign < 0) found.push_back(narrowed(ends[i - 1], ends[i], before));
    }
    return found;
  }

 private:
  Dyadic place(const DoubleDouble& y) const {
    const Dyadic unit(std::ldexp(1.0, near_.exponent()));
    return unit * (Dyadic(y.hi) + Dyadic(y.lo));
  }

  int sign_at(const DoubleDouble& y) const {
    const int sign = near_.value(y).certain_sign();
    return sign != 0 ? sign : polynomial_.value(place(y)).sign();
  }

  /// Returns a narrow bracket of a change of the sign between two places. It is no wider than they
  /// are apart.
  IsolatedRoots::Bracket narrowed(DoubleDouble low, DoubleDouble high, int sign_low) const {
    const DoubleDouble y = near_.root_between(slope_, low, high, sign_low);
    const Bounded height = near_.value(y);
    constexpr double roundings = 16;
    constexpr double least = 0x1p-500;
    double off = roundings * (height.size() + height.error) / std::abs(slope_.value(y).value.hi) +
                 roundings * 0x1p-104 * std::abs(y.hi) + least;
    constexpr int most_tries = 4;
    constexpr double widening = 0x1p12;
    for (int i = 0; i < most_tries && off < 1; ++i, off *= widening) {
      const DoubleDouble from = y - DoubleDouble(off);
      const DoubleDouble to = y + DoubleDouble(off);
      if (!((from - low).hi > 0 && (high - to).hi > 0)) break;
      const int sign_from = sign_at(from);
      const int sign_to = sign_at(to);
      if (sign_from == sign_low && sign_to == -sign_low) {
        return {place(from), place(to)};
      }
      if (sign_from == -sign_low) high = from;
      if (sign_to == sign_low) low = to;
    }
    return {place(low), place(high)};
  }

  const DyadicPolynomial& polynomial_;
  const NearPolynomial& near_;
  NearPolynomial slope_;
};

/// Returns brackets of `count` roots if a look in double-double finds them, and else none. As the
/// sign changes in all brackets, and there are no more roots, each has one.
Brackets guessed_brackets(const DyadicPolynomial& polynomial, const NearPolynomial& near,
                          std::size_t count) {
  constexpr int largest_exponent = 400;
  if (std::abs(near.exponent()) > largest_exponent) return {};
  Brackets brackets = SignsNear(polynomial, near).brackets();
  if (brackets.size() != count) brackets.clear();
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
  if (polynomial.degree() < 1) return {};
  const NearPolynomial near(polynomial);
  if (const auto count = count_simple_roots(polynomial, near)) {
    Brackets guessed = guessed_brackets(polynomial, near, *count);
    if (guessed.size() == *count) return {polynomial, std::move(guessed)};
  }
  const auto count = static_cast<std::size_t>(SturmChain(polynomial).count());
  if (count == 0) return {};
  // Roots of a high multiplicity would take long to find.
  const DyadicPolynomial common = common_divisor(polynomial, polynomial.derivative());
  DyadicPolynomial simple = common.degree() < 1 ? polynomial : exact_quotient(polynomial, common);
  Brackets brackets = guessed_brackets(simple, NearPolynomial(simple), count);
  if (brackets.empty()) {
    const std::vector<Dyadic> separators = root_separators(simple);
    for (std::size_t i = 1; i < separators.size(); ++i) {
      brackets.push_back({separators[i - 1], separators[i]});
    }
  }
  return {std::move(simple), std::move(brackets)};
}

}  // namespace crt::core
