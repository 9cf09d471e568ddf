#include "core/tessellate/triangle_boxes.hpp"

#include <glm/geometric.hpp>

#include "core/geometry/open_nodes.hpp"

namespace crt::core {

double distance_from(const FlatTriangle& triangle, const Vec3& point) {
  const auto& [a, b, c] = triangle;
  const Vec3 across = glm::cross(b - a, c - a);
  const double area = glm::dot(across, across);
  double least = infinity;
  bool is_over = area > 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& from = triangle[i];
    const Vec3 side = triangle[(i + 1) % 3] - from;
    const Vec3 way = point - from;
    if (glm::dot(glm::cross(across, side), way) < 0) is_over = false;
    const double squared = glm::dot(side, side);
    const double share = squared > 0 ? std::clamp(glm::dot(way, side) / squared, 0.0, 1.0) : 0;
    least = std::min(least, glm::length(way - share * side));
  }
  return is_over ? std::min(least, std::abs(glm::dot(across, point - a)) / std::sqrt(area)) : least;
}

TriangleBoxes::TriangleBoxes(const DualMesh& mesh) {
  boxes_.reserve(mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
    boxes_.push_back(box_of(triangle_of(mesh, i)));
  tree_ = Bvh(boxes_);
}

void TriangleBoxes::find(const Bounds& box, std::vector<std::uint32_t>& triangles) const {
  if (!tree_.has_root()) return;
  const std::size_t before = triangles.size();
  OpenNodes<std::uint32_t, 128> open;
  open.push(0);
  while (!open.empty()) {
    tree_.for_each_child(open.pop(), [&](Bvh::Child child, const Bounds& of_child) {
      if (!of_child.touches(box)) return;
      if (child.is_leaf())
        triangles.push_back(child.index());
      else
        open.push(child.index());
    });
  }
  std::sort(triangles.begin() + static_cast<std::ptrdiff_t>(before), triangles.end());
}

}  // namespace crt::core
