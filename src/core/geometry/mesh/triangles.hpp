// The triangles of a mesh with what is known of them as a whole: which lie in one plane, whether
// they enclose a solid, on which side of each that is, and a BVH over them.
//
// Corners are one if they are equal, and only then. Triangles enclose a solid if every edge belongs
// to an even number of them. A point then is inside if a line from it to infinity crosses an odd
// number of triangles: the parity rule. It needs no orientation, and says what is inside where
// triangles pass through one another.
//
// By the nonzero rule every edge must run as often in one direction as in the other, and a point is
// inside if its winding number is not 0. Where no winding number is beyond -1 and 1 the two rules
// say the same, and the parity rule holds, as it takes less time. That is so if each triangle is
// proven to face out of the solid or into it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/bounds.hpp"
#include "core/geometry/compact_bvh.hpp"
#include "core/geometry/mesh/facing.hpp"
#include "core/geometry/mesh/passing_line.hpp"
#include "crt/mesh.hpp"
#include "crt/primitives.hpp"

namespace crt {

namespace core {
class FacetAttributes;
struct MeshEdges;

/// Throws Error (invalid_argument) for what no mesh can be made of: coordinates, indices and
/// attributes out of range.
void check_mesh(std::span<const Vec3> positions, std::span<const TriangleIndices> triangles,
                const MeshAttributes* attributes);
}  // namespace core

class MeshTriangles {
 public:
  /// Takes triangles, of which a report says what has been changed. Without `fill` the rule is as
  /// the shells are turned. Throws Error (invalid_argument) for coordinates, indices and attributes
  /// out of range, and if no triangle has an area.
  MeshTriangles(std::span<const Vec3> positions, std::span<const TriangleIndices> triangles,
                const MeshAttributes* attributes = nullptr,
                std::optional<FillRule> fill = FillRule::even_odd, MeshReport report = {});
  ~MeshTriangles();
  MeshTriangles(const MeshTriangles&) = delete;
  MeshTriangles& operator=(const MeshTriangles&) = delete;

  /// Returns the number of triangles that have an area. They are numbered in the order in which
  /// they were given.
  std::uint32_t size() const { return static_cast<std::uint32_t>(placed_.size()); }
  Triangle triangle(std::uint32_t number) const { return corners_of(placed_[places_[number]]); }
  /// Returns the corners of a triangle: equal numbers for equal corners.
  const TriangleIndices& corners(std::uint32_t number) const {
    return placed_[places_[number]].corners;
  }
  /// Returns what the triangles have beyond their corners, or null.
  const core::FacetAttributes* attributes() const { return attributes_.get(); }

  /// A PlaneOf says in which plane a triangle lies: in that of `first`, the first triangle in it.
  struct PlaneOf {
    std::uint32_t first : 29 = 0;
    std::uint32_t turned : 1 = 0;  ///< whether their normals are opposite
    std::uint32_t facing : 2 = 0;
    /// Returns on which side of the triangle the solid is, as far as that has been proven.
    core::Facing faces() const { return core::Facing{facing}; }
  };
  PlaneOf plane_of(std::uint32_t triangle) const { return placed_[places_[triangle]].plane; }

  /// A Placed is a triangle as it stands among others that are near to it.
  struct Placed {
    TriangleIndices corners;  ///< equal numbers for equal corners
    std::uint32_t number;
    PlaneOf plane;
  };
  /// Returns the triangles in the order in which the leaves of the tree have them.
  std::span<const Placed> placed() const { return placed_; }
  Triangle corners_of(const Placed& placed) const {
    const auto [a, b, c] = placed.corners;
    return {.a = positions_[a], .b = positions_[b], .c = positions_[c]};
  }
  /// Returns the corners of up to four of placed(), from `first` on. Lanes that are left have those
  /// of the last.
  core::TriangleLanes placed_corners(std::uint32_t first, std::uint32_t count) const;

