// This file computes the functions of crt/elementary.hpp. Each argument is reduced to a step of a
// table and a small rest. What is left is a short power series, whose leading terms and the table
// are in double-double. So a result has an error of some 2^-67 of itself before it is rounded.
//
// No operation here but those of IEEE 754 is used, in an order that is written down, so all
// machines compute the same bits. Sources: Tang, Table-driven implementation of the exponential
// function, 1989; Payne, Hanek, Radian reduction for trigonometric functions, 1983; Muller,
// Elementary functions, 3rd edition, 2016. Tests: tests/elementary/
#include <crt/elementary.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

#include "core/math/double_double.hpp"
#include "core/math/elementary_tables.hpp"
#include "core/math/polynomial.hpp"

namespace crt::elementary {

namespace {

using namespace core::elementary_tables;
using core::DoubleDouble;
using core::polynomial;
using core::quick_two_sum;
using core::two_product;
using core::two_sum;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr int fraction_bits = 52;
/// Below this, sin x, tan x, asin x and atan x are nearer to x than to any other double.
constexpr double own_value = 0x1p-27;
constexpr double steps_of_one = 64;

/// Returns the nearest whole number, for |x| < 2^51.
double nearest(double x) {
  constexpr double whole = 0x1.8p52;
  return (x + whole) - whole;
}

/// Returns 2^exponent, which is a normal number.
double power_of_two(int exponent) {
  constexpr int bias = 1023;
  return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + bias) << fraction_bits);
}

/// Returns x 2^exponent rounded once, for x from 1/2 to 2.
double scaled(const DoubleDouble& x, int exponent) {
  constexpr int largest = 1023;
  constexpr int least_normal = -1022;
  constexpr int surely_nothing = -1080;
  if (exponent > largest)
    return x.value() * power_of_two(largest) * power_of_two(exponent - largest);
  if (exponent > least_normal || (exponent == least_normal && x.hi >= 1))
    return x.value() * power_of_two(exponent);
  if (exponent < surely_nothing) return 0;
  // The last place of the sum with this number is that of the result, so adding it rounds there.
  const double rounder = power_of_two(least_normal - exponent);
  const DoubleDouble sum = two_sum(rounder, x.hi);
  const double rounded = sum.hi + (sum.lo + x.lo);
  constexpr int half_way = -1000;
  return (rounded - rounder) * power_of_two(half_way) * power_of_two(exponent - half_way);
}

// ---- sine, cosine, tangent --------------------------------------------------------------------

/// A Reduced angle is `quadrant` quarters of a turn and a rest of at most pi / 4 (and a rounding).
struct Reduced {
  DoubleDouble rest;
  unsigned quadrant = 0;
};

/// Returns the rest of a product of 256 bits, the upper two of which count quarters of turns.
Reduced quarters(std::array<std::uint64_t, 4> words) {
  constexpr int bits_behind_point = 62;
  unsigned quadrant = static_cast<unsigned>(words[3] >> bits_behind_point);
  const bool is_beyond_half = (words[3] >> (bits_behind_point - 1) & 1) != 0;
  words[3] &= (std::uint64_t{1} << bits_behind_point) - 1;
  if (is_beyond_half) {
    // 1 minus the fraction is its complement and the last bit, which is beneath the precision.
    ++quadrant;
    for (std::uint64_t& word : words) word = ~word;
    words[3] &= (std::uint64_t{1} << bits_behind_point) - 1;
  }
  DoubleDouble fraction;
  double unit = 0x1p-30;  // of the upper half of a word
  for (std::size_t i = words.size(); i-- > 0; unit *= 0x1p-64) {
    const DoubleDouble upper(static_cast<double>(words[i] >> 32) * unit);
    const DoubleDouble lower(static_cast<double>(words[i] & 0xffffffffu) * (unit * 0x1p-32));
    fraction = fraction + (upper + lower);
  }
  const DoubleDouble rest = fraction * DoubleDouble(half_pi, half_pi_rest);
  return {is_beyond_half ? -rest : rest, quadrant & 3u};
}

/// Reduces any finite x >= 2^25 by Payne's and Hanek's method: only 256 bits of 2 / pi, from where
/// multiples of whole turns end, are multiplied.
Reduced reduced_by_bits(double x) {
  __extension__ using Wide = unsigned __int128;
  constexpr int word_bits = 64;
  constexpr int bias = 1075;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const int exponent = static_cast<int>(bits >> fraction_bits) - bias;
  const std::uint64_t mantissa =
      (bits & ((std::uint64_t{1} << fraction_bits) - 1)) | (std::uint64_t{1} << fraction_bits);
  // Bit i behind the point counts 2^(exponent - i) mantissas: below i = exponent - 1 whole turns.
  const int first = word_bits + exponent - 2;
  const int shift = first % word_bits;
  const auto place = static_cast<std::size_t>(first / word_bits);
  std::array<std::uint64_t, 4> product{};
  Wide carry = 0;
  for (std::size_t i = 0; i < product.size(); ++i) {
    const std::size_t at = place + product.size() - 1 - i;
    const std::uint64_t upper = two_over_pi[at] << shift;
    const std::uint64_t lower = shift == 0 ? 0 : two_over_pi[at + 1] >> (word_bits - shift);
    carry += static_cast<Wide>(upper | lower) * mantissa;
    product[i] = static_cast<std::uint64_t>(carry);
    carry >>= word_bits;
  }
  return quarters(product);
}

