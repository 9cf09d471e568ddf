// The points of an arc as series, and what it adds to a polygon.
#pragma once

#include <array>

#include "core/math/patch_series.hpp"
#include "core/section/contour_arcs.hpp"

namespace crt::core {

/// Series of arcs are good up to this bulge: about a tenth of a circle.
inline constexpr double most_bulge_of_series = 0.15;

/// Returns the points of an arc or a chord for s from -1 to 1. Coordinates may be off by
/// `rounding`.
std::array<PatchSeries, 2> arc_series(const ContourPiece& arc, double rounding);

/// Encloses what is between an arc of a chord of a known length and the chord: above 0 for a bulge
/// above 0, which must be one that series are good for.
Interval segment_area(const Interval& chord, double bulge);

/// Returns the bulge of the arc from one point through another to a third, rounded.
double bulge_through(const PlanePoint& from, const PlanePoint& between, const PlanePoint& to);

}  // namespace crt::core
