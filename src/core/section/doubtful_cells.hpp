// Cells of which it is not known whether the outline is in them prove nothing, but that it is near
// where it is known.
#pragma once

#include <span>

#include "core/section/outline.hpp"

namespace crt::core {

/// Returns a bound on how far a point of the cells may be from the lines. It is 0 if there is no
/// cell, and infinite if there are cells and no line.
double farthest_doubt(const OutlineLooks& looks, std::span<const OutlineCell> cells,
                      std::span<const OutlineLoop> loops);

}  // namespace crt::core
