// The boundary of one solid in a plane: closed lines of chords, each with a proof of how near it is
// to the truth.
#pragma once

#include <vector>

#include "core/measure/measure_clock.hpp"
#include "core/section/boundary_pieces.hpp"

namespace crt::core {

/// An BoundaryLoop is a closed line. The solid is on its left, from the first axis to the second.
using BoundaryLoop = std::vector<BoundaryPoint>;

struct Boundary {
  std::vector<BoundaryLoop> loops;
  double deviation = 0;  ///< proved, or infinite
  Interval area{0, 0};
  bool lies_in_plane = false;  ///< a face does, and so nothing is known
  /// So many cells were left before they were too small to matter.
  std::size_t left_cells = 0;
  std::uint64_t looks = 0;
};

/// An BoundaryQuestion says how well the boundary is to be known.
struct BoundaryQuestion {
  double deviation = 0;
  double relative_width = 0;  ///< of the area
  double size = 0;            ///< half of the longest side of the box around all
};

/// Finds the boundary. The clock may end that early.
Boundary boundary_of(const CellSolid& solid, const SectionPlane& plane,
                     const BoundaryQuestion& question, MeasureClock& clock, const Workers& workers);

}  // namespace crt::core