/// Reduces any finite x >= 0.
Reduced reduced(double x) {
  constexpr double max_of_doubles = 0x1p25;
  if (x >= max_of_doubles) return reduced_by_bits(x);
  const double count = nearest(x * (2 / std::numbers::pi));
  // This is exact: both are multiples of one power of two, and what is left is small.
  const double rough = std::fma(-count, half_pi, x);
  const DoubleDouble more = two_product(count, half_pi_rest);
  const DoubleDouble rest = two_sum(rough, -more.hi);
  const double last = std::fma(-count, half_pi_last, rest.lo - more.lo);
  return {quick_two_sum(rest.hi, last), static_cast<unsigned>(count) & 3u};
}

struct SineAndCosine {
  DoubleDouble sine;
  DoubleDouble cosine;
};

/// Returns sine and cosine of a reduced angle.
SineAndCosine of_rest(DoubleDouble angle) {
  const bool is_negative = angle.hi < 0;
  if (is_negative) angle = -angle;
  const double step = nearest(angle.hi * steps_of_one);
  const WaveStep& at = wave_steps[static_cast<std::size_t>(step)];
  const DoubleDouble d = two_sum(angle.hi - step / steps_of_one, angle.lo);

  constexpr std::array<double, 4> of_sine = {-1.0 / 6, 1.0 / 120, -1.0 / 5040, 1.0 / 362880};
  constexpr std::array<double, 3> of_cosine = {1.0 / 24, -1.0 / 720, 1.0 / 40320};
  const DoubleDouble square = two_product(d.hi, d.hi);
  const double cubic =
      std::fma(-0.5 * square.hi, d.lo, square.hi * d.hi * polynomial(of_sine, square.hi));
  const DoubleDouble sine = quick_two_sum(d.hi, d.lo + cubic);
  const double beyond_square = std::fma(-d.hi, d.lo, -0.5 * square.lo) +
                               square.hi * square.hi * polynomial(of_cosine, square.hi);
  const DoubleDouble cosine_less_one = quick_two_sum(-0.5 * square.hi, beyond_square);

  SineAndCosine result;
  if (step == 0) {
    result = {sine, DoubleDouble(1) + cosine_less_one};
  } else {
    result.sine = at.sine + (at.cosine * sine + at.sine * cosine_less_one);
    result.cosine = at.cosine + (at.cosine * cosine_less_one - at.sine * sine);
  }
  if (is_negative) result.sine = -result.sine;
  return result;
}

/// Returns the sine of a reduced angle that is turned by some quarters more.
double sine_of(const Reduced& angle, unsigned quarters_more) {
  const SineAndCosine both = of_rest(angle.rest);
  const unsigned quadrant = (angle.quadrant + quarters_more) & 3u;
  const double size = (quadrant & 1u) == 0 ? both.sine.value() : both.cosine.value();
  return quadrant >= 2 ? -size : size;
}

// ---- angles -----------------------------------------------------------------------------------

/// Returns the angle of (x, y), for x >= y >= 0 and x > 0, which are neither huge nor tiny.
DoubleDouble angle_to_eighth(const DoubleDouble& y, const DoubleDouble& x) {
  const double step = nearest(y.hi / x.hi * steps_of_one);
  DoubleDouble t;
  if (step == 0) {
    t = y / x;
  } else {
    const DoubleDouble tangent(step / steps_of_one);
    t = (y - tangent * x) / (x + tangent * y);
  }
  constexpr std::array<double, 5> coefficients = {-1.0 / 3, 1.0 / 5, -1.0 / 7, 1.0 / 9, -1.0 / 11};
  const double square = t.hi * t.hi;
  const double beyond = std::fma(-square, t.lo, square * t.hi * polynomial(coefficients, square));
  const DoubleDouble angle = quick_two_sum(t.hi, t.lo + beyond);
  return step == 0 ? angle : angles_of_tangents[static_cast<std::size_t>(step)] + angle;
}

