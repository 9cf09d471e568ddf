// Up to where the crossings along a ray are surely not at its end.
#pragma once

#include "core/ray/plain_ray.hpp"
#include "core/ray/world_ray.hpp"

namespace crt::core {

/// Crossings before that are surely not of a surface through the ray's end. Of one ray, or of as
/// many as a Real has lanes.
template <class Real>
Real certain_end(const PlainRay<Real>& ray, const Real& t_max, const Real& end_error) {
  const auto ends_on_surface = end_error > 0.0;
  if (!any(ends_on_surface)) return t_max;
  // How far before the end the crossing of a surface through it may be; the flatter the ray, the
  // farther.
  constexpr double relative_width = 0x1p-26;
  const Real width =
      relative_width * fma(t_max, largest_component(ray.direction), largest_component(ray.origin));
  return select(ends_on_surface, t_max - width, t_max);
}

inline double certain_end(const WorldRay& ray) {
  return certain_end(PlainRay<double>{ray.origin, ray.direction}, ray.t_max, ray.end_error);
}

/// Cheap tests take only finite ends.
template <class Real>
Real finite_end(const Real& end) {
  constexpr double largest = 0x1p900;
  return select(end > largest, broadcast<Real>(largest), end);
}

}  // namespace crt::core
