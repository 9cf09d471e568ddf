#include "oracle/roots.hpp"

#include <algorithm>

namespace crt::test {
namespace {

std::vector<Interval> quadratic_roots(const Polynomial& p) {
  const Interval half_b = p[1] / Interval(2);
  const Interval discriminant = square(half_b) - p[2] * p[0];
  const int sign = discriminant.sign();
  if (sign < 0) return {};
  if (sign == 0) return {-half_b / p[2]};
  const Interval root = sqrt(discriminant);
  const Interval sum = half_b.middle().certain_sign() < 0 ? root - half_b : -(half_b + root);
  return {sum / p[2], p[0] / sum};
}

/// A power of two beyond all roots (twice Fujiwara's bound).
Interval bound_of_roots(const Polynomial& p) {
  const std::size_t degree = p.size() - 1;
  const long leading = p.back().exponent() - 1;
  long exponent = -100'000;
  for (std::size_t i = 0; i < degree; ++i) {
    if (p[i].exponent() < -500'000) continue;
    const long steps = static_cast<long>(degree - i);
    const long quotient = p[i].exponent() + 1 - leading;
    exponent = std::max(exponent, quotient >= 0 ? (quotient + steps - 1) / steps : quotient / steps);
  }
  return Interval::power_of_two(exponent + 2);
}

/// The one root between two points of different sign: Newton's iteration on points, with bisection
/// where it would leave the bounds; then an enclosure that is proved by signs.
Interval enclose(const Polynomial& p, const Polynomial& slope, Interval low, Interval high, int sign_low) {
  constexpr int most_steps = 3000;
  const long width = (high - low).exponent();
  Interval x = (low + high).middle() / Interval(2);
  x = x.middle();
  for (int step = 0; step < most_steps; ++step) {
    const Interval height = evaluate(p, x);
    const int sign = height.middle().certain_sign();
    if (sign == 0) break;
    (sign == sign_low ? low : high) = x;
    const Interval rate = evaluate(slope, x).middle();
    Interval next = (low + high).middle() / Interval(2);
    if (rate.certain_sign() != 0) {
      const Interval newton = (x - height.middle() / rate).middle();
      if (low.surely_below(newton) && newton.surely_below(high)) next = newton;
    }
    next = next.middle();
    const long moved = (next - x).exponent();
    x = next;
    if (moved < std::max(x.exponent(), width - Precision::bits) - Precision::bits / 2) break;
    // Newton from far away comes nearer by a constant factor only; halve now and then.
    if (step % 8 == 7) x = ((low + high).middle() / Interval(2)).middle();
  }
  // From narrow to wide, as far as the evaluation needs it.
  for (long share = Precision::bits / 2; share > 32; share -= 24) {
    const Interval margin = Interval::power_of_two(std::max(x.exponent(), width - 64) - share);
    const Interval left = (x - margin).lower();
    const Interval right = (x + margin).upper();
    if (evaluate(p, left).certain_sign() == sign_low && evaluate(p, right).certain_sign() == -sign_low)
      return hull(left, right);
  }
  if (Precision::bits < Precision::highest) throw Undecided{};
  return hull(low, high);
}

}  // namespace

Interval evaluate(const Polynomial& p, const Interval& x) {
  Interval result = p.back();
  for (std::size_t i = p.size() - 1; i-- > 0;) result = result * x + p[i];
  return result;
}

Polynomial derivative(const Polynomial& p) {
  Polynomial result;
  for (std::size_t i = 1; i < p.size(); ++i) result.push_back(p[i] * Interval(static_cast<double>(i)));
  return result;
}

std::vector<Interval> roots(const Polynomial& p) {
  Polynomial shorter = p;
  while (!shorter.empty() && shorter.back().sign() == 0) shorter.pop_back();
  if (shorter.size() < 2) return {};
  if (shorter.size() == 2) return {-shorter[0] / shorter[1]};
  if (shorter.size() == 3) return quadratic_roots(shorter);

  const Polynomial slope = derivative(shorter);
  std::vector<Interval> extrema = roots(slope);
  std::sort(extrema.begin(), extrema.end(),
            [](const Interval& a, const Interval& b) { return a.middle().surely_below(b.middle()); });
  const Interval bound = bound_of_roots(shorter);
  const int leading = shorter.back().sign();
  const bool even = shorter.size() % 2 == 1;
  std::vector<Interval> result;
  Interval low = -bound;
  int sign_low = even ? leading : -leading;
  const auto up_to = [&](const Interval& high, int sign_high) {
    if (sign_high != sign_low) result.push_back(enclose(shorter, slope, low.upper(), high.lower(), sign_low));
    low = high;
    sign_low = sign_high;
  };
  for (const Interval& extremum : extrema) {
    // On the whole enclosure: the extreme value itself has this sign.
    const int sign = evaluate(shorter, extremum).sign();
    if (sign != 0) up_to(extremum, sign);
  }
  up_to(bound, leading);
  return result;
}

}  // namespace crt::test
