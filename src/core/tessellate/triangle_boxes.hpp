// The triangles of a mesh are kept in a tree of boxes, to find those near a place.
#pragma once

#include <algorithm>
#include <vector>

#include "core/geometry/bvh.hpp"
#include "core/measure/simplices.hpp"
#include "core/tessellate/dual_mesh.hpp"

namespace crt::core {

inline FlatTriangle triangle_of(const DualMesh& mesh, std::uint32_t number) {
  const auto& [a, b, c] = mesh.triangles[number];
  return {mesh.vertices[a].place, mesh.vertices[b].place, mesh.vertices[c].place};
}

inline Bounds box_of(const FlatTriangle& triangle) {
  Bounds box;
  for (const Vec3& corner : triangle) box.include(corner);
  return box;
}

/// Returns the distance of a point from the nearest point of a triangle, rounded.
double distance_from(const FlatTriangle& triangle, const Vec3& point);

class TriangleBoxes {
 public:
  explicit TriangleBoxes(const DualMesh& mesh);

  /// Appends the triangles whose boxes touch a box, in order.
  void find(const Bounds& box, std::vector<std::uint32_t>& triangles) const;

 private:
  std::vector<Bounds> boxes_;
  Bvh tree_;
};

}  // namespace crt::core