/// Returns the angle of (x, y) from the x axis, for y >= 0.
DoubleDouble angle_of(const DoubleDouble& y, const DoubleDouble& x) {
  const DoubleDouble right(half_pi, half_pi_rest);
  const DoubleDouble size = x.hi < 0 ? -x : x;
  const bool is_steep = y.hi > size.hi || (y.hi == size.hi && y.lo > size.lo);
  const DoubleDouble flat = is_steep ? angle_to_eighth(size, y) : angle_to_eighth(y, size);
  if (x.hi < 0) return is_steep ? right + flat : DoubleDouble(2 * half_pi, 2 * half_pi_rest) - flat;
  return is_steep ? right - flat : flat;
}

/// Returns the square root of 1 - x^2, for |x| <= 1.
DoubleDouble other_side(double x) {
  return sqrt(DoubleDouble(1) - two_product(x, x));
}

// ---- exponentials and logarithms ----------------------------------------------------------------

/// Returns e to the power of x, for x that is no NaN.
double exponential(const DoubleDouble& x) {
  constexpr double surely_infinite = 710;
  constexpr double surely_nothing = -746;
  if (x.hi > surely_infinite) return infinity;
  if (x.hi < surely_nothing) return 0;
  const double count = nearest(x.hi * (steps_of_one / std::numbers::ln2));
  // The fma is exact, as that of reduced() is.
  const DoubleDouble rest =
      two_sum(std::fma(-count, ln_step.hi, x.hi), std::fma(-count, ln_step.lo, x.lo));
  constexpr std::array<double, 6> coefficients = {1.0 / 2,   1.0 / 6,   1.0 / 24,
                                                  1.0 / 120, 1.0 / 720, 1.0 / 5040};
  const double beyond =
      std::fma(rest.hi, rest.lo, rest.hi * rest.hi * polynomial(coefficients, rest.hi));
  const DoubleDouble less_one = quick_two_sum(rest.hi, rest.lo + beyond);
  const int steps = static_cast<int>(count);
  const int exponent = steps >> 6;
  const DoubleDouble& power = powers_of_two[static_cast<std::size_t>(steps & 63)];
  return scaled(power + power * less_one, exponent);
}

/// Returns the natural logarithm of x, which is finite and above 0.
DoubleDouble logarithm(DoubleDouble x) {
  constexpr double smallest_normal = 0x1p-1022;
  constexpr std::int64_t bits_of_root = 0x3fe6a09e667f3bcd;  // of 1/2
  double exponent = 0;
  if (x.hi < smallest_normal) {
    x = DoubleDouble(x.hi * 0x1p54);
    exponent = -54;
  }
  const auto bits = std::bit_cast<std::int64_t>(x.hi);
  const std::int64_t power = (bits - bits_of_root) >> fraction_bits;
  const auto scale = [](double part, std::int64_t by) {
    // Two steps, as 2^-power may be no normal number.
    const int half = static_cast<int>(by / 2);
    return part * power_of_two(-half) * power_of_two(half - static_cast<int>(by));
  };
  exponent += static_cast<double>(power);
  const DoubleDouble m(scale(x.hi, power), scale(x.lo, power));

  constexpr double steps = 128;
  constexpr std::size_t first = 90;
  const auto& step = logarithm_steps[static_cast<std::size_t>(nearest(m.hi * steps)) - first];
  const DoubleDouble product = two_product(m.hi, step.inverse);
  const DoubleDouble z = quick_two_sum(product.hi - 1, std::fma(m.lo, step.inverse, product.lo));

  // This is the series z - z^2/2 + z^3/3 - ...
  constexpr std::array<double, 9> coefficients = {1.0 / 5,   -1.0 / 6, 1.0 / 7,   -1.0 / 8, 1.0 / 9,
                                                  -1.0 / 10, 1.0 / 11, -1.0 / 12, 1.0 / 13};
  constexpr DoubleDouble third(0x1.5555555555555p-2, 0x1.5555555555555p-56);
  const DoubleDouble from_4th = quick_two_sum(0.25, -z.hi * polynomial(coefficients, z.hi));
  const DoubleDouble from_3rd = third - z * from_4th;
  const DoubleDouble from_2nd = DoubleDouble(0.5) - z * from_3rd;
  const DoubleDouble series = z - z * z * from_2nd;
  const DoubleDouble of_power = DoubleDouble(exponent) * ln_2;
  return (of_power + step.logarithm) + series;
}

/// Says whether x is a whole number, and whether that is odd.
bool is_whole(double x) {
  return std::floor(x) == x;
}
bool is_odd(double x) {
  return is_whole(x) && !is_whole(0.5 * x);
}

/// Returns base to the power of exponent, which is no NaN and not 0, where base is 0 or infinite,
/// or exponent is infinite. The sign is that of a positive base.
double limit_of_power(double base, double exponent) {
  const double size = std::abs(base);
  if (size == 1) return 1;
  return (size > 1) == (exponent > 0) ? infinity : 0;
}

}  // namespace

