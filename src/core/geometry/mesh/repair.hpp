// Triangles are put right before they become a mesh, if that is asked for: near vertices become
// one, and edges are divided where vertices lie on them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/mesh/triangles.hpp"
#include "crt/mesh.hpp"

namespace crt::core {

/// A GivenMesh is what a mesh is made of.
struct GivenMesh {
  std::span<const Vec3> positions;
  std::span<const TriangleIndices> triangles;
  const MeshAttributes& attributes;
};

/// Makes triangles by options, with this rule in the place of theirs. `report` has what is known of
/// a file. Throws Error as mesh_triangles() does.
std::shared_ptr<const MeshTriangles> make_mesh_triangles(const GivenMesh& given,
                                                         const MeshOptions& options,
                                                         std::optional<FillRule> fill,
                                                         MeshReport report);

/// Returns for each position the number of the one that it becomes: the first of those within a
/// tolerance that themselves become no other one. It takes O(n log n).
std::vector<std::uint32_t> first_within(std::span<const Vec3> positions, double tolerance);

/// A RepairedMesh is a mesh that is being changed. All attributes have indices of their own.
struct RepairedMesh {
  std::span<const Vec3> positions;
  std::vector<TriangleIndices> triangles;
  MeshAttributes attributes;
};

/// Divides open edges at the vertices of others that lie on them, up to a tolerance. What is
/// divided off is appended. Returns how many divisions there were. Throws Error (limit) for far
/// more of them than there are triangles.
std::uint64_t stitch(RepairedMesh& mesh, double tolerance);

}  // namespace crt::core
