// A piece of a contour on a circle or a straight line, and where it meets others. All answers are
// those of doubles, to a tolerance.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/math/plane_vector.hpp"

namespace crt::core {

class PlanePiece {
 public:
  PlanePiece(const Vec2& from, const Vec2& to, double bulge);

  const Vec2& from() const { return from_; }
  const Vec2& to() const { return to_; }
  double bulge() const { return bulge_; }
  double length_of_chord() const { return 2 * half_; }
  const Vec2& lower() const { return lower_; }
  const Vec2& upper() const { return upper_; }

  /// Returns the distance from the circle or line, to first order: above 0 to the right of the
  /// direction in which the piece goes.
  double beside(const Vec2& point) const;
  /// Returns the normal at a point of the piece, out of its right side.
  Vec2 normal_at(const Vec2& point) const;
  /// Returns whether a point is on the piece, to a tolerance.
  bool has(const Vec2& point, double tolerance) const;
  /// Returns the point halfway.
  Vec2 middle() const;
  /// Returns a number in [0, 1] that grows along the piece.
  double order_of(const Vec2& point) const;
  /// Returns the bulge of the part between two points of the piece.
  double bulge_between(const Vec2& first, const Vec2& second) const;

  /// Returns how much the piece with the straight way back adds to a point's winding number beyond
  /// the polygon of all chords: 1 or -1 in its segment, and else 0.
  int winding_of_segment(const Vec2& point) const;
  /// Returns how much the chord adds to a point's winding number.
  int winding_of_chord(const Vec2& point) const;

 private:
  friend std::vector<Vec2> common_points(const PlanePiece& a, const PlanePiece& b,
                                         double tolerance);
  double height(const Vec2& point) const { return dot(across_, point - middle_of_chord_); }
  double angle_to(const Vec2& point) const;
  /// Points on the chord's line count as those next to them on the side of x, or of y.
  bool is_left_of_chord(const Vec2& point) const;

  Vec2 from_;
  Vec2 to_;
  double bulge_;
  double half_;
  Vec2 along_{1, 0};
  Vec2 across_{0, 1};
  Vec2 middle_of_chord_;
  Vec2 lower_;
  Vec2 upper_;
};

/// Returns where two pieces meet. Where they lie on each other for a while, it is the ends of that.
std::vector<Vec2> common_points(const PlanePiece& a, const PlanePiece& b, double tolerance);

}  // namespace crt::core
