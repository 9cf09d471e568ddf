// Where two faces may be the sides of a wall, and how thin it is at least.
#pragma once

#include <vector>

#include "core/measure/solid_cells.hpp"

namespace crt::core {

/// Directions are all those that are so near to one.
struct Directions {
  Vec3 middle{0, 0, 0};  ///< of length 1
  double spread = 0;     ///< in radians, at least a half turn if nothing is known
};

/// Returns the directions of vectors.
Directions directions_of(const std::array<Interval, 3>& vectors);

/// Returns a bound below or above the angles between two directions, in radians.
double least_angle(const Directions& a, const Directions& b);
double most_angle(const Directions& a, const Directions& b);

/// A WallFace is a face that bounds a solid in a cell, or any that may do so in an unknown one.
struct WallFace {
  const CellFace* face = nullptr;  ///< null if unknown
  Directions outward;              ///< has all normals out of the solid
  bool is_turned = false;          ///< whether they are against the slopes of its function
};

/// Returns the faces of a look at a cell of which `half` is half the size, once for each side of
/// them that may be solid. Those are left out that are narrower than `narrow` between two others,
/// and in a cell no larger than that those that turn within it.
std::vector<WallFace> wall_faces_of(const CellLook& look, const Vec3& half, double narrow);

/// A WallAngle says how far a wall may be off a normal of its sides, in radians.
struct WallAngle {
  double exact = 0;  ///< at the one side
  double loose = 0;  ///< at the other
};

/// Says whether there may be a chord from a side of `a` in a box to a side of `b` in another that
/// goes into the solid along a normal of each.
bool may_be_wall(const Bounds& box_a, const WallFace& a, const Bounds& box_b, const WallFace& b,
                 const WallAngle& angle);

/// Returns a bound below all distances from a face in a box to another one in a box.
double least_between(const Bounds& box_a, const WallFace& a, const Bounds& box_b,
                     const WallFace& b);

}  // namespace crt::core
