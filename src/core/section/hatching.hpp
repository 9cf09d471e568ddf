// Hatching: lines at 45 degrees in what contours enclose.
#pragma once

#include <span>
#include <vector>

#include "core/section/contour_arcs.hpp"

namespace crt::core {

/// A HatchLine goes upwards to the right.
struct HatchLine {
  PlanePoint from;
  PlanePoint to;
};

/// Returns the parts of lines, a distance apart, that are in what contours enclose by the even-odd
/// rule. Throws Error (limit) if there are more than 10^5 lines.
std::vector<HatchLine> hatching(std::span<const Contour> contours, double distance);

}  // namespace crt::core
