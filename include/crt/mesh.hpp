// Meshes may have more than triangles: normals, (u, v) and materials.
#pragma once

#include <array>
#include <crt/entity.hpp>
#include <crt/material.hpp>
#include <crt/primitives.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace crt {

/// This index says that a corner has no normal or no (u, v).
inline constexpr std::uint32_t no_index = 0xffffffff;

/// MeshAttributes are what the triangles of a mesh have beyond their corners. All of it says how
/// the surface looks. Which rays meet it, where, and where its inside is, the triangles alone say.
struct MeshAttributes {
  /// These are normals for shading, of any length. They are kept as floats. One that is 0 stands
  /// for that of the triangle. It does not matter to which side of a triangle they point: they are
  /// turned to where its own normal does.
  std::vector<Vec3> normals{};
  /// These name the normals of the corners of each triangle. Without any they are the triangles'
  /// own indices. A corner with no_index has the normal of the triangle.
  std::vector<TriangleIndices> normal_indices{};
  /// These are (u, v) for patterns and hits, up to 1e30 in magnitude. They are kept as floats.
  std::vector<std::array<double, 2>> uv{};
  /// These name the (u, v) of the corners of each triangle. Without any they are the triangles' own
  /// indices. A triangle with no_index at a corner has the weights of its second and third corner.
  std::vector<TriangleIndices> uv_indices{};
  /// These materials stand in the place of the default one: what a Mesh or Entity::with_material
  /// gives the whole mesh is put in their place.
  std::vector<SharedMaterial> materials{};
  /// This names the material of each triangle, or no_index for the default one. Without any all
  /// have the first.
  std::vector<std::uint32_t> material_of_triangle{};
  /// This is the largest angle in radians, in [0, pi], between triangles that are shaded as one
  /// round surface where they share an edge. Their normals are then computed, and those above are
  /// left alone. 0 leaves all triangles flat. Without it the mesh has the normals above, if any.
  std::optional<double> smooth{};
};

/// Makes triangles with shared corners and attributes for meshes. Two triangles share an edge if no
/// third has it and it runs from one to the other in opposite directions. It throws Error as the
/// function without attributes does, and invalid_argument for an attribute that is not finite or
/// out of range, naming the field.
std::shared_ptr<const MeshTriangles> mesh_triangles(std::span<const Vec3> positions,
                                                    std::span<const TriangleIndices> triangles,
                                                    const MeshAttributes& attributes);

/// Makes a Mesh of triangles with attributes.
Entity triangle_mesh(std::span<const Vec3> positions, std::span<const TriangleIndices> triangles,
                     const MeshAttributes& attributes);

}  // namespace crt
