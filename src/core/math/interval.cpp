#include "core/math/interval.hpp"

#include <numbers>
#include <utility>

namespace crt::core {

namespace {

constexpr double pi = std::numbers::pi;

/// Returns the range of sine or cosine, given its values at both ends and where it is greatest.
Interval range_of_wave(const Interval& a, double at_low, double at_high, double greatest) {
  Interval result = around(std::min(at_low, at_high), std::max(at_low, at_high));
  result.lo = may_contain_turn(a, greatest + pi, 2 * pi) ? -1 : std::max(result.lo, -1.0);
  result.hi = may_contain_turn(a, greatest, 2 * pi) ? 1 : std::min(result.hi, 1.0);
  return result;
}

/// Returns x >= 0 to a power of at least 1 that is whole, within four units in the last place.
double power_of_size(double x, double exponent) {
  // Each product is off by half a unit.
  constexpr double most_products = 8;
  if (exponent > most_products) return std::pow(x, exponent);
  double result = x;
  for (double i = 1; i < exponent; ++i) result *= x;
  return result;
}

}  // namespace

bool may_contain_turn(const Interval& a, double offset, double period) {
  // This is more than the rounding of the multiples of pi.
  constexpr double slack = 0x1p-48;
  constexpr double farthest = 0x1p40;
  if (!(a.magnitude() < farthest)) return true;
  const double margin = slack * (1 + a.magnitude());
  const double turn = std::ceil((a.lo - margin - offset) / period);
  return offset + turn * period <= a.hi + 2 * margin;
}

Interval square_root(const Interval& a) {
  return {std::max(0.0, rounded_down(std::sqrt(a.lo))), rounded_up(std::sqrt(a.hi))};
}

Interval exponential(const Interval& a) {
  const Interval result = around(std::exp(a.lo), std::exp(a.hi));
  return {std::max(0.0, result.lo), result.hi};
}

Interval logarithm(const Interval& a) {
  return around(std::log(a.lo), std::log(a.hi));
}

Interval sine(const Interval& a) {
  if (!(a.width() < 2 * pi)) return {-1, 1};
  return range_of_wave(a, std::sin(a.lo), std::sin(a.hi), pi / 2);
}

Interval cosine(const Interval& a) {
  if (!(a.width() < 2 * pi)) return {-1, 1};
  return range_of_wave(a, std::cos(a.lo), std::cos(a.hi), 0);
}

Wave wave(const Interval& middle, const Interval& all) {
  // Taylor's series about a centre takes one call of each function.
  constexpr double widest = 0.5;
  const bool is_narrow = all.width() <= widest;
  const Interval& about = is_narrow ? all : middle;
  const double center = about.lo + 0.5 * about.width();
  if (!(about.width() <= widest)) return {{-1, 1}, {-1, 1}, sine(all), cosine(all)};
  const Interval s = around(std::sin(center), std::sin(center));
  const Interval c = around(std::cos(center), std::cos(center));
  const auto of = [&](const Interval& x) {
    const Interval off = x - Interval::of(center);
    const double rest = rounded_up(0.5 * off.magnitude() * off.magnitude());
    const Interval remainder = {-rest, rest};
    return std::pair{s + c * off + remainder, c - s * off + remainder};
  };
  const auto within_one = [](const Interval& x) {
    return Interval{std::max(x.lo, -1.0), std::min(x.hi, 1.0)};
  };
  const auto [sine_in_middle, cosine_in_middle] = of(middle);
  Wave result = {within_one(sine_in_middle), within_one(cosine_in_middle), {}, {}};
  if (is_narrow) {
    const auto [sine_of_all, cosine_of_all] = of(all);
    result.sine = within_one(sine_of_all);
    result.cosine = within_one(cosine_of_all);
  } else {
    result.sine = sine(all);
    result.cosine = cosine(all);
  }
  return result;
}

Interval tangent(const Interval& a) {
  if (!(a.width() < pi) || may_contain_turn(a, pi / 2, pi)) return Interval::everything();
  return around(std::tan(a.lo), std::tan(a.hi));
}

Interval arc_sine(const Interval& a) {
  return around(std::asin(a.lo), std::asin(a.hi));
}

Interval arc_cosine(const Interval& a) {
  return around(std::acos(a.hi), std::acos(a.lo));
}

Interval arc_tangent(const Interval& a) {
  return around(std::atan(a.lo), std::atan(a.hi));
}

Interval whole_power(const Interval& a, double exponent) {
  const double low = power_of_size(std::abs(a.lo), exponent);
  const double high = power_of_size(std::abs(a.hi), exponent);
  if (std::fmod(exponent, 2) != 0) {
    return around(std::copysign(low, a.lo), std::copysign(high, a.hi));
  }
  const Interval result = around(std::min(low, high), std::max(low, high));
  return {a.contains(0) ? 0 : std::max(0.0, result.lo), result.hi};
}

Interval power(const Interval& a, double exponent) {
  const Interval result = around(std::pow(a.lo, exponent), std::pow(a.hi, exponent));
  return {std::max(0.0, result.lo), result.hi};
}

}  // namespace crt::core
