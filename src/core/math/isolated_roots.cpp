#include "core/math/isolated_roots.hpp"

#include <array>
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
    const int last = near_.sign_of_leading();
    std::vector<End> ends;
    ends.push_back(end_at(-1, near_.degree() % 2 == 0 ? last : -last));
    if (near_.degree() > 1) {
      for (const DoubleDouble& turn : slope_.roots()) append_turn(turn, ends);
    }
    ends.push_back(end_at(1, last));
    Brackets found;
    for (std::size_t i = 1; i < ends.size(); ++i) {
      if (ends[i - 1].sign * ends[i].sign < 0) found.push_back(narrowed(ends[i - 1], ends[i]));
    }
    return found;
  }

 private:
  /// An End is a place where the sign is known.
  struct End {
    DoubleDouble y;
    Dyadic x;
    int sign = 0;
    bool is_near_last = false;  ///< it makes a bracket with the one before that is narrow enough
  };

  Dyadic place(const DoubleDouble& y) const {
    const Dyadic unit(std::ldexp(1.0, near_.exponent()));
    return unit * (Dyadic(y.hi) + Dyadic(y.lo));
  }

  End end_at(const DoubleDouble& y, int sign) const { return {y, place(y), sign}; }

  int sign_at(const DoubleDouble& y) const {
    const int sign = near_.value(y).certain_sign();
    return sign != 0 ? sign : polynomial_.value(place(y)).sign();
  }

  /// Appends the place where the polynomial turns, or four that enclose two roots there.
  void append_turn(const DoubleDouble& y, std::vector<End>& ends) const {
    if (const int sign = near_.value(y).certain_sign(); sign != 0) {
      ends.push_back(end_at(y, sign));
      return;
    }
    // The turn is found to twice as many bits, and the roots beside it as those of a parabola.
    const DyadicPolynomial slope = polynomial_.derivative();
    const DyadicPolynomial bend = slope.derivative();
    Dyadic x = place(y);
    const ScaledNumber bend_here = bend.value(x).rounded();
    if (bend_here.value.hi == 0) return;
    const DoubleDouble step = (-slope.value(x).rounded() / bend_here).unscaled();
    x = x + Dyadic(step.hi) + Dyadic(step.lo);
    const Dyadic height = polynomial_.value(x);
    const ScaledNumber squared = -(height + height).rounded() / bend_here;
    ends.push_back({y, x, height.sign()});
    if (!(squared.value.hi > 0)) return;
    const double off = sqrt(squared).unscaled().hi;
    if (!std::isfinite(off)) return;
    constexpr double share = 0x1p-10;
    const Dyadic inner(off * (1 - share));
    const Dyadic outer(off * (1 + share));
    const std::array<Dyadic, 4> places = {x - outer, x - inner, x + inner, x + outer};
    std::array<int, 4> signs{};
    for (std::size_t i = 0; i < places.size(); ++i) signs[i] = polynomial_.value(places[i]).sign();
    const int sign = height.sign();
    if (signs != std::array{-sign, sign, sign, -sign}) return;
    ends.pop_back();
    for (std::size_t i = 0; i < places.size(); ++i) {
      ends.push_back({y, places[i], signs[i], i % 2 == 1});
    }
  }

  /// Returns a narrow bracket of a change of the sign between two places. It is no wider than they
  /// are apart.
  IsolatedRoots::Bracket narrowed(const End& first, const End& second) const {
    IsolatedRoots::Bracket bracket{first.x, second.x};
    if (second.is_near_last) return bracket;
    const DoubleDouble y = near_.root_between(slope_, first.y, second.y, first.sign);
    const Bounded height = near_.value(y);
    constexpr double roundings = 16;
    constexpr double least = 0x1p-500;
    constexpr int max_tries = 4;
    constexpr double widening = 0x1p12;
    const double least_off =
        roundings * (height.size() + height.error) / std::abs(slope_.value(y).value.hi) +
        roundings * 0x1p-104 * std::abs(y.hi) + least;
    // Goes away from y until the sign is that of an end. Returns whether the other one came first.
    const auto approach = [&](double way, const End& end, Dyadic& near_end, Dyadic& far_end) {
      bool passed_root = false;
      double off = least_off;
      for (int i = 0; i < max_tries && off < 1; ++i, off *= widening) {
        const DoubleDouble here = y + DoubleDouble(way * off);
        if (!(way * (end.y - here).hi > 0)) break;
        const int sign = sign_at(here);
        if (sign == end.sign) {
          near_end = place(here);
          break;
        }
        if (sign == 0) continue;
        far_end = place(here);
        passed_root = true;
      }
      return passed_root;
    };
    if (!approach(-1, first, bracket.low, bracket.high)) {
      approach(1, second, bracket.high, bracket.low);
    }
    return bracket;
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

/// Guesses brackets relative to the mean of all roots. Where all of them are close to it, they
/// differ plainly there.
Brackets brackets_about_mean(const DyadicPolynomial& polynomial, std::size_t count) {
  const auto degree = static_cast<std::size_t>(polynomial.degree());
  const Dyadic weight = Dyadic(static_cast<double>(degree)) * polynomial.leading();
  const DoubleDouble mean =
      (-polynomial.coefficient(degree - 1).rounded() / weight.rounded()).unscaled();
  if (!std::isfinite(mean.hi)) return {};
  const Dyadic middle = Dyadic(mean.hi) + Dyadic(mean.lo);
  const DyadicPolynomial moved = about(polynomial, middle);
  Brackets brackets = guessed_brackets(moved, NearPolynomial(moved), count);
  for (auto& [low, high] : brackets) {
    low = low + middle;
    high = high + middle;
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

DyadicPolynomial about(const DyadicPolynomial& polynomial, const Dyadic& x) {
  const DyadicPolynomial argument({x, 1});
  DyadicPolynomial sum;
  for (int i = polynomial.degree(); i >= 0; --i) {
    sum = sum * argument + DyadicPolynomial({polynomial.coefficient(static_cast<std::size_t>(i))});
  }
  return sum;
}

IsolatedRoots isolated_roots(const DyadicPolynomial& polynomial) {
  if (polynomial.degree() < 1) return {};
  const NearPolynomial near(polynomial);
  if (const auto count = count_simple_roots(polynomial, near)) {
    Brackets guessed = guessed_brackets(polynomial, near, *count);
    if (guessed.size() != *count) guessed = brackets_about_mean(polynomial, *count);
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
