// Meshes may have more than triangles: normals, (u, v) and materials. What is inside may follow
// another rule, and gaps may be closed.
#pragma once

#include <array>
#include <crt/entity.hpp>
#include <crt/material.hpp>
#include <crt/primitives.hpp>
#include <crt/svg_path.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
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

/// MeshOptions say what is inside of a mesh, and how its triangles are put right before.
struct MeshOptions {
  /// This rule says what the triangles enclose. FillRule::even_odd: each point from which a line to
  /// infinity crosses an odd number of them. FillRule::nonzero: each point that they go about more
  /// often in one direction than in the other, so that parts which overlap are one solid. It needs
  /// edges that run as often in one direction as in the other: else the mesh is a surface. Without
  /// a rule it is even_odd for the triangles of a program. For those of a file it is nonzero if all
  /// shells are turned outwards, but for cavities, and else even_odd.
  std::optional<FillRule> fill{};
  /// Vertices up to this far from an earlier one become that one, in the order of their numbers. So
  /// none moves farther. It is a distance, from 0 (those with equal coordinates) to 1e100.
  double weld = 0;
  /// Where a vertex of an open edge lies on another open edge, up to this distance, the latter is
  /// divided there. This closes T-junctions. It is from 0 (never) to 1e100, and comes after `weld`.
  double stitch = 0;
  /// Gets the warnings of the MeshReport. Without it PreparedScene::warnings() has them.
  std::function<void(const std::string&)> warn{};
};

/// A MeshReport says what was found out about the triangles of a mesh, and what was changed.
struct MeshReport {
  std::string name{};                   ///< that of the file, or nothing
  FillRule fill = FillRule::even_odd;   ///< the rule that holds
  std::uint64_t welded_vertices = 0;    ///< so many became others by MeshOptions::weld
  std::uint64_t welded_triangles = 0;   ///< so many went, as two of their corners became one
  std::uint64_t stitched_vertices = 0;  ///< so many times an edge was divided
  /// So many triangles have the corners of an earlier one, turned either way. By the even-odd rule
  /// both then enclose nothing.
  std::uint64_t repeated_triangles = 0;
  Vec3 first_repeated{0, 0, 0};  ///< the middle of one of these
  /// So many parts are not connected by edges.
  std::uint64_t shells = 0;
  /// So many of them enclose what others enclose, too, in the same direction: they lie in them,
  /// they overlap them, or they pass through themselves. All that lie in others are found. Others
  /// are looked for at up to 4096 triangles that may pass through one another.
  std::uint64_t overlapping_shells = 0;
  Vec3 first_overlap{0, 0, 0};  ///< a point near the first of these places
  /// These say, a line each, what most likely was not meant, what of a file was left out, and what
  /// `weld` and `stitch` have done.
  std::vector<std::string> warnings{};
  bool reported = false;  ///< MeshOptions::warn has had the warnings
};

/// Returns what is known of the triangles of a mesh.
const MeshReport& mesh_report(const MeshTriangles& triangles);

/// Returns what is known of an entity that is one mesh, wherever it is placed, or null for others.
/// It lives as long as the entity.
const MeshReport* mesh_report(const Entity& entity);

/// Makes triangles with shared corners and attributes for meshes. Two triangles share an edge if no
/// third has it and it runs from one to the other in opposite directions. It throws Error as the
/// function without attributes does, invalid_argument for an attribute or option that is not finite
/// or out of range, naming the field, and limit if `stitch` finds far more vertices on edges than
/// there are triangles. It throws what MeshOptions::warn throws.
std::shared_ptr<const MeshTriangles> mesh_triangles(std::span<const Vec3> positions,
                                                    std::span<const TriangleIndices> triangles,
                                                    const MeshAttributes& attributes,
                                                    const MeshOptions& options = {});

/// Makes a Mesh of triangles with attributes.
Entity triangle_mesh(std::span<const Vec3> positions, std::span<const TriangleIndices> triangles,
                     const MeshAttributes& attributes, const MeshOptions& options = {});

}  // namespace crt
