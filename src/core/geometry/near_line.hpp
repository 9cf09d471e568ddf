// A ray as a round primitive solves for it: shifted to the primitive, in the primitive's own units.
//
// The line is (point + x direction) * unit, relative to the primitive's centre, where unit is a power
// of two near the primitive's size and direction is the ray's times a power of two: both scalings
// are exact, and neither the scene's size nor the length of the ray's direction matters after them.
#pragma once

#include <cmath>

#include "core/geometry/object_ray.hpp"
#include "core/math/vector.hpp"

namespace crt::core {

struct NearLine {
  Vec3 point;
  Vec3 direction;            ///< its largest component is in [1, 2)
  double squared_speed = 0;  ///< direction . direction

  /// The line with `point` where the ray is at t = 0.
  static NearLine at_origin(const ObjectRay& ray, const Vec3& center, double unit) {
    NearLine line(ray, unit);
    line.move_to(ray, center, 0);
    return line;
  }

  /// The line with `point` (nearly) where the ray comes closest to the centre.
  static NearLine at_closest(const ObjectRay& ray, const Vec3& center, double unit) {
    NearLine line = at_origin(ray, center, unit);
    line.move_to(ray, center, line.to_t(line.closest()));
    // One step leaves an error of one rounding of the way. From beyond 1 / u sizes that is still
    // far: a second step, which t alone could not hold, brings it near.
    constexpr double near = 4;
    const double rest = line.closest();
    if (std::abs(rest) > near) {
      line.shift_low_ = rest * line.unit_ * line.direction_scale_;
      line.point = ray.from_center(center, line.shift_, line.shift_low_) * line.inverse_unit_;
    }
    return line;
  }

  /// Moves `point` to where the ray is at t.
  void move_to(const ObjectRay& ray, const Vec3& center, const DoubleDouble& t) {
    shift_ = t.hi;
    shift_low_ = t.lo;
    point = ray.from_center(center, t.hi, t.lo) * inverse_unit_;
  }

  /// The ray's t at x.
  double to_t(double x) const { return shift_ + (shift_low_ + to_t_length(x)); }

  /// The same before its last rounding.
  DoubleDouble to_precise_t(double x) const { return two_sum(shift_, shift_low_ + to_t_length(x)); }

  /// A difference of x as a difference of t.
  double to_t_length(double x) const { return x * unit_ * direction_scale_; }

  Vec3 at(double x) const { return point + x * direction; }

  /// x of the point closest to the centre.
  double closest() const { return -glm::dot(point, direction) / squared_speed; }

 private:
  NearLine(const ObjectRay& ray, double unit) : unit_(unit), inverse_unit_(1 / unit) {
    direction_scale_ = 1 / power_of_two_below(largest_component(ray.direction));
    direction = ray.direction * direction_scale_;
    squared_speed = glm::dot(direction, direction);
  }

  double unit_;
  double inverse_unit_;
  double direction_scale_ = 1;
  double shift_ = 0;
  double shift_low_ = 0;
};

/// The standard tier's bound on the error of t at a crossing (docs/numerics.md), in units of t:
/// half an ulp of t and 8u (R + |x|) / |n . d|. All but t in the units of the line: `reach` is R + |x|,
/// `approach` is |n . d|, and `longest` what the error of x can be at most where the ray grazes.
inline double standard_error(const NearLine& line, double t, double reach, double approach, double longest) {
  constexpr double roundings = 8;
  const double across = roundings * unit_roundoff * reach;
  const double along = across < longest * approach ? across / approach : longest;
  return rounding_of(t) + line.to_t_length(along);
}

/// How far apart two roots next to a grazing ray can be moved by the rounding that standard_error
/// allows, on a surface of the given radius of curvature.
inline double grazing_error(const NearLine& line, double reach, double radius) {
  constexpr double roundings = 8;
  return std::sqrt(2 * roundings * unit_roundoff * reach * radius / line.squared_speed);
}

/// What the other root of a x^2 + 2 b x + c is moved by when c, which is only the rounding of a start
/// on the surface, is taken as 0.
inline double start_error(double c, double a, double b) {
  const double size = std::abs(c);
  const double grazing = std::sqrt(size / std::abs(a));
  return size < 2 * std::abs(b) * grazing ? size / (2 * std::abs(b)) : grazing;
}

}  // namespace crt::core
