// The triangles of a mesh with what is known of them as a whole: which lie in one plane, whether
// they enclose a solid, and a BVH over them.
//
// Corners are one if they are equal, and only then. Triangles enclose a solid if every edge belongs
// to an even number of them. A point then is inside if a line from it to infinity crosses an odd
// number of triangles: the parity rule. It needs no orientation, and says what is inside where
// triangles pass through one another.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/bounds.hpp"
#include "core/geometry/bvh.hpp"
#include "crt/primitives.hpp"

namespace crt {

class MeshTriangles {
 public:
  /// Throws Error (invalid_argument) for coordinates and indices out of range, and if no triangle
  /// has an area.
  MeshTriangles(std::span<const Vec3> positions, std::span<const TriangleIndices> triangles);

  /// Returns the number of triangles that have an area. They are numbered in the order in which
  /// they were given.
  std::uint32_t size() const { return static_cast<std::uint32_t>(triangles_.size()); }
  Triangle triangle(std::uint32_t number) const {
    const auto [a, b, c] = triangles_[number];
    return {.a = positions_[a], .b = positions_[b], .c = positions_[c]};
  }

  /// A PlaneOf says in which plane a triangle lies: in that of `first`, the first triangle in it.
  struct PlaneOf {
    std::uint32_t first : 31 = 0;
    std::uint32_t turned : 1 = 0;  ///< whether their normals are opposite
  };
  PlaneOf plane_of(std::uint32_t triangle) const { return planes_[triangle]; }

  bool is_closed() const { return fault_.empty(); }
  /// Returns whether each edge is used as often in one direction as in the other. The normals then
  /// point out of the solid, unless triangles pass through one another.
  bool is_oriented() const { return oriented_; }
  /// Returns why the triangles do not enclose a solid, or nothing if they do.
  const std::string& fault() const { return fault_; }

  const core::Bounds& bounds() const { return bounds_; }
  const core::Bvh& tree() const { return tree_; }
  std::size_t bytes() const;

 private:
  void weld(std::vector<TriangleIndices>& triangles);
  void find_open_edges(std::span<const TriangleIndices> triangles);
  void turn_outwards();
  void find_planes();
  void build_tree();

  std::vector<Vec3> positions_;
  std::vector<TriangleIndices> triangles_;
  std::vector<PlaneOf> planes_;
  std::string fault_;
  bool oriented_ = false;
  core::Bounds bounds_;
  core::Bvh tree_;
};

}  // namespace crt
