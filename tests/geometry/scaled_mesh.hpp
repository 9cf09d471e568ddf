// Tests that scale primitives scale meshes by this.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/mesh/triangles.hpp"

namespace crt::test {

/// Returns a mesh with all lengths times `factor`.
inline Mesh scaled_mesh(const Mesh& mesh, double factor) {
  std::vector<Vec3> corners;
  std::vector<TriangleIndices> triangles;
  for (std::uint32_t i = 0; i < mesh.triangles->size(); ++i) {
    const Triangle triangle = mesh.triangles->triangle(i);
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    for (const Vec3& corner : {triangle.a, triangle.b, triangle.c}) {
      corners.push_back(factor * corner);
    }
  }
  return {.triangles = mesh_triangles(corners, triangles), .material = mesh.material};
}

}  // namespace crt::test
