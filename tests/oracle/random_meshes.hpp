// Random closed meshes of four kinds, and lines that meet them where that is hardest.
#pragma once

#include <cstddef>
#include <cstdint>

#include "crt/query.hpp"
#include "geometry/meshes.hpp"

namespace crt::test {

enum class MeshKind : std::uint8_t {
  marched,     ///< of a smooth field, by marching tetrahedra
  subdivided,  ///< a ball, mostly with noise
  slivers,     ///< fans of needles, needles beside edges, or a ball stretched by up to 10^6
  snapped,     ///< voxels or a ball whose corners are multiples of 1/8, many in one place
};
inline constexpr std::size_t mesh_kinds = 4;
const char* name_of(MeshKind kind);

/// Returns a mesh of about so many triangles. Half of those that are not snapped are of any size
/// from 10^-9 to 10^9 and up to 100 sizes away from 0.
TriangleList make_mesh(MeshKind kind, Random& random, std::size_t triangles);

/// Returns a line, as a ray without an end. Half of the lines are random, half aimed at corners and
/// edges, along edges, into planes of triangles or along axes from the coordinates of corners. One
/// in eight starts 10^9 sizes away.
Ray line_at(const TriangleList& mesh, Random& random);

/// Returns a mesh and another that has a part of its surface: voxels and the same moved by whole
/// cells, or a ball and the same with some corners displaced.
struct MeshPair {
  TriangleList first;
  TriangleList second;
  Vec3 moved{0};  ///< by so much the second was moved, without any rounding
};
MeshPair coincident_meshes(Random& random, std::size_t triangles);

}  // namespace crt::test
