// A hull grows point by point: the faces that see a new one go, and each edge around them gets a
// face with it. Sides are decided exactly, so the hull is closed and convex whatever is in one
// plane, or nearly.
// Source: Preparata, Hong, Convex hulls of finite sets of points in two and three dimensions, 1977.
// Tests: tests/csg/polyhedron_test.cpp
#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "core/geometry/checks.hpp"
#include "core/geometry/exact_sides.hpp"
#include "crt/mesh.hpp"
#include "crt/polyhedron.hpp"

namespace crt {

namespace core {

namespace {

class HullFaces {
 public:
  explicit HullFaces(const std::vector<Vec3>& points) : points_(points) {
    std::array<std::uint32_t, 4> first = first_corners();
    if (side(first[3], {first[0], first[1], first[2]}) > 0) std::swap(first[0], first[1]);
    // Each leaves out one of the four, which is behind it.
    const auto [a, b, c, d] = first;
    faces_ = {{a, b, c}, {a, d, b}, {b, d, c}, {c, d, a}};
    for (std::uint32_t i = 0; i < points_.size(); ++i) add(i);
  }

  const std::vector<TriangleIndices>& faces() const { return faces_; }

 private:
  int side(std::uint32_t point, const TriangleIndices& face) const {
    return side_of_plane(points_[point], points_[face[0]], points_[face[1]], points_[face[2]]);
  }
  /// Returns whether three points are on a line: in the plane of any other.
  bool are_on_line(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const DyadicVector across =
        cross(exactly(points_[b]) - exactly(points_[a]), exactly(points_[c]) - exactly(points_[a]));
    return std::ranges::all_of(across, [](const Dyadic& x) { return x.sign() == 0; });
  }
  std::array<std::uint32_t, 4> first_corners() const {
    std::array<std::uint32_t, 4> corners{};
    std::size_t found = 1;
    for (std::uint32_t i = 1; i < points_.size() && found < corners.size(); ++i) {
      const bool is_apart = found == 1   ? points_[i] != points_[corners[0]]
                            : found == 2 ? !are_on_line(corners[0], corners[1], i)
                                         : side(i, {corners[0], corners[1], corners[2]}) != 0;
      if (is_apart) corners[found++] = i;
    }
    if (found < corners.size()) reject("points", "must not all be in one plane");
    return corners;
  }

  void add(std::uint32_t point) {
    const auto seen =
        std::partition(faces_.begin(), faces_.end(),
                       [&](const TriangleIndices& face) { return side(point, face) <= 0; });
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (auto face = seen; face != faces_.end(); ++face)
      for (std::size_t i = 0; i < 3; ++i) edges.emplace((*face)[i], (*face)[(i + 1) % 3]);
    faces_.erase(seen, faces_.end());
    for (const auto& [from, to] : edges)
      if (!edges.contains({to, from})) faces_.push_back({from, to, point});
  }

  const std::vector<Vec3>& points_;
  std::vector<TriangleIndices> faces_;
};

}  // namespace

}  // namespace core

Hull::operator Entity() const {
  core::check_count("the hull has", "points", points.size(), most_hull_points);
  for (const Vec3& point : points) core::check_coordinates("points", point);
  const core::HullFaces hull(points);
  return Mesh{.triangles = mesh_triangles(points, hull.faces()), .material = material};
}

}  // namespace crt
