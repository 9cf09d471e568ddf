// Regions of the plane: contours of straight pieces and arcs, and what is made of them.
#pragma once

#include <array>
#include <crt/primitives.hpp>
#include <optional>
#include <string>
#include <vector>

#include "import/placement.hpp"

namespace crt::importing {

/// A Region lies on the left of its contours: outer ones go from x to y, and holes the other way.
/// They do not cross.
using Region = std::vector<Contour>;

/// Returns a contour that goes the other way round.
Contour reversed(const Contour& contour);

/// Turns contours so that the region by the even-odd rule lies on their left. Contours without an
/// area are left out.
Region oriented(Region contours);

// Places of contours that are within 2^-38 of the size of the regions are one. Throws Error
// (unsupported, limit) where rounding would decide what is inside.

Region united(const std::vector<Region>& regions);
Region subtracted(const Region& from, const std::vector<Region>& cutters);
Region intersected(const std::vector<Region>& regions);

/// Says how corners that stick out are made by `offset_region()`.
enum class OffsetCorner { round, miter, chamfer };

/// Moves the boundary by a distance: outwards, or inwards if it is below 0. Round corners are arcs
/// for 0 `fragments`, and else so many pieces for a full circle. Arcs of the region have round
/// corners, too. Returns nothing if an arc that is hollow would become less than a point.
std::optional<Region> offset_region(const Region& region, double distance, OffsetCorner corner,
                                    int fragments);

/// Returns the smallest convex region that holds some. Throws Error (unsupported) for arcs that do
/// not bulge outwards around whole circles.
Region hull_of(const std::vector<Region>& regions);

/// Maps a region by the x and y of a matrix. Arcs stay arcs where the map scales evenly.
Region mapped(const Region& region, const Matrix& matrix);

struct RegionBounds {
  double low_x = 0, low_y = 0, high_x = 0, high_y = 0;
};
RegionBounds bounds_of(const Region& region);

/// Returns a circle of two arcs, or of so many straight pieces.
Contour circle_contour(double x, double y, double radius, int fragments);
Contour rectangle_contour(double low_x, double low_y, double high_x, double high_y);
bool has_arcs(const Region& region);

/// Returns the profile of an Extrusion or a Revolution.
std::string profile_text(const Region& region);

}  // namespace crt::importing
