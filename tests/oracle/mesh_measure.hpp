// These functions compare what both tiers report of meshes with the truth in rational numbers.
//
// In the exact tier the crossings must be those that there are, and each t the fraction rounded,
// within 0.51 ulp. In the standard tier there must be an even number of them that enter and leave
// by turns, each t within the bound that comes with it. What is inside may differ from the truth
// only between two neighbouring places that both are within the bounds of one place: one of them or
// another, such as of a triangle that the line grazes. For trees it is twice the bounds, as they
// overlap about two places that are off themselves. A ray of which anything differs so is a *close
// call*.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "oracle/random_meshes.hpp"

namespace crt::test {

struct MeshTierRecord {
  std::uint64_t wrong = 0;
  std::uint64_t close_calls = 0;
  double largest_ratio = 0;  ///< of an error to the bound
};

struct MeshRecord {
  std::uint64_t meshes = 0;
  std::uint64_t least_triangles = ~std::uint64_t{0};
  std::uint64_t max_triangles = 0;
  std::uint64_t rays = 0;
  std::uint64_t touching = 0;  ///< rays that meet an edge or a corner, or lie in a triangle
  std::uint64_t crossings = 0;
  std::uint64_t faces = 0;             ///< of pairs of meshes
  std::uint64_t coincident_faces = 0;  ///< those in a plane of the other mesh
  MeshTierRecord standard;
  MeshTierRecord exact;
  std::vector<std::string> failures;  ///< the first ones

  void add_mesh(const TriangleList& mesh);
  void add(const MeshRecord& other);
};

/// Measures one mesh of a kind with so many rays. One in ten is also asked of scenes.
MeshRecord measure_mesh(MeshKind kind, std::size_t triangles, std::uint64_t number,
                        std::uint64_t rays);

/// Measures the first of two meshes without the second, whose facets coincide.
MeshRecord measure_mesh_difference(std::size_t triangles, std::uint64_t number, std::uint64_t rays);

/// Measures one mesh that has the triangles of both, filled by the nonzero rule.
MeshRecord measure_mesh_union(std::size_t triangles, std::uint64_t number, std::uint64_t rays);

/// Measures so many rays in all, at meshes of 100 triangles to so many, as many rays at each size.
MeshRecord measure_meshes(MeshKind kind, std::size_t max_triangles, std::uint64_t rays);
MeshRecord measure_mesh_differences(std::size_t max_triangles, std::uint64_t rays);
MeshRecord measure_mesh_unions(std::size_t max_triangles, std::uint64_t rays);

}  // namespace crt::test
