// The truth about a line and a closed mesh, in rational numbers (GMP). Nothing here is shared with
// src/core.
//
// A line is in or out of a mesh by the parity rule: a point is inside if a line from it to infinity
// crosses an odd number of triangles. Where a line o + t d meets triangles, corners and edges
// included, are the only places at which that may change. Each place is a fraction. If the line
// touches no edge, what it crosses itself says where it is inside. Otherwise another line says so
// for a point between any two neighbouring places: from there in a random direction.
//
// A point of the surface itself, such as between two places of a line along an edge, is taken as
// moved by an infinitely small amount: along x or, where that keeps it on a plane, along y, and
// along z where that does too. So there is one answer everywhere.
//
// Doubles with a bound on their error decide on which side of an edge a line passes, and whole
// numbers (GMP) what they leave open. A tree of boxes finds the triangles.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/meshes.hpp"

namespace crt::test {

/// A MeshPlace is where a line meets triangles.
struct MeshPlace {
  mpq_class t;
  bool inside_after = false;
  /// This is how far off the standard tier may put a crossing here: half an ulp of t and
  /// 8 u (R + |x|) / |n . d| of the steepest of its triangles, but no more than its length along
  /// the line. R is the mesh's size, and x is relative to its middle.
  double bound = 0;
};

/// Places are in ascending order, each at another t. Before the first the line is outside. What is
/// inside need not change at a place.
struct TrueMeshLine {
  std::vector<MeshPlace> places;
  bool touches_edges = false;  ///< the line meets an edge or a corner, or lies in a triangle

  bool inside_before(std::size_t place) const {
    return place > 0 && places[place - 1].inside_after;
  }
  /// Returns the places at which what is inside changes.
  std::vector<const MeshPlace*> flips() const;
};

/// Returns where a line is in the first of two solids and not in the second.
TrueMeshLine difference_of(const TrueMeshLine& from, const TrueMeshLine& taken);
/// Returns where a line is in either of two solids.
TrueMeshLine union_of(const TrueMeshLine& one, const TrueMeshLine& other);

class MeshOracle {
 public:
  /// Takes a closed mesh. Triangles without an area may be among its own.
  explicit MeshOracle(const TriangleList& mesh);

  TrueMeshLine along(const Vec3& origin, const Vec3& direction) const;

  /// Returns where a line meets the plane of a face, or nothing where it is parallel. Faces are the
  /// triangles that have an area.
  std::optional<mpq_class> meeting(std::uint32_t face, const Vec3& origin,
                                   const Vec3& direction) const;

 private:
  struct Line;
  struct Meeting;
  struct Node {
    Vec3 middle;
    Vec3 half;
    std::uint32_t begin;  ///< of its triangles
    std::uint32_t end;
    std::uint32_t beyond;  ///< its second child, if it has any: the first is the next node
  };
  using Corners = std::array<Vec3, 3>;

  void build(std::uint32_t begin, std::uint32_t end);
  Line line_of(const Vec3& origin, const Vec3& direction) const;
  template <class Use>
  void for_each_near(const Line& line, const Use& use) const;
  bool is_inside(const mpq_class& t, const Line& on) const;
  Vec3 random_direction(Random& random) const;
  double bound_of(const Corners& corners, const Line& line, const Meeting& meeting,
                  const mpq_class& t) const;

  std::vector<Corners> faces_;
  std::vector<std::uint32_t> order_;  ///< numbers of faces, as the nodes have them
  std::vector<Node> nodes_;
  Vec3 lower_{0};
  Vec3 upper_{0};
  int exponent_ = 0;  ///< all coordinates are multiples of 2^exponent_
};

}  // namespace crt::test