double sin(double x) {
  const double size = std::abs(x);
  if (!(size < infinity)) return nan;
  if (size < own_value) return x;
  const double sine = sine_of(reduced(size), 0);
  return x < 0 ? -sine : sine;
}

double cos(double x) {
  const double size = std::abs(x);
  if (!(size < infinity)) return nan;
  return sine_of(reduced(size), 1);
}

double tan(double x) {
  const double size = std::abs(x);
  if (!(size < infinity)) return nan;
  if (size < own_value) return x;
  const Reduced angle = reduced(size);
  const SineAndCosine both = of_rest(angle.rest);
  const bool is_turned = (angle.quadrant & 1u) != 0;
  const double tangent =
      is_turned ? -(both.cosine / both.sine).value() : (both.sine / both.cosine).value();
  return x < 0 ? -tangent : tangent;
}

double asin(double x) {
  const double size = std::abs(x);
  if (!(size <= 1)) return nan;
  if (size < own_value) return x;
  return std::copysign(angle_of(size, other_side(size)).value(), x);
}

double acos(double x) {
  if (!(std::abs(x) <= 1)) return nan;
  // pi / 2 and its rounding are far more than x has below this.
  constexpr double negligible = 0x1p-200;
  if (std::abs(x) < negligible) return half_pi;
  return angle_of(other_side(x), x).value();
}

double atan(double x) {
  if (std::abs(x) < own_value) return x;
  return atan2(x, 1);
}

double atan2(double y, double x) {
  if (!(x == x && y == y)) return nan;
  double height = std::abs(y);
  double width = std::abs(x);
  const bool is_behind = std::signbit(x);
  double angle = 0;
  if (height == infinity && width == infinity) {
    angle = is_behind ? 1.5 * half_pi : 0.5 * half_pi;
  } else if (height == 0 || width == infinity) {
    angle = is_behind ? 2 * half_pi : 0;
  } else if (width == 0 || height == infinity) {
    angle = half_pi;
  } else {
    constexpr int far_apart = 120;
    const int exponent = std::ilogb(width);
    const int apart = std::ilogb(height) - exponent;
    if (apart > far_apart) {
      angle = half_pi;
    } else if (apart < -far_apart) {
      angle = is_behind ? 2 * half_pi : height / width;
    } else {
      height = std::scalbn(height, -exponent);
      width = std::scalbn(width, -exponent);
      angle = angle_of(height, is_behind ? -width : width).value();
    }
  }
  return std::copysign(angle, y);
}

double exp(double x) {
  return x == x ? exponential(x) : nan;
}

double log(double x) {
  if (!(x >= 0)) return nan;
  if (x == 0) return -infinity;
  return x < infinity ? logarithm(x).value() : infinity;
}

double log1p(double x) {
  if (!(x >= -1)) return nan;
  if (x == -1) return -infinity;
  constexpr double surely_itself = 0x1p-54;
  if (std::abs(x) < surely_itself) return x;
  return x < infinity ? logarithm(two_sum(1, x)).value() : infinity;
}

double log10(double x) {
  if (!(x > 0 && x < infinity)) return log(x);
  return (logarithm(x) * per_ln_10).value();
}

double pow(double base, double exponent) {
  if (exponent == 0 || base == 1) return 1;
  if (!(base == base && exponent == exponent)) return nan;
  if (exponent == 1) return base;
  if (exponent == 2) return base * base;
  const bool is_negative = std::signbit(base) && is_odd(exponent);
  const double size = std::abs(base);
  double result = 0;
  if (size == 0 || size == infinity || std::abs(exponent) == infinity) {
    result = limit_of_power(size, exponent);
  } else {
    if (base < 0 && !is_whole(exponent)) return nan;
    constexpr double surely_beyond = 0x1p70;  // with the least logarithm that is not 0
    const double within = std::min(std::max(exponent, -surely_beyond), surely_beyond);
    result = size == 1 ? 1 : exponential(DoubleDouble(within) * logarithm(size));
  }
  return is_negative ? -result : result;
}

double hypot(double x, double y) {
  return hypot(x, y, 0);
}

double hypot(double x, double y, double z) {
  const double largest = std::max(std::max(std::abs(x), std::abs(y)), std::abs(z));
  if (std::abs(x) == infinity || std::abs(y) == infinity || std::abs(z) == infinity)
    return infinity;
  if (!(x == x && y == y && z == z)) return nan;
  if (largest == 0) return 0;
  const int exponent = std::ilogb(largest) + 1;
  DoubleDouble sum;
  for (const double side : {x, y, z}) {
    const double small = std::scalbn(side, -exponent);
    sum = sum + two_product(small, small);
  }
  return scaled(sqrt(sum), exponent);
}

}  // namespace crt::elementary
