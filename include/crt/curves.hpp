// Curves become the lines and arcs that contours of profiles are made of.
#pragma once

#include <crt/primitives.hpp>

namespace crt {

/// A CurvePoint is a point of a profile's plane that a curve goes through or is drawn to.
struct CurvePoint {
  double x = 0;
  double y = 0;

  friend bool operator==(const CurvePoint&, const CurvePoint&) = default;
};

/// Adds a cubic Bézier curve to a contour, from its last corner to `end`. It becomes arcs of
/// circles that continue one another's directions, so that walls of them have no edges, and
/// straight pieces where the curve is straight.
///
/// The arcs and the curve are within `deviation` of each other: each has no point that is farther
/// away from the other. 0 stands for a 10000th of the larger side of the box around the curve's
/// four points, or for 2^-44 of their largest coordinate if that is more. What is smaller than the
/// deviation may become one straight piece, and a curve whose points are all equal adds nothing.
/// A quarter of a circle becomes eight arcs by default, and an eighth of the deviation takes about
/// twice as many.
///
/// Throws Error (invalid_argument) if the contour has no corner yet, if a number is not finite or
/// above 1e100 in magnitude, and if a deviation is given that is below 0, below 2^-32 of the
/// curve's size, or below 2^-44 of its largest coordinate.
void append_cubic(Contour& contour, const CurvePoint& control1, const CurvePoint& control2,
                  const CurvePoint& end, double deviation = 0);

/// Adds a quadratic Bézier curve to a contour, from its last corner to `end`, as append_cubic()
/// does.
void append_quadratic(Contour& contour, const CurvePoint& control, const CurvePoint& end,
                      double deviation = 0);

}  // namespace crt
