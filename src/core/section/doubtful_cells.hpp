// Cells of which it is not known whether the boundary is in them prove nothing, but that it is near
// where it is known.
#pragma once

#include <span>

#include "core/section/boundary.hpp"

namespace crt::core {

/// Returns a bound on how far a point of the cells may be from the lines. It is 0 if there is no
/// cell, and infinite if there are cells and no line.
double farthest_doubt(const BoundaryLooks& looks, std::span<const BoundaryCell> cells,
                      std::span<const BoundaryLoop> loops);

}  // namespace crt::core
