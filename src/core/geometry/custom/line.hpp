// A custom shape sees a ray as a line that begins near to it.
#pragma once

#include "core/geometry/bounds.hpp"
#include "core/geometry/near_line.hpp"
#include "crt/ray.hpp"

namespace crt::core {

inline Vec3 middle_of(const Bounds& bounds) {
  return bounds.lower + 0.5 * (bounds.upper - bounds.lower);
}

/// Returns the longest side of bounds.
inline double size_of(const Bounds& bounds) {
  return largest_component(bounds.upper - bounds.lower);
}

/// A CustomLine is a ray as a custom shape is asked along it. Places on it are s, in scene units:
/// the t of the ray that is handed over.
class CustomLine {
 public:
  CustomLine(const Bounds& bounds, const ObjectRay& ray);

  /// Returns what to ask about: the line within the bounds, with a margin for rounding.
  const Ray& ray() const { return ray_; }
  bool misses_bounds() const { return !(ray_.t_min <= ray_.t_max); }
  /// Returns a bound on what rounding does to a crossing of a ray that meets the surface head-on.
  double rounding() const { return rounding_; }

  DoubleDouble to_t(double s) const { return line_.to_precise_t(s / length_); }
  double to_t_length(double s) const { return line_.to_t_length(s / length_); }
  double to_length(double t) const { return t / line_.to_t_length(1 / length_); }

 private:
  NearLine line_;
  double length_;  ///< of 1 on that line
  double rounding_;
  Ray ray_;
};

}  // namespace crt::core
