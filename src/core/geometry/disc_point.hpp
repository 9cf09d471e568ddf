// A point of the unit disc is made of two numbers in [0, 1).
//
// Source: Shirley, Chiu, A low distortion map between disk and square, 1997. Neighbours stay
// neighbours, so stratified numbers give stratified points. Areas are kept.
#pragma once

#include "core/geometry/angles.hpp"
#include "core/math/plane_point.hpp"

namespace crt::core {

/// Returns a point for two numbers, or as many side by side.
template <class Real>
PlanePointOf<Real> point_of_disc(const Real& u, const Real& v) {
  const Real x = 2.0 * u - 1.0;
  const Real y = 2.0 * v - 1.0;
  const auto beside = abs(x) > abs(y);
  const Real radius = select(beside, x, y);
  const Real across = select(beside, y, x);
  const auto [sine, cosine] =
      of_eighth_turns(across / select(radius == 0.0, broadcast<Real>(1), radius));
  return {radius * select(beside, cosine, sine), radius * select(beside, sine, cosine)};
}

}  // namespace crt::core
