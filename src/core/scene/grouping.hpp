#pragma once

#include <vector>

#include "core/geometry/bounds.hpp"
#include "core/scene/part.hpp"

namespace crt::core {

/// Splits the parts of a union into groups such that a plane across an axis separates any two: their
/// boxes do not even touch, so the union of the groups is just all of them side by side. The order
/// within a group is kept; groups come in the order of their first parts. O(n log n) a pass.
std::vector<std::vector<Part>> group_apart(std::vector<Part> parts);

/// A box around a part in the world.
Bounds part_bounds(const Part& part);

}  // namespace crt::core
