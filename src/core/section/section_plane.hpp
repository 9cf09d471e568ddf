// The plane of a section, and the entity turned so that the plane is across one of its axes.
#pragma once

#include "core/math/plane_point.hpp"
#include "crt/entity.hpp"
#include "crt/section.hpp"

namespace crt::core {

/// A SectionPlane is {p : p[across] = place} of the turned entity. Its coordinates along two other
/// axes are those of the drawing, up to their signs.
struct SectionPlane {
  SectionFrame frame;  ///< of the drawing, in the world
  int across = 2;
  int first_axis = 0;   ///< the drawing's x runs along it,
  int second_axis = 1;  ///< and y along this one,
  double first_sign = 1;
  double second_sign = 1;  ///< or against them
  double place = 0;
  /// Says on which side of the plane the normal is: 1 or -1.
  double normal_sign = 1;

  /// Returns a point of the drawing from its coordinates along the axes.
  PlanePoint to_drawing(const PlanePoint& p) const {
    // A sum with 0 has no -0.
    return {0 + first_sign * p.x, 0 + second_sign * p.y};
  }
  /// Returns whether what is counterclockwise from the first axis to the second is clockwise in the
  /// drawing.
  bool is_mirrored() const { return first_sign * second_sign < 0; }
  /// Moves the plane along its normal.
  void move(double by);
};

/// Returns the plane, and turns the entity if the plane is not across a coordinate axis. Throws
/// Error (invalid_argument) for a normal of no length, and for numbers that are not finite.
SectionPlane section_plane(const Vec3& normal, double offset, Entity& entity);

}  // namespace crt::core
