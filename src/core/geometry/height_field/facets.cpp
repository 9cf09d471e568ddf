#include "core/geometry/height_field/facets.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/geometry/checks.hpp"
#include "core/geometry/triangle/triangle.hpp"
#include "core/math/vector.hpp"

namespace crt::core {

namespace {

/// Returns the places of columns or rows.
std::vector<double> places_between(double lower, double upper, std::uint32_t count) {
  std::vector<double> places(count);
  const double cells = count - 1;
  for (std::uint32_t i = 0; i < count; ++i) {
    places[i] = i + 1 == count ? upper : lower + i * (upper - lower) / cells;
  }
  if (std::adjacent_find(places.begin(), places.end(), std::greater_equal<>()) != places.end()) {
    reject("corner_b", "must be farther away: not all columns and rows have places of their own");
  }
  return places;
}

/// Returns whether a corner of a triangle surely is beside the plane of another.
bool is_surely_beside(const Triangle& triangle, const Triangle& of_plane) {
  const Vec3 along = of_plane.b - of_plane.a;
  const Vec3 aside = of_plane.c - of_plane.a;
  const Vec3 normal = glm::cross(along, aside);
  const double size = largest_component(along) * largest_component(aside);
  constexpr double roundings = 64;
  for (const Vec3* corner : {&triangle.a, &triangle.b, &triangle.c}) {
    const Vec3 offset = *corner - of_plane.a;
    const double error = roundings * unit_roundoff * size * largest_component(offset);
    if (std::abs(glm::dot(normal, offset)) > error) return true;
  }
  return false;
}

}  // namespace

HeightFacets::HeightFacets(const HeightField& field)
    : grid_(field.heights),
      bounds_{glm::min(field.corner_a, field.corner_b), glm::max(field.corner_a, field.corner_b)},
      size_y_(bounds_.upper.y - bounds_.lower.y),
      cells_x_(grid_->columns() - 1),
      cells_z_(grid_->rows() - 1),
      xs_(places_between(bounds_.lower.x, bounds_.upper.x, grid_->columns())),
      zs_(places_between(bounds_.lower.z, bounds_.upper.z, grid_->rows())) {}

Triangle HeightFacets::triangle(std::uint32_t face) const {
  if (face >= first_of_cells) {
    const std::uint32_t cell = (face - first_of_cells) / 2;
    return triangles_of_cell(cell % cells_x_, cell / cells_x_)[(face - first_of_cells) % 2];
  }
  if (face == bottom_face) return triangles_of_bottom()[0];
  Vec3 one = bounds_.upper;
  Vec3 other = bounds_.upper;
  const int across = face / 2 == 0 ? 0 : 2;
  one[across] = other[across] = face % 2 == 0 ? bounds_.lower[across] : bounds_.upper[across];
  one[2 - across] = bounds_.lower[2 - across];
  return wall(face, one, other, bounds_.lower.y)[0];
}

bool HeightFacets::are_in_one_plane(std::uint32_t one, std::uint32_t other) const {
  if (one == other) return true;
  if (one < side_count || other < side_count) return false;
  const Triangle triangle = this->triangle(one);
  const Triangle of_plane = this->triangle(other);
  return !is_surely_beside(triangle, of_plane) && is_in_plane(triangle, of_plane);
}

/// A triangle at the bottom encloses nothing, and the bottom nothing below a height of 0.
Facing HeightFacets::facing_of(const Item& item) const {
  const double low = bounds_.lower.y;
  const auto& [a, b, c, material] = item.corners;
  const bool is_known = item.number == bottom_face ? y_of(grid_->lowest()) > low
                                                   : a.y > low || b.y > low || c.y > low;
  return is_known ? Facing::outwards : Facing::unknown;
}

TriangleLanes HeightFacets::Leaf::corners() const {
  const auto lanes = [&](const Vec3& first, const Vec3& second) {
    return VectorLanes{lanes_of(first.x, second.x, second.x, second.x),
                       lanes_of(first.y, second.y, second.y, second.y),
                       lanes_of(first.z, second.z, second.z, second.z)};
  };
  const Triangle& first = items_[0].corners;
  const Triangle& second = items_[1].corners;
  return {lanes(first.a, second.a), lanes(first.b, second.b), lanes(first.c, second.c)};
}

HeightFacets::Leaf HeightFacets::leaf(const Child& child) const {
  const auto made_of = [](const std::array<Triangle, 2>& triangles, std::uint32_t first,
                          std::uint32_t second) {
    return Leaf({Item{triangles[0], first}, Item{triangles[1], second}});
  };
  switch (child.kind) {
    case Child::cell: {
      const std::uint32_t face = first_of_cells + 2 * (child.z * cells_x_ + child.x);
      return made_of(triangles_of_cell(child.x, child.z), face, face + 1);
    }
    case Child::side:
      return made_of(triangles_of_side(child.level, child.level / 2 == 0 ? child.z : child.x),
                     child.level, child.level);
    default:
      return made_of(triangles_of_bottom(), bottom_face, bottom_face);
  }
}

std::array<Triangle, 2> HeightFacets::triangles_of_cell(std::uint32_t x, std::uint32_t z) const {
  const Vec3 first = corner(x, z);
  const Vec3 last = corner(x + 1, z + 1);
  return {Triangle{.a = first, .b = corner(x, z + 1), .c = last},
          Triangle{.a = first, .b = last, .c = corner(x + 1, z)}};
}

std::array<Triangle, 2> HeightFacets::triangles_of_side(std::uint32_t side,
                                                        std::uint32_t cell) const {
  if (side / 2 == 0) {
    const std::uint32_t column = side % 2 == 0 ? 0 : cells_x_;
    return wall(side, corner(column, cell), corner(column, cell + 1), bounds_.lower.y);
  }
  const std::uint32_t row = side % 2 == 0 ? 0 : cells_z_;
  return wall(side, corner(cell, row), corner(cell + 1, row), bounds_.lower.y);
}

std::array<Triangle, 2> HeightFacets::wall(std::uint32_t side, const Vec3& one, const Vec3& other,
                                           double bottom) {
  const Vec3 below_one(one.x, bottom, one.z);
  const Vec3 below_other(other.x, bottom, other.z);
  if (side == 0 || side == 3) {
    return {Triangle{.a = below_one, .b = below_other, .c = other},
            Triangle{.a = below_one, .b = other, .c = one}};
  }
  return {Triangle{.a = below_one, .b = other, .c = below_other},
          Triangle{.a = below_one, .b = one, .c = other}};
}

std::array<Triangle, 2> HeightFacets::triangles_of_bottom() const {
  const auto [lower, upper] = bounds_;
  const Vec3 last(upper.x, lower.y, upper.z);
  return {Triangle{.a = lower, .b = last, .c = {lower.x, lower.y, upper.z}},
          Triangle{.a = lower, .b = {upper.x, lower.y, lower.z}, .c = last}};
}

HeightFacets::Parts HeightFacets::parts_of(const Child& block) const {
  const std::uint32_t level = block.level - 1u;
  const std::uint32_t x = parts_a_side * block.x;
  const std::uint32_t z = parts_a_side * block.z;
  Parts parts;
  for (std::uint32_t i = 0; i <= parts_a_side; ++i) {
    parts.xs[i] = xs_[std::min((x + i) << 2 * level, cells_x_)];
    parts.zs[i] = zs_[std::min((z + i) << 2 * level, cells_z_)];
  }
  const std::uint32_t columns = std::min(grid_->blocks_along_x(level) - x, parts_a_side);
  const std::uint32_t rows = std::min(grid_->blocks_along_z(level) - z, parts_a_side);
  constexpr std::uint32_t one_a_row = 0x1111;
  parts.there = ((1u << columns) - 1) * (one_a_row & ((1u << parts_a_side * rows) - 1));
  if (level > 0) {
    const HeightGrid::Ranges& ranges = grid_->ranges(block.level, block.x, block.z);
    for (std::size_t row = 0; row < parts_a_side; ++row) {
      const std::uint16_t* const low = &ranges.low[parts_a_side * row];
      const std::uint16_t* const high = &ranges.high_less_1[parts_a_side * row];
      parts.low[row] = HeightGrid::Ranges::step * lanes_of(low[0], low[1], low[2], low[3]);
      parts.high[row] =
          HeightGrid::Ranges::step * (1.0 + lanes_of(high[0], high[1], high[2], high[3]));
    }
    return parts;
  }
  std::array<Lanes, parts_a_side + 1> low;
  std::array<Lanes, parts_a_side + 1> high;
  for (std::uint32_t i = 0; i <= parts_a_side; ++i) {
    const double* const heights = grid_->heights_from(x, std::min(z + i, cells_z_));
    const Lanes left = lanes_at<Lanes>(heights);
    const Lanes right = lanes_at<Lanes>(heights + 1);
    low[i] = min(left, right);
    high[i] = max(left, right);
  }
  for (std::size_t row = 0; row < parts_a_side; ++row) {
    parts.low[row] = min(low[row], low[row + 1]);
    parts.high[row] = max(high[row], high[row + 1]);
  }
  return parts;
}

std::uint32_t HeightFacets::parts_near(
    const Child& block, const Slabs& slabs, const LineSpan& part,
    std::array<double, HeightGrid::parts_a_block>& enters) const {
  const Parts parts = parts_of(block);
  const auto& xs = parts.xs;
  const auto& zs = parts.zs;
  LineSpanLanes by_x;
  slabs.clip(0, lanes_of(xs[0], xs[1], xs[2], xs[3]), lanes_of(xs[1], xs[2], xs[3], xs[4]),
             by_x.enter, by_x.leave);
  const Slabs::Layers layers = slabs.layers(bounds_, size_y_);
  const bool is_upwards = layers.along > 0;
  std::uint32_t met = 0;
  for (std::size_t row = 0; row < parts_a_side; ++row) {
    LineSpanLanes spans;
    if (slabs.is_steep()) {
      spans = spans_in_row(parts, static_cast<std::uint32_t>(row), slabs);
    } else {
      LineSpan by_z;
      slabs.clip(2, zs[row], zs[row + 1], by_z.enter, by_z.leave);
      const Lanes& first = is_upwards ? parts.low[row] : parts.high[row];
      const Lanes& last = is_upwards ? parts.high[row] : parts.low[row];
      spans.enter = max(max(by_x.enter, Lanes(by_z.enter)),
                        first * layers.along + (layers.begin - layers.error));
      spans.leave = min(min(by_x.leave, Lanes(by_z.leave)),
                        last * layers.along + (layers.begin + layers.error));
    }
    const LaneMask near =
        (spans.enter <= spans.leave) & (spans.leave >= part.enter) & (spans.enter <= part.leave);
    put_lanes(spans.enter, enters, parts_a_side * row);
    met |= mask_of(near) << parts_a_side * row;
  }
  return met & parts.there;
}

LineSpanLanes HeightFacets::spans_in_row(const Parts& parts, std::uint32_t row,
                                         const Slabs& slabs) const {
  RaySlabs::Corners lower;
  RaySlabs::Corners upper;
  for (std::uint32_t i = 0; i < lane_count; ++i) {
    const Bounds box = box_of(parts, parts_a_side * row + i);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lower[axis][i] = box.lower[static_cast<int>(axis)];
      upper[axis][i] = box.upper[static_cast<int>(axis)];
    }
  }
  return slabs.spans(lower, upper);
}

