// Tests of meshes whose parts overlap share these boxes on a grid.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "crt/mesh.hpp"
#include "geometry/meshes.hpp"
#include "geometry/random.hpp"

namespace crt::test {

/// Adds the twelve triangles of a box, turned outwards or not.
inline void add_box(TriangleList& list, const Vec3& lower, const Vec3& upper,
                    bool outwards = true) {
  const auto first = static_cast<std::uint32_t>(list.positions.size());
  for (int i = 0; i < 8; ++i) {
    list.positions.emplace_back((i & 1) != 0 ? upper.x : lower.x, (i & 2) != 0 ? upper.y : lower.y,
                                (i & 4) != 0 ? upper.z : lower.z);
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> sides = {
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& [a, b, c, d] : sides) {
    for (const auto& [p, q, r] : {TriangleIndices{a, b, c}, TriangleIndices{a, c, d}}) {
      list.triangles.push_back(outwards ? TriangleIndices{first + p, first + q, first + r}
                                        : TriangleIndices{first + p, first + r, first + q});
    }
  }
}

/// A Cuboid is a box of whole numbers, with how often it is gone about.
struct Cuboid {
  std::array<int, 3> lower;
  std::array<int, 3> upper;
  bool outwards;

  /// Says whether a point is inside. Points on faces are as those at somewhat higher coordinates,
  /// as lines in faces are moved to there (passing_line.hpp).
  bool holds(const Vec3& point) const {
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      if (point[axis] < lower[i] || point[axis] >= upper[i]) return false;
    }
    return true;
  }
};

/// Returns some boxes on a grid, most of which overlap, touch or lie in one another.
inline std::vector<Cuboid> random_cuboids(Random& random, bool some_inwards) {
  std::vector<Cuboid> boxes(2 + random.bits() % 5);
  for (Cuboid& box : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.lower[axis] = static_cast<int>(random.bits() % 4);
      box.upper[axis] = box.lower[axis] + 1 + static_cast<int>(random.bits() % 3);
    }
    box.outwards = !some_inwards || !random.one_in(3);
  }
  return boxes;
}

inline TriangleList mesh_of(const std::vector<Cuboid>& boxes) {
  TriangleList list;
  for (const Cuboid& box : boxes) {
    const auto corner = [](const std::array<int, 3>& c) { return Vec3(c[0], c[1], c[2]); };
    add_box(list, corner(box.lower), corner(box.upper), box.outwards);
  }
  return list;
}

/// Returns what is known of triangles that become a mesh by options.
inline MeshReport report_of(const TriangleList& list, const MeshOptions& options) {
  return mesh_report(*mesh_triangles(list.positions, list.triangles, {}, options));
}

}  // namespace crt::test
