// How far points are from a line or a circle through some of them, and what is between the points.
#pragma once

#include <cmath>
#include <optional>
#include <span>

#include "core/math/plane_point.hpp"
#include "core/section/contour_fit.hpp"

namespace crt::core {

inline double distance_between(const PlanePoint& a, const PlanePoint& b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  return std::sqrt(dx * dx + dy * dy);
}

/// A FitTolerance says how far points, and what is between them, may be from what is fitted.
struct FitTolerance {
  double points = 0;
  double between = 0;
};

/// A FittedArc goes from the first of some points to the last. One with a bulge of 0 is a line.
struct FittedArc {
  double bulge = 0;
  double off = 0;  ///< how far it and what is between the points are from each other, at most
};

/// Fits a line or an arc to points and the arcs and chords between them, or returns nothing if none
/// is near enough.
std::optional<FittedArc> fit_arc(std::span<const BoundaryPoint> points,
                                 const FitTolerance& tolerance);
/// Fits a whole circle to points that go around it once. It comes out as two half circles.
std::optional<FittedContour> fit_circle(std::span<const BoundaryPoint> points,
                                        const FitTolerance& tolerance);

}  // namespace crt::core
