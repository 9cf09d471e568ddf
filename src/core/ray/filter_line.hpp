// Conservative tests take lines in this form, and answer with a Decision.
#pragma once

#include <array>

#include "core/math/lanes.hpp"
#include "core/ray/plain_ray.hpp"
#include "crt/vec.hpp"

namespace crt::core {

/// A FilterLine is one line, or as many side by side as a Real has lanes.
template <class Real>
struct FilterLine {
  std::array<Real, 3> origin;
  std::array<Real, 3> direction;  ///< of length about 1
  Real squared_length;
  Real inverse_squared_length;
  Real inverse_length;
  std::array<Real, 3> inverse;  ///< 1 / direction
  Real begin;                   ///< crossings before it do not count
  Real start_error;             ///< StartPoint::t_error with WorldRay::max_size_error
  Real certain_from;            ///< crossings after it and before certain_to count
  Real certain_to;              ///< finite
};

template <class Real>
PlainRay<Real> plain_ray(const FilterLine<Real>& line) {
  const auto& o = line.origin;
  const auto& d = line.direction;
  return {.origin = {o[0], o[1], o[2]}, .direction = {d[0], d[1], d[2]}};
}

}  // namespace crt::core
