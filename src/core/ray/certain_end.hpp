// Crossings before certain_end() are surely not at the end of a ray.
#pragma once

#include "core/ray/plain_ray.hpp"
#include "core/ray/world_ray.hpp"

namespace crt::core {

/// Returns the t before which no crossing can be of a surface through the ray's end. It does so for
/// one ray, or for as many as a Real has lanes.
template <class Real>
Real certain_end(const PlainRay<Real>& ray, const Real& t_max, const Real& end_error) {
  const auto ends_on_surface = end_error > 0.0;
  if (!any(ends_on_surface)) return t_max;
  // The crossing of a surface through the end may be so far before it. The flatter the ray meets
  // the surface, the farther it may be.
  constexpr double relative_width = 0x1p-26;
  const Real width =
      relative_width * fma(t_max, largest_component(ray.direction), largest_component(ray.origin));
  return select(ends_on_surface, t_max - width, t_max);
}

inline double certain_end(const WorldRay& ray) {
  return certain_end(PlainRay<double>{ray.origin, ray.direction}, ray.t_max, ray.end_error);
}

/// Clamps an end to 2^900, as conservative tests take only finite ends.
template <class Real>
Real finite_end(const Real& end) {
  constexpr double largest = 0x1p900;
  return select(end > largest, broadcast<Real>(largest), end);
}

}  // namespace crt::core
