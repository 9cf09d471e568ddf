// A NearLine is a ray as a round primitive solves for it: shifted to the primitive, in the
// primitive's own units.
//
// The line is (point + x direction) * unit, relative to the primitive's centre. There unit is a
// power of two near the primitive's size, and direction is the ray's times a power of two. Both
// scalings are exact, and neither the scene's size nor the length of the ray's direction matters
// after them.
#pragma once

#include <cmath>

#include "core/math/lanes.hpp"
#include "core/math/vector.hpp"
#include "core/ray/object_ray.hpp"

namespace crt::core {

/// A NearLineOf is one line, or as many side by side as a Real has lanes. A Ray has the members of
/// ObjectRay, for such a Real.
template <class Real>
struct NearLineOf {
  Vec3Of<Real> point;
  Vec3Of<Real> direction;  ///< its largest component is in [1, 2)
  Real squared_length;     ///< direction . direction

  /// Makes the line with `point` where the ray is at t = 0. Center and unit may differ by lane.
  template <class Ray, class Center, class Unit>
  static NearLineOf at_origin(const Ray& ray, const Center& center, const Unit& unit) {
    NearLineOf line(ray, unit);
    line.move_to(ray, center, Real{});
    return line;
  }

  /// Makes the line with `point` (nearly) where the ray comes closest to the centre.
  template <class Ray, class Center, class Unit>
  static NearLineOf at_closest(const Ray& ray, const Center& center, const Unit& unit) {
    Real rest;
    return at_closest(ray, center, unit, rest);
  }
  /// Makes the line at its closest, and also returns its closest() in `rest`.
  template <class Ray, class Center, class Unit>
  static NearLineOf at_closest(const Ray& ray, const Center& center, const Unit& unit, Real& rest) {
    NearLineOf line = at_origin(ray, center, unit);
    line.move_to(ray, center, line.to_t(line.closest()));
    // One step leaves an error of one rounding of the distance. From beyond 1 / u sizes that is
    // still far. A second step, which t alone could not hold, brings it near.
    constexpr double near = 4;
    rest = line.closest();
    const auto is_far = abs(rest) > near;
    if (any(is_far)) {
      const Real step = rest * line.unit_ * line.direction_scale_;
      line.move_to(ray, center, line.shift_, select(is_far, step, Real{}));
      rest = line.closest();
    }
    return line;
  }

  /// Moves `point` to where the ray is at t + t_low.
  template <class Ray, class Center>
  void move_to(const Ray& ray, const Center& center, const Real& t, const Real& t_low = Real{}) {
    shift_ = t;
    shift_low_ = t_low;
    point = inverse_unit_ * ray.from_center(center, t, t_low);
  }
  void move_to(const ObjectRay& ray, const Vec3& center, const DoubleDouble& t) {
    move_to(ray, center, t.hi, t.lo);
  }

  /// Returns the ray's t at x.
  Real to_t(const Real& x) const { return shift_ + (shift_low_ + to_t_length(x)); }

  /// Returns the ray's t at x before its last rounding.
  auto to_precise_t(const Real& x) const { return two_sum(shift_, shift_low_ + to_t_length(x)); }

  /// Converts a difference of x to a difference of t.
  Real to_t_length(const Real& x) const { return x * unit_ * direction_scale_; }

  Vec3Of<Real> at(const Real& x) const { return point + x * direction; }

  /// Returns x of the point closest to the centre.
  Real closest() const { return -dot(point, direction) / squared_length; }

 private:
  template <class Ray, class Unit>
  NearLineOf(const Ray& ray, const Unit& unit)
      : unit_(broadcast<Real>(unit)), inverse_unit_(broadcast<Real>(inverse_of_power(unit))) {
    direction_scale_ = inverse_of_power(power_of_two_below(largest_component(ray.direction)));
    direction = direction_scale_ * ray.direction;
    squared_length = dot(direction, direction);
  }

  Real unit_;
  Real inverse_unit_;
  Real direction_scale_;
  Real shift_;
  Real shift_low_;
};
using NearLine = NearLineOf<double>;

/// Returns how far a crossing may be off the surface in the standard tier, in the units of the
/// line. `reach` is that of standard_error().
template <class Reach>
Reach standard_error_across(const Reach& reach) {
  constexpr double roundings = 8;
  return roundings * unit_roundoff * reach;
}

/// Returns the standard tier's bound on the error of t at a crossing (docs/numerics.md), in units
/// of t: half an ulp of t and 8u (R + |x|) / |n . d|. All but t are in the units of the line.
/// `reach` is R + |x|, and `approach` is |n . d|. `longest` is the largest possible error of x
/// where the ray grazes.
template <class Real, class Reach>
Real standard_error(const NearLineOf<Real>& line, const Real& t, const Reach& reach,
                    const Real& approach, const Real& longest) {
  const Reach across = standard_error_across(reach);
  const Real along = select(across < longest * approach, across / approach, longest);
  return rounding_of(t) + line.to_t_length(along);
}

/// Returns how far the rounding that standard_error allows can move two roots from each other. They
/// are next to a grazing ray, on a surface of the given radius of curvature.
template <class Real, class Reach, class Radius>
Real grazing_error(const NearLineOf<Real>& line, const Reach& reach, const Radius& radius) {
  constexpr double roundings = 8;
  return sqrt(2 * roundings * unit_roundoff * reach * radius / line.squared_length);
}

/// Returns how far the other root of a x^2 + 2 b x + c moves when c is taken as 0. That c is only
/// the rounding of a start on the surface.
template <class Real>
Real start_error(const Real& c, const Real& a, const Real& b) {
  const Real size = abs(c);
  const Real grazing = sqrt(size / abs(a));
  const Real slope = 2.0 * abs(b);
  return select(size < slope * grazing, size / slope, grazing);
}

}  // namespace crt::core
