// A closed line of many chords becomes a contour of few lines and arcs near it.
//
// A chord and an arc are near each other if the ends of the chord are, as all between them is
// within the sagitta of that. So a bound on the distance of both follows from the points alone.
#pragma once

#include <vector>

#include "core/section/boundary.hpp"
#include "crt/primitives.hpp"

namespace crt::core {

/// A FittedContour is within `off` of a line, and the line within it of the contour.
struct FittedContour {
  Contour contour;
  double off = 0;
};

/// Fits lines and arcs to a closed line. They are within `tolerance` of it if they can be, where
/// what is smaller than `smallest` does not count.
FittedContour fit_contour(const BoundaryLoop& loop, double tolerance, double smallest);

}  // namespace crt::core
