// How far a solid reaches in a cell along an axis: surely, and at most.
#pragma once

#include "core/measure/solid_cells.hpp"

namespace crt::core {

/// Both are times the sign, and -infinity if there is no point.
struct CellReach {
  double surely = -infinity;  ///< a point of the solid is there
  double most = -infinity;    ///< none is farther
};

CellReach reach_of(const Bounds& box, const CellLook& look, int axis, double sign);

/// Returns the parts of a box, which is halved along its longer sides, or the box if it cannot be.
std::vector<Bounds> halves_of(const Bounds& box, int whole_axis = -1);

}  // namespace crt::core