  /// Returns whether a triangle lies in the plane of a face.
  bool are_in_one_plane(const Placed& triangle, std::uint32_t face) const {
    return triangle.plane.first == plane_of(face).first;
  }
  bool are_in_one_plane(std::uint32_t one, std::uint32_t other) const {
    return plane_of(one).first == plane_of(other).first;
  }
  /// Returns whether the normals of two faces in one plane are opposite.
  bool are_opposite(std::uint32_t one, std::uint32_t other) const {
    return plane_of(one).turned != plane_of(other).turned;
  }
  core::Facing facing_of(const Placed& triangle) const { return triangle.plane.faces(); }
  /// Returns the corners of the first triangle in a triangle's plane.
  Triangle corners_of_plane(std::uint32_t number) const { return triangle(plane_of(number).first); }
  /// Returns these for a triangle of which the own corners are known.
  Triangle corners_of_plane(const Placed& placed, const Triangle& own) const {
    return placed.plane.first == placed.number ? own : triangle(placed.plane.first);
  }

  // This is how a line walks through the tree.
  using Child = core::BvhChild;
  using Slabs = core::GridSlabs;
  using Item = Placed;
  /// A Leaf has some of placed().
  class Leaf {
   public:
    Leaf(const MeshTriangles& mesh, core::BvhChild place) : mesh_(mesh), place_(place) {}
    std::uint32_t count() const { return place_.count(); }
    core::TriangleLanes corners() const { return mesh_.placed_corners(place_.index(), count()); }
    /// Returns a triangle that the line crosses. It is asked for by its number later.
    const Placed& item(std::uint32_t i) const {
      const Placed& placed = mesh_.placed_[place_.index() + i];
      __builtin_prefetch(&mesh_.places_[placed.number]);
      return placed;
    }

   private:
    const MeshTriangles& mesh_;
    core::BvhChild place_;
  };
  core::BvhChild root() const { return core::BvhChild::node(0); }
  Leaf leaf(core::BvhChild child) const { return {*this, child}; }
  template <class Meet>
  void visit(core::BvhChild node, const core::GridSlabs& slabs, const core::LineSpan& part,
             const Meet& meet) const {
    tree_.visit(node.index(), slabs, part, [&](core::BvhChild child, double enter) {
      if (child.is_leaf()) {
        __builtin_prefetch(&placed_[child.index()]);
      } else {
        tree_.prefetch(child);
      }
      meet(child, enter);
    });
  }

  bool is_closed() const { return fault_.empty(); }
  /// Returns whether each edge is used as often in one direction as in the other. The normals then
  /// point out of the solid, unless triangles pass through one another.
  bool is_oriented() const { return oriented_; }
  /// Returns whether winding numbers say what is inside, and not the parity rule.
  bool counts_windings() const { return counts_windings_; }
  /// Returns what is known of the triangles.
  const MeshReport& report() const { return report_; }
  /// Returns why the triangles do not enclose a solid, or nothing if they do.
  const std::string& fault() const { return fault_; }

  const core::Bounds& bounds() const { return bounds_; }
  const core::CompactBvh& tree() const { return tree_; }
  std::size_t bytes() const;

 private:
  std::vector<std::uint32_t> weld(std::vector<TriangleIndices>& triangles);
  void drop_flat(std::span<const TriangleIndices> triangles, core::MeshEdges& edges,
                 std::vector<std::uint32_t>& given);
  bool turn_outwards();
  void find_planes();
  void build_tree();
  void sort_along_tree(std::span<const std::uint32_t> order);
  void find_facing(std::optional<FillRule> fill, const core::MeshEdges& edges);

  std::vector<Vec3> positions_;  ///< and one more, as lanes are read with one number too many
  std::vector<Placed> placed_;
  std::vector<std::uint32_t> places_;  ///< among these, by number
  std::string fault_;
  bool oriented_ = false;
  bool counts_windings_ = false;
  MeshReport report_;
  core::Bounds bounds_;
  core::CompactBvh tree_;
  std::unique_ptr<const core::FacetAttributes> attributes_;
};

}  // namespace crt
