// The shells of a mesh are the parts that edges connect. How they are turned says by which rule a
// mesh of a file is filled, and where they overlap is most likely not meant.
#pragma once

#include <cstdint>
#include <span>

#include "core/geometry/mesh/edges.hpp"
#include "core/geometry/mesh/facing.hpp"
#include "core/geometry/mesh/self_meetings.hpp"
#include "core/geometry/mesh/triangles.hpp"

namespace crt::core {

// `shells` has a number for each triangle of a closed and oriented mesh: that of its shell.

/// Returns whether all shells are turned outwards, but for those that are cavities of others.
bool are_turned_outwards(const MeshTriangles& mesh, const Fronts& fronts,
                         std::span<const std::uint32_t> shells);

/// Counts the shells, and those that enclose what they or others enclose, too.
void find_overlaps(const MeshTriangles& mesh, const SelfMeetings& meetings, const Fronts& fronts,
                   std::span<const std::uint32_t> shells, MeshReport& report);

/// Adds what a mesh is warned of to its report, and what was changed of it.
void add_mesh_warnings(const MeshTriangles& mesh, const MeshEdges& edges, MeshReport& report);

}  // namespace crt::core
