// Tests of meshes share these triangles.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "core/math/vector.hpp"
#include "crt/entity.hpp"
#include "crt/ray.hpp"
#include "geometry/random.hpp"

namespace crt::test {

struct TriangleList {
  std::vector<Vec3> positions;
  std::vector<TriangleIndices> triangles;

  Entity entity() const { return triangle_mesh(positions, triangles); }
  void add_quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), {a, b, c, d});
    triangles.push_back({first, first + 1, first + 2});
    triangles.push_back({first, first + 2, first + 3});
  }
  /// Adds another list, scaled and moved.
  void add(const TriangleList& other, const Vec3& place, double scale) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const Vec3& position : other.positions) positions.push_back(place + scale * position);
    for (const auto& [a, b, c] : other.triangles)
      triangles.push_back({first + a, first + b, first + c});
  }
};

/// Voxels are unit cubes on a grid, of which some are filled: cube (x, y, z) begins there.
class Voxels {
 public:
  Voxels(Random& random, int size) : size_(size) {
    while (!any()) {
      filled_.clear();
      for (int i = 0; i < size * size * size; ++i) filled_.push_back(random.one_in(2));
    }
  }

  bool at(int x, int y, int z) const {
    const auto is_in = [&](int i) { return i >= 0 && i < size_; };
    return is_in(x) && is_in(y) && is_in(z) &&
           filled_[static_cast<std::size_t>((x * size_ + y) * size_ + z)];
  }
  bool at(const Vec3& point) const {
    const auto floor = [](double x) { return static_cast<int>(std::floor(x)); };
    return at(floor(point.x), floor(point.y), floor(point.z));
  }

  template <class Use>
  void for_each(const Use& use) const {
    for (int x = 0; x < size_; ++x) {
      for (int y = 0; y < size_; ++y) {
        for (int z = 0; z < size_; ++z) {
          if (at(x, y, z)) use(x, y, z);
        }
      }
    }
  }

  /// Returns the faces between what is filled and what is not. Up to four triangles share an edge.
  TriangleList mesh() const {
    TriangleList list;
    for_each([&](int x, int y, int z) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const int side : {0, 1}) {
          std::array<int, 3> beside = {x, y, z};
          beside[static_cast<std::size_t>(axis)] += side == 0 ? -1 : 1;
          if (at(beside[0], beside[1], beside[2])) continue;
          Vec3 corner(x, y, z);
          corner[axis] += side;
          Vec3 u(0.0);
          Vec3 v(0.0);
          u[(axis + (side == 1 ? 1 : 2)) % 3] = 1;
          v[(axis + (side == 1 ? 2 : 1)) % 3] = 1;
          list.add_quad(corner, corner + u, corner + u + v, corner + v);
        }
      }
    });
    return list;
  }

  /// Returns the union of the cubes.
  Entity boxes() const {
    std::vector<Entity> cubes;
    for_each([&](int x, int y, int z) {
      const Vec3 corner(x, y, z);
      cubes.emplace_back(Box{.corner_a = corner, .corner_b = corner + Vec3(1.0)});
    });
    return csg_union(cubes);
  }

 private:
  bool any() const {
    for (const bool cube : filled_) {
      if (cube) return true;
    }
    return false;
  }

  int size_;
  std::vector<bool> filled_;
};

/// Returns 8 n^2 triangles about the origin, whose corners are about 1 away from it, by up to
/// `roughness`. It is then stretched by `scale`.
inline TriangleList ball_mesh(Random& random, int n, double roughness,
                              const Vec3& scale = Vec3(1.0)) {
  TriangleList list;
  std::map<std::array<int, 3>, std::uint32_t> numbers;
  const auto corner = [&](int x, int y, int z) {
    const auto [entry, added] =
        numbers.try_emplace({x, y, z}, static_cast<std::uint32_t>(list.positions.size()));
    if (added) {
      const Vec3 place(x, y, z);
      const double distance = std::sqrt(place.x * place.x + place.y * place.y + place.z * place.z);
      list.positions.push_back(scale * place / distance *
                               (1 + random.uniform(-roughness, roughness)));
    }
    return entry->second;
  };
  for (int octant = 0; octant < 8; ++octant) {
    const int sx = (octant & 1) != 0 ? -1 : 1;
    const int sy = (octant & 2) != 0 ? -1 : 1;
    const int sz = (octant & 4) != 0 ? -1 : 1;
    const auto at = [&](int i, int k) { return corner(sx * i, sy * k, sz * (n - i - k)); };
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      list.triangles.push_back(sx * sy * sz > 0 ? TriangleIndices{a, b, c}
                                                : TriangleIndices{a, c, b});
    };
    for (int i = 0; i < n; ++i) {
      for (int k = 0; i + k < n; ++k) {
        add(at(i, k), at(i + 1, k), at(i, k + 1));
        if (i + k + 1 < n) add(at(i + 1, k), at(i + 1, k + 1), at(i, k + 1));
      }
    }
  }
  return list;
}

/// Returns any of these, small and with all that rays may meet at once.
inline TriangleList random_mesh(Random& random) {
  switch (random.bits() % 4) {
    case 0:
      return Voxels(random, 1 + static_cast<int>(random.bits() % 3)).mesh();
    case 1:
      return ball_mesh(random, 1 + static_cast<int>(random.bits() % 5), 0);
    case 2:
      return ball_mesh(random, 4, 0.2);
    default:
      return ball_mesh(random, 3, 0.1, {1, random.power_of_ten(-9, 0), 1});
  }
}

/// Returns a ray that meets triangles where that is hardest: through corners, along edges and in
/// their planes, often by whole numbers.
inline Ray hard_ray(Random& random, const TriangleList& mesh) {
  const TriangleIndices& triangle = mesh.triangles[random.bits() % mesh.triangles.size()];
  const Vec3 a = mesh.positions[triangle[0]];
  const Vec3 b = mesh.positions[triangle[1]];
  const Vec3 c = mesh.positions[triangle[2]];
  const auto whole = [&] { return static_cast<double>(random.bits() % 3) - 1; };
  Vec3 aim = a;
  Vec3 direction = random.in_cube();
  switch (random.bits() % 6) {
    case 0:
      aim = mesh.positions[random.bits() % mesh.positions.size()] + random.in_cube();
      break;
    case 1:
      break;
    case 2:
      aim = 0.5 * (a + b);
      break;
    case 3:
      aim = a + whole() * (b - a) + random.uniform(-1, 2) * (c - a);
      direction = whole() * (b - a) + random.uniform(-1, 1) * (c - a);
      break;
    case 4:
      direction = {whole(), whole(), whole()};
      break;
    default:
      direction = b - a;
      break;
  }
  if (core::largest_component(direction) == 0) direction.z = 1;
  const double back = random.one_in(2) ? 8 : random.uniform(0, 8);
  constexpr double endless = std::numeric_limits<double>::infinity();
  return {.origin = aim - back * direction, .direction = direction, .t_min = -endless};
}

}  // namespace crt::test
