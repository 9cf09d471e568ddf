// Cylinders and cones of the exact tier are decided by the sign of a polynomial.
//
// p is a point relative to the centre of the narrower end, and W is the axis from there to the
// wider end. r is the narrower radius, and D is how much wider the other is. A point between the
// caps is inside if
//    g = |W|^2 |p x W|^2 - (r |W|^2 + D p . W)^2 < 0.
// No root is taken and nothing divided, so g is a polynomial in the inputs. Between the planes of
// the caps the second square is of a radius that is not negative, so the cone's other nappe never
// matters. As the inside is convex, the signs of g where the line meets the two planes decide
// nearly everything.
//
// The signs come from doubles, then from double-doubles, with bounds on the error (FilteredSide).
// Where these leave one undecided, it comes from the quadratic without rounding (ExactSide, in the
// source file).
// Tests: tests/geometry/exact_frustum_test.cpp
#pragma once

#include <optional>

#include "core/geometry/exact_plane.hpp"
#include "core/geometry/frustum/start.hpp"
#include "core/geometry/near_line.hpp"

namespace crt::core {

/// An ExactFrustum is the solid in the numbers that the filters and the exact polynomial need.
struct ExactFrustum {
  Vec3 narrow;    ///< the centre of the narrower end
  Vec3 wide;      ///< the centre of the wider end
  double radius;  ///< r
  double wide_radius;
  double unit;

  PreciseVec3 axis;             ///< W
  DoubleDouble squared_length;  ///< |W|^2
  DoubleDouble narrow_part;     ///< r |W|^2
  DoubleDouble growth;          ///< D

  ExactFrustum(const Vec3& from, const Vec3& to, double from_radius, double to_radius);
};

/// A CapMeeting is the plane of a cap where the line meets it.
struct CapMeeting {
  ExactPlane::Meeting meeting;
  const ExactPlane* plane = nullptr;  ///< null if the line is parallel to the caps
  std::uint32_t face = invalid_index;
  bool within_rim = false;  ///< known to be, so it is not computed
  bool at_start = false;    ///< at t = 0 by identity

  bool found() const { return plane != nullptr; }
  Crossing crossing() const { return meeting.crossing(face); }
};

/// A FilteredSide is g along a line in rounded arithmetic. Every answer may be "unknown".
class FilteredSide {
 public:
  FilteredSide(const ExactFrustum& frustum, const ExactRay& ray)
      : frustum_(frustum),
        ray_(ray),
        axis_(frustum.axis[0].hi, frustum.axis[1].hi, frustum.axis[2].hi) {}

  /// Returns the sign of g where the line meets the plane of a cap. Far away it is outside.
  std::optional<int> sign_at(const CapMeeting& end) const;

  /// Returns whether g, positive at both ends, is negative in between.
  std::optional<bool> is_inside_between(const CapMeeting& enter, const CapMeeting& leave);

  /// Returns the crossing where g changes its sign, into the solid or out of it.
  std::optional<Crossing> root(bool entering, const CapMeeting& enter, const CapMeeting& leave);

  /// Returns the signs that decide what happens to a line that starts on the side.
  std::optional<SideStart> start() const;

 private:
  /// A PointAt has the parts of g at a point p: p x W and r |W|^2 + D p . W. Along a direction they
  /// are without r.
  struct PointAt {
    PreciseVec3 across;
    double across_size = 0;
    double across_error = 0;  ///< of each component
    DoubleDouble radius;
    double radius_error = 0;
  };

  /// A Precise is g in double-double, and its rate along the line.
  struct Precise {
    DoubleDouble value;
    double error = 0;
    double rate = 0;
    double rate_error = 0;
    double half_curvature = 0;

    std::optional<int> sign() const {
      if (!(std::abs(value.hi) > error)) return std::nullopt;
      return value.hi > 0 ? 1 : -1;
    }
  };

  /// A Local is g = a x^2 + 2 b x + c about the middle, in doubles.
  struct Local {
    double curvature, slope, value;  ///< a, b and c
    double curvature_error, slope_error;
    double inner, outer;    ///< at least the lengths whose squares differ by c
    double rate_of_points;  ///< bounds the rates of inner and outer in each component of p
  };

  double point_error(DoubleDouble t) const {
    return ray_.point_error(frustum_.narrow, t.hi) / frustum_.unit;
  }

  std::optional<int> rough_sign_at(DoubleDouble t, double off) const;

  /// Returns the parts of g at p, where `error` bounds the error of each component of p.
  PointAt part_of(const PreciseVec3& p, double error, DoubleDouble offset) const;

  PointAt point_at(DoubleDouble t, double off) const;

  /// Returns a bound on the error of |W|^2 a.across . b.across - a.radius b.radius.
  double difference_error(const PointAt& a, const PointAt& b) const;

  Precise precise_at(DoubleDouble t, double off) const;

  /// Moves the line to where g is lowest between the ends, or nearly.
  void find_middle(const CapMeeting& enter, const CapMeeting& leave);

  /// Returns the distance from the middle to an end, in t.
  double distance_to(const CapMeeting& end) const;

  Local local() const;

  /// Returns a lower bound of g between the ends, from its parabola about the middle.
  double lowest_between(const CapMeeting& enter, const CapMeeting& leave) const;

  /// Takes steps of Newton's iteration until t is certain to the last bit. Returns false if that
  /// fails.
  bool polish(DoubleDouble t, Crossing& crossing) const;

  const ExactFrustum& frustum_;
  const ExactRay& ray_;
  Vec3 axis_;                     ///< rounded
  std::optional<NearLine> line_;  ///< from the middle
  DoubleDouble middle_t_;
  Local middle_{};
};

}  // namespace crt::core
