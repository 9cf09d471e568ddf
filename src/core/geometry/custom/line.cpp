#include "core/geometry/custom/line.hpp"

#include <cmath>

#include "core/geometry/ray_slabs.hpp"

namespace crt::core {

namespace {

NearLine line_near(const Bounds& bounds, const ObjectRay& ray) {
  const double unit = power_of_two_below(size_of(bounds));
  // A start is near as it is, and stays where it is.
  if (ray.start.face != invalid_index) return NearLine::at_origin(ray, middle_of(bounds), unit);
  return NearLine::at_closest(ray, middle_of(bounds), unit);
}

}  // namespace

CustomLine::CustomLine(const Bounds& bounds, const ObjectRay& ray)
    : line_(line_near(bounds, ray)),
      length_(std::sqrt(line_.squared_length) * power_of_two_below(size_of(bounds))) {
  // The origin and the direction are rounded, each component by half an ulp.
  constexpr double roundings = 8;
  const double reach = bounds.farthest() + size_of(bounds);
  rounding_ = roundings * unit_roundoff * reach;
  const DoubleDouble shift = line_.to_precise_t(0);
  ray_.origin = ray.from_center(Vec3(0), shift.hi, shift.lo);
  ray_.direction = line_.direction / std::sqrt(line_.squared_length);
  const LineSpan span = RaySlabs(ray_.origin, ray_.direction, rounding_).span(bounds);
  ray_.t_min = span.enter;
  ray_.t_max = span.leave;
  if (ray.start.face != invalid_index) {
    // The start is within the bounds, whatever rounding says.
    ray_.t_min = std::min(ray_.t_min, -rounding_);
    ray_.t_max = std::max(ray_.t_max, rounding_);
  }
}

}  // namespace crt::core
