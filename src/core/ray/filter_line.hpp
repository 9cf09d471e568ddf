// Lines as the cheap tests take them, and what these say.
#pragma once

#include <array>

#include "core/math/lanes.hpp"
#include "core/ray/plain_ray.hpp"
#include "crt/vec.hpp"

namespace crt::core {

/// One line, or as many side by side as a Real has lanes.
template <class Real>
struct FilterLine {
  std::array<Real, 3> origin;
  std::array<Real, 3> direction;  ///< of length about 1
  Real squared_length;
  Real inverse_squared_length;
  Real inverse_length;
  std::array<Real, 3> inverse;  ///< 1 / direction
  Real begin;                   ///< crossings before it do not count
  Real start_error;             ///< as StartPoint::t_error
  Real certain_from;            ///< crossings behind it and before certain_to count
  Real certain_to;              ///< finite
};

template <class Real>
PlainRay<Real> plain_ray(const FilterLine<Real>& line) {
  const auto& o = line.origin;
  const auto& d = line.direction;
  return {.origin = {o[0], o[1], o[2]}, .direction = {d[0], d[1], d[2]}};
}

template <class Mask>
struct Decision {
  Mask rejected;  ///< no crossing counts
  Mask accepted;  ///< one surely does
};

namespace filter_detail {

/// Relative, 128 roundings: what the sums below can be off by, and what the exact test may decide
/// otherwise, with margin to spare.
inline constexpr double slack = 0x1p-46;

}  // namespace filter_detail

}  // namespace crt::core
