// A plane line is how a ray looks along z, on a profile. It is asked where it passes between
// corners and across arcs. All answers are those of the exact numbers: by doubles with a bound on
// their error, or else by exact arithmetic.
//
// A line that passes exactly through a corner, or along a piece, is two lines: one that is moved to
// its right by next to nothing, and one that is moved to its left. For each no corner is on the
// line, so that it crosses an even number of pieces. The line is inside where both are.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "core/geometry/exact_quadratic.hpp"
#include "core/geometry/exact_ray.hpp"
#include "core/geometry/profile/profile.hpp"

namespace crt::core {

/// A ShiftMask says something of both lines: of the one that is moved to the right in bit 0, and of
/// the other in bit 1.
using ShiftMask = unsigned;
inline constexpr ShiftMask both_shifts = 3;

/// Returns both bits if the sign is 1, none if it is -1, and `otherwise` if it is 0.
inline ShiftMask mask_of_sign(int sign, ShiftMask otherwise) {
  return sign > 0 ? both_shifts : (sign < 0 ? 0U : otherwise);
}

inline ShiftMask complement(ShiftMask mask) {
  return mask ^ both_shifts;
}

/// Returns a x b for vectors of the plane.
template <class Vector>
auto cross_in_plane(const Vector& a, const Vector& b) {
  return a[0] * b[1] - a[1] * b[0];
}

inline double size_in_plane(const Vec3& v) {
  return std::max(std::abs(v.x), std::abs(v.y));
}

/// A CornerSide says on which side of the line a point is.
struct CornerSide {
  ShiftMask left = 0;  ///< the lines that it is to the left of
  double value = 0;    ///< its distance to the left, times the length of some direction
  double error = 0;

  bool is_on_line() const { return left == 1; }
};

/// An ArcCut says where a line crosses what bounds the segment of an arc. Each bit is 1 if that
/// line does.
struct ArcCut {
  ShiftMask enter = 0;  ///< the arc, where the line comes into the circle
  ShiftMask leave = 0;  ///< the arc, where it goes out
  ShiftMask chord = 0;  ///< the chord, but only where the polygon does not have it
};

class PlaneLine {
 public:
  /// Takes the line that a ray's doubles say.
  explicit PlaneLine(const ObjectRay& ray) : PlaneLine(ray, nullptr, 0, 0) {}
  /// Takes the line that a ray of the exact tier is without rounding. It must outlive this.
  explicit PlaneLine(const ExactRay& ray)
      : PlaneLine(ray.near, &ray, ray.origin_error, ray.direction_error) {}

  const ObjectRay& near() const { return near_; }
  /// Returns a bound on the distance of near() from the line at its begin.
  double origin_error() const { return origin_error_; }
  /// Returns the direction of near() in the plane, with its largest component in [1, 2), and how
  /// many times as long as that of near() it is.
  const Vec3& direction() const { return direction_; }
  double direction_scale() const { return scale_; }

  /// Returns whether the ray is along z, so that it is a point of the plane.
  bool is_point() const { return is_point_; }
  /// Returns whether that point is in the profile, and not on its boundary.
  bool is_inside(const Profile& profile);

  CornerSide side_of(const Vec3& corner);
  ArcCut cut(const Profile::Arc& arc, const Profile::Piece& chord, const CornerSide& from,
             const CornerSide& to);
  /// Returns whether the line goes to the right side of a piece that it crosses.
  static bool goes_right(const CornerSide& from, const CornerSide& to) {
    return from.left != to.left ? to.left > from.left : to.value > from.value;
  }

  /// A ChordOfLine is what a circle cuts out of the line. All lengths are in those of direction().
  struct ChordOfLine {
    double middle = 0;
    double half = 0;
    double error = 0;
  };
  ChordOfLine rough_chord(const Profile::Arc& arc) const;
  /// Returns the equation whose roots are where the line meets the circle of an arc.
  ExactQuadratic equation(const Profile::Arc& arc);
  const ExactLine& exact();

 private:
  PlaneLine(const ObjectRay& near, const ExactRay* ray, double origin_error,
            double direction_error);

  int exact_side(const Vec3& corner);
  ArcCut exact_cut(const Profile::Arc& arc, const Profile::Piece& chord, const CornerSide& from,
                   const CornerSide& to);

  const ObjectRay& near_;
  const ExactRay* ray_;
  Vec3 direction_{0, 0, 0};
  double scale_ = 1;
  double origin_error_;
  double direction_error_ = 0;  ///< of direction_
  bool is_point_ = false;
  std::optional<ExactLine> exact_;
};

}  // namespace crt::core