void HeightFacets::append_near(const RoughPlane& plane, const Bounds& box,
                               std::vector<std::uint32_t>& faces) const {
  constexpr double roundings = 0x1p-40;
  const double margin =
      roundings * (largest_component(plane.normal) * bounds_.farthest() + std::abs(plane.offset));
  std::vector<Child> open{root()};
  while (!open.empty()) {
    const Child block = open.back();
    open.pop_back();
    const Parts parts = parts_of(block);
    for (std::uint32_t left = parts.there; left != 0; left &= left - 1) {
      const auto i = static_cast<std::uint32_t>(std::countr_zero(left));
      const Bounds part = box_of(parts, i);
      double low = -plane.offset;
      double high = -plane.offset;
      bool touches = true;
      for (int axis = 0; axis < 3; ++axis) {
        const double from = part.lower[axis];
        const double to = part.upper[axis];
        const double along = plane.normal[axis];
        low += std::min(along * from, along * to);
        high += std::max(along * from, along * to);
        touches = touches && from <= box.upper[axis] && to >= box.lower[axis];
      }
      if (!touches || low > margin || high < -margin) continue;
      const Child child = child_of(block, i);
      if (child.is_leaf()) {
        append_near_of_cell(plane, margin, child.x, child.z, faces);
      } else {
        open.push_back(child);
      }
    }
  }
}

