// How far a solid, or what is not in it, reaches in a cell along a direction: surely, and at most.
#pragma once

#include "core/measure/solid_cells.hpp"

namespace crt::core {

/// Both are along the direction, and -infinity if there is no point.
struct CellReach {
  double surely = -infinity;  ///< a point of the solid is there:
  Vec3 point{0, 0, 0};        ///< this one
  double most = -infinity;    ///< none is farther
};

/// Says which points are asked for.
enum class CellPoints : std::uint8_t { inside, outside };

/// Returns how far points in a cell reach along a direction, which has about unit length.
CellReach reach_of(const Bounds& box, const CellLook& look, const Vec3& direction,
                   CellPoints points = CellPoints::inside);

/// Returns the parts of a box, which is halved along its longer sides, or the box if it cannot be.
std::vector<Bounds> halves_of(const Bounds& box, int whole_axis = -1);

}  // namespace crt::core
