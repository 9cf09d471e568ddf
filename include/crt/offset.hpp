// Offsets of contours: regions that are larger or smaller all around by a distance.
#pragma once

#include <crt/primitives.hpp>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace crt {

/// Returns the contours of all points within `distance` of the region that contours enclose by the
/// even-odd rule. With a distance below 0 it is those of the region that are at least so far from
/// what is outside. So straight pieces move, arcs stay arcs of another radius, and outer corners
/// become arcs about them (inner ones, below 0): nothing is approximated, and corners are rounded
/// as doubles are. There may be no contours left. Outer ones go counterclockwise and holes
/// clockwise, and none crosses another.
///
/// Where contours that were moved come within 2^-38 of the size of one another, they are one there.
/// `work` is as in PathOptions. Throws Error (invalid_argument) naming the contour and the corner
/// as make_profile() does, or the distance if it is not finite or above 1e100 in magnitude; Error
/// (limit) for too many pieces near each other; and Error (unsupported) where they touch so closely
/// that rounding decides what is inside.
std::vector<Contour> offset_contours(std::span<const Contour> contours, double distance,
                                     const std::function<void(std::uint64_t)>& work = {});

}  // namespace crt
