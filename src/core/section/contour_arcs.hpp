// The arcs of contours: their circles, what they enclose and how far they reach.
#pragma once

#include <cmath>

#include "core/geometry/bounds.hpp"
#include "core/math/plane_point.hpp"
#include "crt/primitives.hpp"

namespace crt::core {

/// A ContourPiece goes from one corner of a contour to the next.
struct ContourPiece {
  PlanePoint from;
  PlanePoint to;
  double bulge = 0;

  bool is_arc() const { return bulge != 0; }
  double chord() const;
  /// These are of an arc.
  double radius() const { return chord() * (1 + bulge * bulge) / (4 * std::abs(bulge)); }
  PlanePoint center() const;
  double angle() const;  ///< above 0 counterclockwise
  /// Returns the place at a share of the way.
  PlanePoint at(double share) const;
};

/// Returns piece i of a contour: from corner i to the next.
ContourPiece piece_of(const Contour& contour, std::size_t i);

/// Returns what a contour encloses: above 0 if it goes counterclockwise.
double enclosed_area(const Contour& contour);

/// Makes bounds hold a contour, in x and y.
void include_contour(const Contour& contour, Bounds& bounds);

}  // namespace crt::core
