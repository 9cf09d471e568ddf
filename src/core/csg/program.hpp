// A program is a CSG tree compiled for rays. Complements are pushed to the leaves and equal
// operators are merged, so that only monotone AND and OR nodes are left. Each is a counter of its
// true children.
//
// A *leaf* is a primitive with its placement. Its *value* at a point is whether the point is
// inside, or for a complemented leaf outside. A node is true if at least `needed` of its children
// are: 1 for OR, all for AND. Node 0 is the root, and its value says whether the point is in the
// solid.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/csg/heavy_paths.hpp"
#include "core/csg/interval_filter.hpp"
#include "core/geometry/bvh.hpp"
#include "core/geometry/exact_shape.hpp"
#include "core/geometry/mesh/facet_attributes.hpp"
#include "core/geometry/placement.hpp"
#include "core/geometry/shape.hpp"

namespace crt::core {

/// A FaceSurface has the id of a whole surface, which is shared by all faces that lie on it. It
/// also says whether the face is turned against the surface's own canonical orientation.
struct FaceSurface {
  std::uint32_t surface = 0;
  bool flipped = false;
  /// This is set where other faces of the same object lie on the surface, too. It is a number among
  /// such surfaces of the object.
  std::uint32_t shared = not_shared;

  static constexpr std::uint32_t not_shared = 0xffffffffu;
};

/// SharedFaces are the faces of a leaf that lie on surfaces of leaves before it, in the order of
/// surfaces.
struct SharedFaces {
  struct Face {
    std::uint32_t surface;
    std::uint32_t face;  ///< of the leaf
  };
  std::vector<Face> faces;
};

/// UnlistedFaces says which faces of a leaf of very many are not in the table of face surfaces.
/// Each of them is alone on its surface, for all that others need to know.
struct UnlistedFaces {
  std::uint32_t begin = 0;          ///< faces before this are listed
  std::vector<std::uint32_t> some;  ///< some of the others are listed behind those, in order
  std::uint32_t first_surface = 0;  ///< the number of the surface of face 0, if it were not listed
};

/// A Leaf is a primitive in its place. The scene owns what it points to.
struct Leaf {
  const Shape* shape = nullptr;
  const ExactShape* exact = nullptr;     ///< the shape in the exact tier; none in the standard one
  const Placement* placement = nullptr;  ///< shared by leaves that are placed alike
  const void* family =
      nullptr;    ///< of its shape, which is neither complemented nor moved, nor in instances
  Bounds bounds;  ///< in the world, of what can matter of it
  std::uint32_t entity_id = 0;
  std::uint32_t part_id = 0;
  std::uint64_t user = 0;        ///< of Entity::with_user(), or 0
  std::uint32_t first_face = 0;  ///< of its faces in the table of face surfaces
  std::uint32_t face_count = 0;  ///< how many of them are there
  /// A leaf of more faces than this has its shared faces in a list, if there are any.
  static constexpr std::uint32_t few_faces = 8;
  std::shared_ptr<const SharedFaces> shared_faces;
  std::shared_ptr<UnlistedFaces> unlisted;  ///< none if all faces are listed
  bool has_normals = false;                 ///< its facets have normals for shading
  bool has_materials = false;               ///< its facets have materials of their own
  bool is_mesh = false;
  bool complemented = false;  ///< a cutter: its outside is what the solid keeps
  bool of_solid = true;       ///< whether its object is a solid, not a mere surface
  /// These say whether it has the ids of its entity, or a prototype's leaf those of each instance.
  bool takes_entity_id = false;
  bool takes_part_id = false;
  bool takes_user = false;

  /// Returns by how much the number of a face's material is more than that of the leaf.
  std::uint32_t material_place(std::uint32_t face) const {
    return has_materials ? shape->facet_attributes()->material(face) : 0;
  }
  /// Returns how many materials it has: its own, and then those of its facets.
  std::uint32_t material_count() const {
    if (!has_materials) return 1;
    return 1 + static_cast<std::uint32_t>(shape->facet_attributes()->materials().size());
  }

  bool has_many_faces() const { return face_count > few_faces || unlisted != nullptr; }
  /// Returns the face that stands at a place behind first_face in the table.
  std::uint32_t face_at(std::uint32_t place) const {
    const bool is_plain = unlisted == nullptr || place < unlisted->begin;
    return is_plain ? place : unlisted->some[place - unlisted->begin];
  }
  /// Returns what the table says of a face, or that it is alone on its surface.
  FaceSurface surface_of(std::uint32_t face, std::span<const FaceSurface> table) const {
    if (unlisted == nullptr || face < unlisted->begin) return table[first_face + face];
    const auto& some = unlisted->some;
    const auto found = std::lower_bound(some.begin(), some.end(), face);
    if (found == some.end() || *found != face) return {.surface = unlisted->first_surface + face};
    return table[first_face + unlisted->begin + static_cast<std::uint32_t>(found - some.begin())];
  }
};

/// A PlacedLeaf is a leaf where it is in the world. That is its own placement, unless it is a leaf
/// of an instance.
struct PlacedLeaf {
  const Leaf& leaf;
  const Placement& placement;

  // NOLINTNEXTLINE(google-explicit-constructor): a leaf is in its own place
  PlacedLeaf(const Leaf& own) : PlacedLeaf(own, *own.placement) {}
  PlacedLeaf(const Leaf& of_prototype, const Placement& in_world)
      : leaf(of_prototype), placement(in_world) {}
};

struct CsgNode {
  std::uint32_t parent = 0;
  std::uint32_t needed = 1;
  /// This counts the true children where every leaf is outside of its primitive. Bounded leaves are
  /// so at infinity.
  std::uint32_t count_outside = 0;
};

struct CsgProgram {
  std::vector<CsgNode> nodes;
  /// This has the node above each leaf, in the order of leaves.
  std::vector<std::uint32_t> leaf_parents;
  HeavyPaths paths;  ///< of deep programs: what takes the place of walking up from node to node
  Bvh tree;          ///< over what of each leaf's box matters
  IntervalFilter filter;
  Bounds bounds;  ///< of the object, in the world
  std::uint32_t shared_surfaces = 0;

  std::uint32_t leaf_count() const { return static_cast<std::uint32_t>(leaf_parents.size()); }
  /// Returns whether all of the object is within one of its leaves. Such a leaf is a part of an
  /// intersection, or what a difference takes from.
  bool is_within(std::uint32_t index, const Leaf& leaf) const {
    return leaf_parents[index] == 0 && nodes[0].needed > 1 && !leaf.complemented;
  }
};

/// A CsgObject is a program with its leaves, which scenes that share it number differently.
struct CsgObject {
  const CsgProgram& program;
  std::span<const Leaf> leaves;
  std::uint32_t first_leaf;            ///< the number of the first of them in the scene
  std::span<const FaceSurface> faces;  ///< of all leaves of the scene
  bool shares_surfaces = false;        ///< with an object before it in the scene
};

}  // namespace crt::core
