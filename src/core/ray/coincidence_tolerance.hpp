// Crossings that are nearer to each other than the coincidence tolerance may be at one place.
#pragma once

#include "core/ray/plain_ray.hpp"
#include "core/ray/world_ray.hpp"

namespace crt::core {

/// The place of a crossing reaches at most so far along the ray, relative to its primitive
/// (csg/one_place.hpp), but for an error that the shape states.
inline constexpr double max_reach = 0x1p-30;

/// Places that are so many roundings of their size and coordinates from each other, by two of them,
/// are one.
inline constexpr double roundings_of_place = 4;

/// Returns how far along the ray from a hit other crossings may be and yet be at its place. It only
/// decides where to look. It is computed for one ray, or for as many as a Real has lanes.
template <class Real>
[[gnu::always_inline]] inline Real coincidence_tolerance(const PlainRay<Real>& ray, const Real& t,
                                                         const Real& error,
                                                         double relative_width = 2 * max_reach) {
  constexpr double error_factor = 4;
  const Real farthest =
      fma(abs(t), largest_component(ray.direction), largest_component(ray.origin));
  return error_factor * error + relative_width * farthest;
}
inline double coincidence_tolerance(const WorldRay& ray, double t, double error) {
  return coincidence_tolerance(plain_ray(ray), t, error);
}

/// Returns how far from a hit crossings may be that are at the start of a secondary ray from there,
/// whose origin is rounded. That is wide, as the next ray may meet at right angles what this one
/// grazes.
inline double tolerance_at_start(const WorldRay& ray, double t, double error) {
  constexpr double relative_width = 0x1p-40;
  return coincidence_tolerance(plain_ray(ray), t, error, relative_width);
}

}  // namespace crt::core
