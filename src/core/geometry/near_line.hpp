// A ray as a round primitive solves for it: shifted to the primitive, in the primitive's own units.
//
// The line is (point + x direction) * unit, relative to the primitive's centre, where unit is a
// power of two near the primitive's size and direction is the ray's times a power of two: both
// scalings are exact, and neither the scene's size nor the length of the ray's direction matters
// after them.
#pragma once

#include <cmath>

#include "core/math/lanes.hpp"
#include "core/math/vector.hpp"
#include "core/ray/object_ray.hpp"

namespace crt::core {

/// One line, or as many side by side as a Real has lanes. (A Ray has what ObjectRay has, of such a
/// Real.)
template <class Real>
struct NearLineOf {
  Vec3Of<Real> point;
  Vec3Of<Real> direction;  ///< its largest component is in [1, 2)
  Real squared_length;     ///< direction . direction

  /// The line with `point` where the ray is at t = 0. Center and unit may be by lane.
  template <class Ray, class Center, class Unit>
  static NearLineOf at_origin(const Ray& ray, const Center& center, const Unit& unit) {
    NearLineOf line(ray, unit);
    line.move_to(ray, center, Real{});
    return line;
  }

  /// The line with `point` (nearly) where the ray comes closest to the centre.
  template <class Ray, class Center, class Unit>
  static NearLineOf at_closest(const Ray& ray, const Center& center, const Unit& unit) {
    Real rest;
    return at_closest(ray, center, unit, rest);
  }
  /// The same, and its closest().
  template <class Ray, class Center, class Unit>
  static NearLineOf at_closest(const Ray& ray, const Center& center, const Unit& unit, Real& rest) {
    NearLineOf line = at_origin(ray, center, unit);
    line.move_to(ray, center, line.to_t(line.closest()));
    // One step leaves an error of one rounding of the way. From beyond 1 / u sizes that is still
    // far: a second step, which t alone could not hold, brings it near.
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

  /// The ray's t at x.
  Real to_t(const Real& x) const { return shift_ + (shift_low_ + to_t_length(x)); }

  /// The same before its last rounding.
  auto to_precise_t(const Real& x) const { return two_sum(shift_, shift_low_ + to_t_length(x)); }

  /// A difference of x as a difference of t.
  Real to_t_length(const Real& x) const { return x * unit_ * direction_scale_; }

  Vec3Of<Real> at(const Real& x) const { return point + x * direction; }

  /// x of the point closest to the centre.
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

/// How far a crossing may be off the surface in the standard tier, in the units of the line:
/// `reach` is that of standard_error().
template <class Reach>
Reach standard_error_across(const Reach& reach) {
  constexpr double roundings = 8;
  return roundings * unit_roundoff * reach;
}

/// The standard tier's bound on the error of t at a crossing (docs/numerics.md), in units of t:
/// half an ulp of t and 8u (R + |x|) / |n . d|. All but t in the units of the line: `reach` is R +
/// |x|, `approach` is |n . d|, and `longest` what the error of x can be at most where the ray
/// grazes.
template <class Real, class Reach>
Real standard_error(const NearLineOf<Real>& line, const Real& t, const Reach& reach,
                    const Real& approach, const Real& longest) {
  const Reach across = standard_error_across(reach);
  const Real along = select(across < longest * approach, across / approach, longest);
  return rounding_of(t) + line.to_t_length(along);
}

/// How far apart two roots next to a grazing ray can be moved by the rounding that standard_error
/// allows, on a surface of the given radius of curvature.
template <class Real, class Reach, class Radius>
Real grazing_error(const NearLineOf<Real>& line, const Reach& reach, const Radius& radius) {
  constexpr double roundings = 8;
  return sqrt(2 * roundings * unit_roundoff * reach * radius / line.squared_length);
}

/// What the other root of a x^2 + 2 b x + c is moved by when c, which is only the rounding of a
/// start on the surface, is taken as 0.
template <class Real>
Real start_error(const Real& c, const Real& a, const Real& b) {
  const Real size = abs(c);
  const Real grazing = sqrt(size / abs(a));
  const Real slope = 2.0 * abs(b);
  return select(size < slope * grazing, size / slope, grazing);
}

}  // namespace crt::core
