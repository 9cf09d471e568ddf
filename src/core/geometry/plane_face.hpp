// Boxes, caps, discs and triangles have flat faces in common. All of them compute t here, so faces
// that coincide across a coordinate axis get the same bits.
#pragma once

#include <limits>
#include <type_traits>

#include "core/geometry/angles.hpp"
#include "core/geometry/clipped_span.hpp"
#include "core/geometry/shape.hpp"
#include "core/math/vector.hpp"
#include "core/math/vector_lanes.hpp"
#include "core/ray/object_ray.hpp"

namespace crt::core {

/// An AxisMeeting is where a line, or as many as a Real has lanes, meets a plane across a
/// coordinate axis. Only the line's components along that axis count.
template <class Real>
struct AxisMeeting {
  decltype(Real{} < Real{}) found{};  ///< if not, the rest means nothing
  Real t{};
  Real t_low{};
  Real error{};  ///< all as in PlaneFace::Meeting

  static AxisMeeting of(const Real& position, const Real& origin, const Real& speed,
                        const Real& origin_low = Real{}, const Real& speed_low = Real{});
};

template <class Real>
AxisMeeting<Real> AxisMeeting<Real>::of(const Real& position, const Real& origin, const Real& speed,
                                        const Real& origin_low, const Real& speed_low) {
  constexpr double largest = std::numeric_limits<double>::max();
  const auto offset = two_sum(position, -origin);
  const Real quotient = offset.hi / speed;  // not finite if the line is parallel
  const Real remainder =
      fma(-quotient, speed, offset.hi) + (offset.lo - origin_low - quotient * speed_low);
  const auto sum = two_sum(quotient, remainder / speed);
  // The computed value is within a few u^2 of the true one before its last rounding.
  constexpr double last_rounding = 1 + 0x1p-40;
  return {.found = abs(quotient) <= largest && abs(sum.hi) <= largest,
          .t = sum.hi,
          .t_low = sum.lo,
          .error = rounding_of(sum.hi) * last_rounding};
}

class PlaneFace {
 public:
  /// `normal` points out of the solid and may have any length but 0.
  PlaneFace(const Vec3& normal, const Vec3& position);

  /// A Meeting is where a line meets the plane.
  struct Meeting {
    bool found = false;  ///< false if the line is parallel, or so nearly that t has no finite value
    double t = 0;
    double t_low = 0;  ///< t + t_low is the computed value before its last rounding
    double error = 0;  ///< as in Crossing
    double rate = 0;   ///< n . d up to a positive factor
  };
  Meeting meet(const ObjectRay& ray) const;
  /// Does so for a plane across a coordinate axis, of one ray or of several side by side.
  template <class Real, class Ray>
  AxisMeeting<Real> meet_across_axis(const Ray& ray) const {
    const Real position = broadcast<Real>(position_[axis_]);
    if constexpr (requires { ray.origin_low; }) {
      return AxisMeeting<Real>::of(position, ray.origin[axis_], ray.direction[axis_],
                                   ray.origin_low[axis_], ray.direction_low[axis_]);
    } else {
      return AxisMeeting<Real>::of(position, ray.origin[axis_], ray.direction[axis_]);
    }
  }

  /// Returns the standard tier's bound on the error of t. `reach` is the distance from the
  /// position, and `rate` is n . d for a normal n of the given length.
  static double meeting_error(double t, double reach, double normal_length, double rate);

  /// Returns the meeting point relative to the position.
  Vec3 point(const ObjectRay& ray, const Meeting& meeting) const;

  /// Returns whether the point at t = 0 is behind the plane, neither on it nor before. It is for
  /// parallel lines.
  bool behind(const ObjectRay& ray) const { return height_at_origin(ray).hi < 0; }

  /// Cuts off the part of the line before the plane. It obeys ray.start if that is this face's
  /// number.
  void clip(const ObjectRay& ray, std::uint32_t face, ClippedSpan& span) const;

  /// Appends the one crossing of a surface without an inside, with face number 0.
  static void emit(const Meeting& meeting, CrossingList& out);

  /// Returns what meet() does, for surfaces without an inside. But if the ray starts on that plane,
  /// t is exactly 0, and the side is the one that the ray is known to leave to.
  Meeting meet_surface(const ObjectRay& ray) const;

  /// Returns whether the ray starts on face 0 itself, whatever rounding says near its edge. It is
  /// for surfaces without an inside.
  static bool starts_here(const ObjectRay& ray) { return ray.start.face == 0 && ray.start.on_face; }

  /// Moves a point, which is relative to the position, onto the plane. It takes a Vec3, or as many
  /// as there are lanes.
  template <class Vector>
  Vector onto_plane(const Vector& relative) const {
    using Real = RealOf<Vector>;
    if (axis_ < 0) {
      const Vector normal = broadcast<Real>(unit_normal_);
      const auto height = accurate_dot(normal, relative);
      return relative - (height.hi + height.lo) * normal;
    }
    return {axis_ == 0 ? Real{} : relative.x, axis_ == 1 ? Real{} : relative.y,
            axis_ == 2 ? Real{} : relative.z};
  }

  /// Writes what is at such a point, without u and v. If the plane is across a coordinate axis, the
  /// point is exactly on it.
  template <class Vector>
  void write_point(const Vector& relative, SurfacePointOf<RealOf<Vector>>& point) const {
    using Real = RealOf<Vector>;
    point.position = broadcast<Real>(position_) + relative;
    point.normal = broadcast<Real>(unit_normal_);
  }

  const Vec3& position() const { return position_; }
  const Vec3& unit_normal() const { return unit_normal_; }
  /// Returns the normal up to a power of two.
  const Vec3& normal() const { return normal_; }
  /// Returns the coordinate axis of the normal, or -1.
  int axis() const { return axis_; }

  /// Returns the plane with the face's own normal. The position of a plane across a coordinate axis
  /// has only that coordinate.
  Surface surface() const;

 private:
  Meeting meet_axis_plane(const ObjectRay& ray) const;
  /// Returns how far before the plane the point at t = 0 is, times the normal's length.
  DoubleDouble height_at_origin(const ObjectRay& ray) const;

  Vec3 normal_;
  Vec3 unit_normal_;
  Vec3 position_;
  int axis_;
};

/// Sets u and v of points on a disc, `relative` to its middle. u is the angle from the frame's
/// zero, and v is the distance as a share of the radius.
template <class Vector, class Real = RealOf<Vector>>
void set_polar(const Vector& relative, const AxisFrame& frame, double radius,
               SurfacePointOf<Real>& point) {
  const Vector scaled = relative / broadcast<Real>(radius);
  point.u = turn(dot(relative, broadcast<Real>(frame.zero)),
                 dot(relative, broadcast<Real>(frame.quarter)));
  point.v = min(broadcast<Real>(1), sqrt(dot(scaled, scaled)));
}

/// PlaneAxes are two unit vectors in the plane across `normal`, along growing u and v. u is x
/// projected (z where the normal is mostly along x). v is across u on the side of growing y (z
/// where the normal is mostly along y).
struct PlaneAxes {
  Vec3 u;
  Vec3 v;
};
PlaneAxes plane_axes(const Vec3& normal);

/// Returns an axis whose sense does not matter, in the length and sense that make its largest
/// component 1.
Vec3 canonical_axis(const Vec3& axis);

}  // namespace crt::core
