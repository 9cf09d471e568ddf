#include "core/mesh_files/mesh_builder.hpp"

#include <limits>
#include <utility>

#include "core/geometry/mesh/equal_positions.hpp"
#include "core/mesh_files/refused_mesh.hpp"

namespace crt::core {

namespace {

/// Leaves the first of equal positions. Returns the new numbers of all.
std::vector<std::uint32_t> weld(std::vector<Vec3>& positions) {
  std::vector<std::uint32_t> first = first_equal(positions);
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    if (first[i] != i) {
      first[i] = first[first[i]];  // an earlier one, which has its new number
      continue;
    }
    positions[count] = positions[i];
    first[i] = count++;
  }
  positions.resize(count);
  return first;
}

}  // namespace

void MeshBuilder::add_position(const Vec3& position) {
  if (positions_.size() == std::numeric_limits<std::uint32_t>::max())
    throw RefusedMesh("it has more than 4294967295 vertices");
  // Adding 0 makes 0 of -0.
  positions_.emplace_back(position.x + 0.0, position.y + 0.0, position.z + 0.0);
}

void MeshBuilder::add_face(std::span<const std::uint32_t> corners) {
  if (corners.size() == 3) {
    triangles_.push_back({corners[0], corners[1], corners[2]});
    return;
  }
  corners_.clear();
  places_.clear();
  for (const std::uint32_t corner : corners) {
    const Vec3& place = positions_[corner];
    if (!places_.empty() && places_.back() == place) continue;
    corners_.push_back(corner);
    places_.push_back(place);
  }
  while (places_.size() > 1 && places_.front() == places_.back()) {
    places_.pop_back();
    corners_.pop_back();
  }
  if (places_.size() < 3) {
    ++dropped_;
    return;
  }
  for (const auto& [a, b, c] : cutter_.cut(places_))
    triangles_.push_back({corners_[a], corners_[b], corners_[c]});
  if (cutter_.steps() > PolygonCutter::most_steps) {
    throw RefusedMesh(
        "cutting its faces into triangles takes too long: they have many corners and are not "
        "convex");
  }
}

MeshFile MeshBuilder::finish() {
  const std::vector<std::uint32_t> vertex_of = weld(positions_);
  for (TriangleIndices& triangle : triangles_) {
    for (std::uint32_t& corner : triangle) corner = vertex_of[corner];
  }
  dropped_ += std::erase_if(triangles_, [](const TriangleIndices& triangle) {
    const auto& [a, b, c] = triangle;
    return a == b || b == c || c == a;
  });
  if (triangles_.empty()) {
    throw RefusedMesh(dropped_ > 0 ? "each of its faces has equal corners" : "it has no faces");
  }
  return {.positions = std::exchange(positions_, {}),
          .triangles = std::exchange(triangles_, {}),
          .dropped_triangles = std::exchange(dropped_, 0)};
}

}  // namespace crt::core
