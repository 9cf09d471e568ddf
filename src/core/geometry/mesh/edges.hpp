// The edges of a mesh say whether its triangles are closed and turned one way, which of them are
// connected, and which are repeated.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/mesh/facing.hpp"
#include "crt/primitives.hpp"

namespace crt::core {

/// MeshEdges are what the edges of triangles say, whose equal corners have equal numbers.
struct MeshEdges {
  /// These are the pairs of triangles that alone have an edge.
  std::vector<EdgePair> pairs;
  /// This says which edges belong to an odd number of triangles, or nothing.
  std::string open;
  /// This says which edges run more often in one direction than in the other, or nothing.
  std::string unbalanced;
  /// This has for each triangle the number of its shell. Edges connect the triangles of a shell.
  std::vector<std::uint32_t> shells;
  /// These have the same corners as an earlier one.
  std::vector<std::uint32_t> repeated;
};

MeshEdges find_edges(std::span<const Vec3> positions, std::span<const TriangleIndices> triangles);

}  // namespace crt::core
