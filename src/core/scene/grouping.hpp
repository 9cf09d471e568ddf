#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/bounds.hpp"
#include "core/scene/part.hpp"

namespace crt::core {

/// Brings the parts of a union into groups such that a plane across an axis separates any two: their
/// boxes do not even touch, so the union of the groups is just all of them side by side. The order
/// within a group is kept; groups come in the order of their first parts. Returns where each ends. O(n log
/// n), on up to `threads` threads (as run_tasks() has it); what comes out is always the same.
std::vector<std::size_t> group_apart(std::vector<Part>& parts, int threads);

/// A box around a part in the world.
Bounds part_bounds(const Part& part);

}  // namespace crt::core
