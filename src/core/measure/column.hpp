// A column is a cell that is seen along one of its axes: faces are heights over the other two axes,
// or walls along it.
//
// The height of a face is a polynomial of degree 4, found by Newton's iteration. What the face's
// function is there proves how far off it may be. Where heights cross each other, or the ends of
// the cell, is taken from their linear parts. As what is in the cell is continuous in all heights,
// an error there counts twice: the place is off, and so little is what differs there.
#pragma once

#include <optional>

#include "core/measure/cell_mass.hpp"

namespace crt::core {

/// Finds what is in a cell that a few faces cross, or nothing if it is a column along no axis.
std::optional<CellMass> column_mass(const CellSolid& solid, const Bounds& box, const CellLook& look,
                                    const MassQuestion& question);

}  // namespace crt::core
