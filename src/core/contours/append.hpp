// How corners are added to contours, and what lines and arcs of SVG paths add.
#pragma once

#include "crt/curves.hpp"

namespace crt::core {

/// Throws Error naming the point if it has numbers that are not finite or above 1e100 in magnitude.
void check_point(const CurvePoint& point, const char* name);

/// Returns the deviation for a curve of a size and of coordinates as large as `magnitude`, as
/// append_cubic() states. Throws Error if what was given is too small.
double checked_deviation(double deviation, double size, double magnitude);

/// Adds a corner, unless that is where the last one is.
void append_corner(Contour& contour, const ProfilePoint& corner);

/// An EllipticalArc is an arc of an ellipse by what SVG says of it, but with y upward.
struct EllipticalArc {
  double radius_x = 0;
  double radius_y = 0;
  double turned = 0;  ///< the ellipse, counterclockwise, in degrees
  bool is_large = false;
  bool is_counterclockwise = false;
};

/// Adds an arc to a contour that has a corner. Radii that are too small for the way are made larger
/// in proportion, and one of 0 makes a straight line.
/// Source: SVG 2, sections 9.5.1 and B.2.5.
void append_elliptical_arc(Contour& contour, const EllipticalArc& arc, const CurvePoint& end,
                           double deviation);

}  // namespace crt::core