void HeightFacets::append_near_of_cell(const RoughPlane& plane, double margin, std::uint32_t x,
                                       std::uint32_t z, std::vector<std::uint32_t>& faces) const {
  std::uint32_t face = first_of_cells + 2 * (z * cells_x_ + x);
  for (const Triangle& triangle : triangles_of_cell(x, z)) {
    const auto is_near = [&](const Vec3& corner) {
      return std::abs(glm::dot(plane.normal, corner) - plane.offset) <= margin;
    };
    if (is_near(triangle.a) && is_near(triangle.b) && is_near(triangle.c)) faces.push_back(face);
    ++face;
  }
}

std::vector<Triangle> HeightFacets::closed_triangles() const {
  const double bottom = bounds_.lower.y;
  if (!(y_of(grid_->lowest()) > bottom)) return {};
  std::vector<Triangle> triangles;
  for (std::uint32_t z = 0; z < cells_z_; ++z) {
    for (std::uint32_t x = 0; x < cells_x_; ++x)
      for (const Triangle& triangle : triangles_of_cell(x, z)) triangles.push_back(triangle);
  }
  // The bottom is a fan, so that it meets each side's triangles in their edges.
  const Vec3 middle(0.5 * bounds_.lower.x + 0.5 * bounds_.upper.x, bottom,
                    0.5 * bounds_.lower.z + 0.5 * bounds_.upper.z);
  for (std::uint32_t side = 0; side < side_count; ++side) {
    const std::uint32_t cells = side / 2 == 0 ? cells_z_ : cells_x_;
    for (std::uint32_t i = 0; i < cells; ++i) {
      for (const Triangle& wall : triangles_of_side(side, i)) {
        triangles.push_back(wall);
        const std::array<Vec3, 3> corners = {wall.a, wall.b, wall.c};
        for (std::size_t k = 0; k < 3; ++k) {
          const Vec3& one = corners[k];
          const Vec3& next = corners[(k + 1) % 3];
          if (one.y == bottom && next.y == bottom) triangles.push_back({next, one, middle});
        }
      }
    }
  }
  return triangles;
}

}  // namespace crt::core
