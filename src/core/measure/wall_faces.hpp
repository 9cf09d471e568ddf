// Where two faces may be the sides of a wall, and how thin it is at least.
#pragma once

#include <vector>

#include "core/measure/solid_cells.hpp"

namespace crt::core {

/// A WallFace is a face that bounds a solid in a cell.
struct WallFace {
  const CellFace* face = nullptr;
  std::array<Interval, 3> outward{};  ///< has all normals out of the solid, of any length
  bool is_turned = false;             ///< whether they are against the slopes of its function
};

/// Returns the faces of a look, once for each side of them that may be solid.
std::vector<WallFace> wall_faces_of(const CellLook& look);

/// A WallAngle says how far a wall may be off a normal of its sides, by the square of the tangent.
struct WallAngle {
  double exact = 0;  ///< at the one side
  double loose = 0;  ///< at the other
};

/// Returns an upper bound of the square of the tangent of the angle between two directions, which
/// is infinite if it may be a right one or more.
double most_off(const std::array<Interval, 3>& a, const std::array<Interval, 3>& b);

/// Says whether there may be a chord from a side of `a` in a box to a side of `b` in another that
/// goes into the solid along a normal of each.
bool may_be_wall(const Bounds& box_a, const WallFace& a, const Bounds& box_b, const WallFace& b,
                 const WallAngle& angle);

/// Returns a bound below all distances from a face in a box to another one in a box.
double least_between(const Bounds& box_a, const WallFace& a, const Bounds& box_b,
                     const WallFace& b);

}  // namespace crt::core
