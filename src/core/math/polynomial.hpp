// Polynomials are evaluated for one double or for lanes.
#pragma once

#include <array>
#include <cstddef>

#include "core/math/lanes.hpp"

namespace crt::core {

/// Returns the value at x of a polynomial of at least three coefficients, that of x^0 first. Even
/// and odd powers have a sum each, so that the two chains of instructions run in parallel.
template <class Real, std::size_t count>
Real polynomial(const std::array<double, count>& coefficients, const Real& x) {
  static_assert(count > 2);
  const Real square = x * x;
  Real last = broadcast<Real>(coefficients[count - 1]);
  Real other = broadcast<Real>(coefficients[count - 2]);
  for (std::size_t i = count - 2; i >= 2; i -= 2) {
    last = fma(last, square, broadcast<Real>(coefficients[i - 1]));
    other = fma(other, square, broadcast<Real>(coefficients[i - 2]));
  }
  if constexpr (count % 2 == 0) return fma(last, x, other);
  last = fma(last, square, broadcast<Real>(coefficients[0]));
  return fma(other, x, last);
}

}  // namespace crt::core
