// How near to each other crossings are that may be at one place.
#pragma once

#include "core/ray/plain_ray.hpp"
#include "core/ray/world_ray.hpp"

namespace crt::core {

/// How far along the ray from a hit other crossings may be and yet be at its place, or at the start
/// of a ray that goes on from it, whose origin is rounded. Wide, as the next ray may meet at right
/// angles what this one grazes: it only decides where to look. Of one ray, or of as many as a Real
/// has lanes.
template <class Real>
Real coincidence_tolerance(const PlainRay<Real>& ray, const Real& t, const Real& error) {
  constexpr double error_factor = 4;
  constexpr double relative_width = 0x1p-40;
  const Real farthest =
      fma(abs(t), largest_component(ray.direction), largest_component(ray.origin));
  return error_factor * error + relative_width * farthest;
}
inline double coincidence_tolerance(const WorldRay& ray, double t, double error) {
  return coincidence_tolerance(PlainRay<double>{ray.origin, ray.direction}, t, error);
}

}  // namespace crt::core
