#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "core/compile/part.hpp"
#include "core/geometry/bounds.hpp"

#include "core/tasks/workers.hpp"

namespace crt::core {

/// Brings the parts of a union into groups such that a plane across an axis separates any two of
/// them. Their boxes do not even touch but for rounding (csg/one_place.hpp), so the union of the
/// groups is all of them side by side. The order within a group is kept, and groups come in the
/// order of their first parts. Returns where each ends. bounds_of() returns a box around a part,
/// and is called from several threads. It takes O(n log n) on as many threads as `workers` says,
/// and the result is always the same.
std::vector<std::size_t> disjoint_groups(std::vector<Part>& parts,
                                         const std::function<Bounds(const Part&)>& bounds_of,
                                         const Workers& workers);

/// Returns a box around a part in the world.
Bounds part_bounds(const Part& part);

}  // namespace crt::core
