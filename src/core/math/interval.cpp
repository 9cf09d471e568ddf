#include "core/math/interval.hpp"

#include <array>
#include <crt/elementary.hpp>
#include <cstdint>
#include <numbers>

#include "core/math/elementary_tables.hpp"
#include "core/math/polynomial.hpp"

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

struct QuickWave {
  double sine;
  double cosine;
};

/// Returns sine and cosine of x, each within four units in the last place, in a fifth of the time
/// that the two functions take. Most of the error is that of x less its quarters of a turn, whose
/// three parts add up to pi / 2.
QuickWave quick_wave(double x) {
  constexpr double farthest = 0x1p25;
  if (!(std::abs(x) < farthest)) return {elementary::sin(x), elementary::cos(x)};
  constexpr std::array<double, 8> of_sine = {
      -1.0 / 6,        1.0 / 120,        -1.0 / 5040,          1.0 / 362880,
      -1.0 / 39916800, 1.0 / 6227020800, -1.0 / 1307674368000, 1.0 / 355687428096000};
  constexpr std::array<double, 8> of_cosine = {
      -1.0 / 2,       1.0 / 24,        -1.0 / 720,         1.0 / 40320,
      -1.0 / 3628800, 1.0 / 479001600, -1.0 / 87178291200, 1.0 / 20922789888000};
  constexpr double whole = 0x1.8p52;  // adding this rounds to a whole number
  using namespace elementary_tables;
  const double quarters = (x * (2 / pi) + whole) - whole;
  const double rest = std::fma(-quarters, half_pi_last,
                               std::fma(-quarters, half_pi_rest, std::fma(-quarters, half_pi, x)));
  const double square = rest * rest;
  const double s = std::fma(rest * square, polynomial(of_sine, square), rest);
  const double c = std::fma(square, polynomial(of_cosine, square), 1.0);
  switch (static_cast<std::int64_t>(quarters) & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

/// Returns the range of sine or cosine near a centre, from its value and its slope there. No second
/// derivative is above 1.
Interval series(double value, double slope, const Interval& x, double center) {
  constexpr double roundings = 0x1p-49;
  constexpr double more_than_rounding = 1 + 0x1p-40;
  const double off = x.lo + 0.5 * x.width() - center;
  const double reach =
      more_than_rounding * (0.5 * x.width() + 0x1p-51 * (std::abs(center) + std::abs(off)));
  const double farthest = std::abs(off) + reach;
  const double change = slope * off;
  const double nearest = value + change;
  const double error = more_than_rounding * (roundings * (std::abs(value) + std::abs(change)) +
                                             std::abs(slope) * reach + 0.5 * farthest * farthest) +
                       std::numeric_limits<double>::min();
  return {std::max(nearest - error, -1.0), std::min(nearest + error, 1.0)};
}

/// Returns x >= 0 to a power of at least 1 that is whole, within four units in the last place.
double power_of_size(double x, double exponent) {
  // Each product is off by half a unit.
  constexpr double max_products = 8;
  if (exponent > max_products) return elementary::pow(x, exponent);
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
  const Interval result = around(elementary::exp(a.lo), elementary::exp(a.hi));
  return {std::max(0.0, result.lo), result.hi};
}

Interval logarithm(const Interval& a) {
  return around(elementary::log(a.lo), elementary::log(a.hi));
}

Interval sine(const Interval& a) {
  if (!(a.width() < 2 * pi)) return {-1, 1};
  return range_of_wave(a, quick_wave(a.lo).sine, quick_wave(a.hi).sine, pi / 2);
}

Interval cosine(const Interval& a) {
  if (!(a.width() < 2 * pi)) return {-1, 1};
  return range_of_wave(a, quick_wave(a.lo).cosine, quick_wave(a.hi).cosine, 0);
}

Wave wave(const Interval& middle, const Interval& all) {
  // Taylor's series about a centre takes one call of each function.
  constexpr double widest = 0.5;
  const bool is_narrow = all.width() <= widest;
  const Interval& about = is_narrow ? all : middle;
  const double center = about.lo + 0.5 * about.width();
  if (!(about.width() <= widest)) return {{-1, 1}, {-1, 1}, sine(all), cosine(all)};
  const auto [s, c] = quick_wave(center);
  Wave result = {series(s, c, middle, center), series(c, -s, middle, center), {}, {}};
  if (is_narrow) {
    result.sine = series(s, c, all, center);
    result.cosine = series(c, -s, all, center);
  } else {
    result.sine = sine(all);
    result.cosine = cosine(all);
  }
  return result;
}

Interval tangent(const Interval& a) {
  if (!(a.width() < pi) || may_contain_turn(a, pi / 2, pi)) return Interval::everything();
  return around(elementary::tan(a.lo), elementary::tan(a.hi));
}

Interval arc_sine(const Interval& a) {
  return around(elementary::asin(a.lo), elementary::asin(a.hi));
}

Interval arc_cosine(const Interval& a) {
  return around(elementary::acos(a.hi), elementary::acos(a.lo));
}

Interval arc_tangent(const Interval& a) {
  return around(elementary::atan(a.lo), elementary::atan(a.hi));
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
  const Interval result = around(elementary::pow(a.lo, exponent), elementary::pow(a.hi, exponent));
  return {std::max(0.0, result.lo), result.hi};
}

}  // namespace crt::core
