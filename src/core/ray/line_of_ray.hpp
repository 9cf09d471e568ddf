// A ray is brought into the form that conservative tests take. Crossings before certain_end() are
// surely not at its end.
#pragma once

#include "core/ray/filter_line.hpp"
#include "core/ray/world_ray.hpp"

namespace crt::core {

/// Returns the t before which no crossing can be of a surface through the ray's end. It does so for
/// one ray, or for as many as a Real has lanes.
template <class Real>
[[gnu::always_inline]] inline Real certain_end(const Real& t_max, const Real& end_error,
                                               double size_error) {
  // The crossing of a surface through the end may be so far before it, in units of the errors. The
  // flatter the ray meets the surface, the farther it may be.
  constexpr double flattest_end = 0x1p23;
  return select(end_error > 0.0, t_max - flattest_end * (end_error + size_error), t_max);
}

/// For a ray that ends on a known surface nothing is certain, as that may be anywhere along it.
inline double certain_end(const WorldRay& ray) {
  const double end_error = ray.end_point.is_known() ? infinity : ray.end_error;
  return certain_end(ray.t_max, end_error, ray.max_size_error);
}

/// Clamps an end to 2^900, as conservative tests take only finite ends.
template <class Real>
Real finite_end(const Real& end) {
  constexpr double largest = 0x1p900;
  return select(end > largest, broadcast<Real>(largest), end);
}

/// Sets a line to a ray from `begin` to `end`, whose start and end have those rounding errors and
/// that WorldRay::max_size_error. It does so for one ray, or for as many as a Real has lanes.
template <class Real>
void set_line(const PlainRay<Real>& ray, const Real& begin, const Real& start_error,
              const Real& end, const Real& end_error, double size_error, FilterLine<Real>& line) {
  const auto& [origin, direction] = ray;
  line.origin = {origin.x, origin.y, origin.z};
  line.direction = {direction.x, direction.y, direction.z};
  line.squared_length = dot(line.direction, line.direction);
  line.inverse_squared_length = 1.0 / line.squared_length;
  line.inverse_length = sqrt(line.inverse_squared_length);
  for (std::size_t axis = 0; axis < 3; ++axis) line.inverse[axis] = 1.0 / line.direction[axis];
  line.begin = begin;
  line.start_error = start_error + size_error;
  line.certain_from = tolerated_start(begin, line.start_error);
  line.certain_to = finite_end(certain_end(end, end_error, size_error));
}

inline FilterLine<double> line_of(const WorldRay& ray) {
  FilterLine<double> line;
  const double end_error = ray.end_point.is_known() ? infinity : ray.end_error;
  set_line(plain_ray(ray), ray.t_min, ray.start.t_error, ray.t_max, end_error, ray.max_size_error,
           line);
  return line;
}

}  // namespace crt::core
