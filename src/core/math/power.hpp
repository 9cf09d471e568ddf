// Powers and exponentials of one double or of lanes have the same bits with every libm.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "core/math/lanes.hpp"
#include "core/math/polynomial.hpp"

namespace crt::core {

namespace power_detail {

inline constexpr int fraction_bits = 52;
inline constexpr std::uint64_t bits_of_one = 0x3ff0000000000000;
/// Adding this puts a whole number that is not too large into the lowest bits of the sum.
inline constexpr double whole = 0x1.8p52;

/// Returns 2^exponent for a whole number for which that is a normal number.
template <class Real>
Real power_of_two(const Real& exponent) {
  const auto biased = bits_as<BitsOf<Real>>(Real(exponent + (whole + 1023)));
  return bits_as<Real>(BitsOf<Real>(biased << fraction_bits));
}

// This is the series of ln m = 2 artanh(s) in base 2, whose coefficients are 2 / ((2 n + 1) ln 2).
inline constexpr std::array<double, 11> logarithm_series = {
    0x1.71547652b82fep+1, 0x1.ec709dc3a03fdp-1, 0x1.2776c50ef9bfep-1, 0x1.a61762a7aded9p-2,
    0x1.484b13d7c02a9p-2, 0x1.0c9a84994022dp-2, 0x1.c68f568d31760p-3, 0x1.89f3b1694cffep-3,
    0x1.5b9ac9b743f0dp-3, 0x1.3703c1f4d0ffep-3, 0x1.1964ec6fc9491p-3};

// This is the series of 2^x without its 1, whose coefficients are (ln 2)^n / n!.
inline constexpr std::array<double, 13> exponential_series = {
    0x1.62e42fefa39efp-1,  0x1.ebfbdff82c58fp-3,  0x1.c6b08d704a0c0p-5,  0x1.3b2ab6fba4e77p-7,
    0x1.5d87fe78a6731p-10, 0x1.430912f86c787p-13, 0x1.ffcbfc588b0c7p-17, 0x1.62c0223a5c824p-20,
    0x1.b5253d395e7c4p-24, 0x1.e4cf5158b8ecap-28, 0x1.e8cac7351bb25p-32, 0x1.c3bd650fc2986p-36,
    0x1.816193166d0f9p-40};

/// Returns the first terms of a series.
template <std::size_t terms, std::size_t count>
constexpr std::array<double, terms> first(const std::array<double, count>& series) {
  std::array<double, terms> result{};
  std::copy_n(series.begin(), terms, result.begin());
  return result;
}

/// Computes logarithm2() with the given number of terms.
template <std::size_t terms, class Real>
Real logarithm2_by(const Real& x) {
  using Bits = BitsOf<Real>;
  // Here x is m 2^k with m from sqrt(1/2) to sqrt(2).
  constexpr std::uint64_t bits_of_root = 0x3fe6a09e667f3bcd;
  constexpr std::uint64_t exponent_bits = 0x7ff0000000000000;
  const auto bits = bits_as<Bits>(x);
  const Bits exponent = (bits + (bits_of_one - bits_of_root)) & exponent_bits;
  const Real m = bits_as<Real>(bits - (exponent - bits_of_one));
  // The exponent becomes the lowest bits of a number that has no others below 2^52.
  constexpr std::uint64_t bits_of_2_52 = 0x4330000000000000;
  const Real k = bits_as<Real>(Bits((exponent >> fraction_bits) | bits_of_2_52)) - (0x1p52 + 1023);

  constexpr std::array<double, terms> coefficients = first<terms>(logarithm_series);
  const Real s = (m - 1.0) / (m + 1.0);
  return fma(s, polynomial(coefficients, Real(s * s)), k);
}

}  // namespace power_detail

/// Returns the logarithm to base 2 of x, which is a normal number above 0, or infinity, which
/// counts as 2^1024. The relative error is at most 2^-51.
template <class Real>
Real logarithm2(const Real& x) {
  return power_detail::logarithm2_by<power_detail::logarithm_series.size()>(x);
}

/// Returns 2^e. The relative error is at most 2^-52 where the result is a normal number. The result
/// is infinite from 2^1024 on, and 0 below 2^-1075.
template <class Real>
Real exponential2(const Real& e) {
  using namespace power_detail;
  constexpr double largest = 1100;
  const Real within = clamp(e, broadcast<Real>(-largest), broadcast<Real>(largest));
  const Real nearest = floor(within + 0.5);
  const Real rest = within - nearest;
  // The factor is applied in two steps, as 2^nearest alone may be no normal number.
  const Real half = floor(0.5 * nearest);
  const Real sum = fma(rest, polynomial(exponential_series, rest), broadcast<Real>(1));
  return sum * power_of_two(half) * power_of_two(nearest - half);
}

/// Returns base to the power of exponent. Both are >= 0, and base is a normal number, 0, or
/// infinity. The relative error is at most (2 + 4 |log2 of the result|) 2^-52 where the result is a
/// normal number. 0 to the power of 0 is 1, and NaN stays what it is.
template <class Real>
Real power(const Real& base, const Real& exponent) {
  constexpr double smallest = 0x1p-1022;
  const Real result =
      exponential2<Real>(exponent * logarithm2<Real>(max(base, broadcast<Real>(smallest))));
  const Real of_nothing = select(exponent > 0.0, base, broadcast<Real>(1));
  return select(base > 0.0, result, of_nothing);
}

/// Returns roughly base to the power of exponent, for base from 0 to 1 and exponent from 0.1 to 10.
/// The error is at most 10^-9.
template <class Real>
Real rough_power(const Real& base, const Real& exponent) {
  using namespace power_detail;
  // The shorter series leave out 2 10^-11 of the logarithm and a share of 3 10^-10 of the
  // exponential.
  constexpr std::size_t logarithm_terms = 6;
  constexpr std::array<double, 8> coefficients = first<8>(exponential_series);
  constexpr double smallest = 0x1p-1000;
  const Real logarithm = logarithm2_by<logarithm_terms, Real>(max(base, broadcast<Real>(smallest)));
  const Real e = max(Real(exponent * logarithm), broadcast<Real>(-1000));
  const Real nearest = floor(e + 0.5);
  const Real rest = e - nearest;
  return fma(rest, polynomial(coefficients, rest), broadcast<Real>(1)) * power_of_two(nearest);
}

/// Returns the cube root of x >= 0, which is a normal number, 0, or infinity. The relative error is
/// at most 2^-52. The root of NaN is NaN.
template <class Real>
Real cube_root(const Real& x) {
  const Real near = exponential2<Real>(logarithm2<Real>(x) / 3.0);
  // This is a step of Newton's method.
  const Real square = near * near;
  const Real root = near - fma(square, near, -x) / (3.0 * square);
  return select(x > 0.0, root, x);
}

}  // namespace crt::core
