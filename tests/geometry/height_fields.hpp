// Tests of height fields share these.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/geometry/height_field/grid.hpp"
#include "crt/primitives.hpp"
#include "geometry/meshes.hpp"
#include "geometry/oracle.hpp"

namespace crt::test {

/// Returns a grid of a kind at random: rough, with whole steps, flat, terraced or with spikes. Many
/// heights are 0 or 1.
inline std::shared_ptr<const HeightGrid> random_grid(Random& random, std::uint32_t most = 9) {
  const auto count = [&] { return 2 + static_cast<std::uint32_t>(random.bits() % (most - 1)); };
  const std::uint32_t columns = count();
  const std::uint32_t rows = count();
  const std::uint64_t kind = random.bits() % 6;
  const double slope_x = std::floor(random.uniform(-2, 3)) / 64;
  const double slope_z = std::floor(random.uniform(-2, 3)) / 64;
  std::vector<double> heights;
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      switch (kind) {
        case 0:
          heights.push_back(random.uniform(0, 1));
          break;
        case 1:
          heights.push_back(std::floor(random.uniform(0, 5)) / 4);
          break;
        case 2:
          heights.push_back(std::clamp(0.5 + column * slope_x + row * slope_z, 0.0, 1.0));
          break;
        case 3:
          heights.push_back(((column / 2 + row / 3) % 4) / 4.0);
          break;
        case 4:
          heights.push_back(random.one_in(8) ? 1 : 0);
          break;
        default:
          heights.push_back(random.power_of_ten(-20, 0));
          break;
      }
    }
  }
  heights[random.bits() % heights.size()] = 0.5;
  return make_height_grid(heights, columns, rows);
}

/// Returns the mesh of the facets of a field, as primitives.hpp states them.
inline TriangleList mesh_of(const HeightField& field) {
  const HeightGrid& grid = *field.heights;
  const Vec3 lower = glm::min(field.corner_a, field.corner_b);
  const Vec3 upper = glm::max(field.corner_a, field.corner_b);
  const std::uint32_t columns = grid.columns();
  const std::uint32_t rows = grid.rows();
  TriangleList list;
  const auto place = [](double from, double to, std::uint32_t i, std::uint32_t cells) {
    return i == cells ? to : from + i * (to - from) / cells;
  };
  for (const bool is_top : {true, false}) {
    for (std::uint32_t row = 0; row < rows; ++row) {
      for (std::uint32_t column = 0; column < columns; ++column) {
        const double height = is_top ? grid.height(column, row) : 0;
        const double y =
            height == 1 ? upper.y : std::min(upper.y, lower.y + height * (upper.y - lower.y));
        list.positions.emplace_back(place(lower.x, upper.x, column, columns - 1), y,
                                    place(lower.z, upper.z, row, rows - 1));
      }
    }
  }
  const std::uint32_t below = columns * rows;
  for (std::uint32_t row = 0; row + 1 < rows; ++row) {
    for (std::uint32_t column = 0; column + 1 < columns; ++column) {
      const std::uint32_t a = row * columns + column;
      const std::uint32_t b = a + columns;
      list.triangles.push_back({a, b, b + 1});
      list.triangles.push_back({a, b + 1, a + 1});
      list.triangles.push_back({below + a, below + b + 1, below + b});
      list.triangles.push_back({below + a, below + a + 1, below + b + 1});
    }
  }
  const auto add_wall = [&](std::uint32_t one, std::uint32_t other, bool turned) {
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      list.triangles.push_back(turned ? TriangleIndices{a, c, b} : TriangleIndices{a, b, c});
    };
    add(below + one, below + other, other);
    add(below + one, other, one);
  };
  for (std::uint32_t row = 0; row + 1 < rows; ++row) {
    const std::uint32_t a = row * columns;
    add_wall(a, a + columns, false);
    add_wall(a + columns - 1, a + 2 * columns - 1, true);
  }
  for (std::uint32_t column = 0; column + 1 < columns; ++column) {
    const std::uint32_t last = (rows - 1) * columns;
    add_wall(column, column + 1, true);
    add_wall(last + column, last + column + 1, false);
  }
  return list;
}

}  // namespace crt::test
