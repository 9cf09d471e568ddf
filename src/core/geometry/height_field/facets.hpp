// The facets of a height field are the triangles that enclose it: two for each cell, which are not
// listed but made of the heights as a line comes to them.
//
// They are what mesh/find_met_triangles.hpp calls triangles. No two of them meet but in edges and
// corners, except where a height of 0 is at the bottom. So each has the solid below it, or has its
// own plane in the bottom.
//
// Faces: 0 and 1 are the sides at lower and upper x, 2 and 3 those at lower and upper z, 4 is the
// bottom. Cell c, counted along x and then along z, has the faces 5 + 2 c, at lower x and upper z,
// and 6 + 2 c. A side has two triangles below each cell, of which one face is made. As the line is
// moved where it meets an edge, and not the edge, the bottom's two triangles need not end where
// those of the sides do (mesh/passing_line.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/geometry/bounds.hpp"
#include "core/geometry/height_field/grid.hpp"
#include "core/geometry/mesh/facing.hpp"
#include "core/geometry/mesh/passing_line.hpp"
#include "core/geometry/ray_slabs.hpp"
#include "crt/primitives.hpp"

namespace crt::core {

class HeightFacets {
 public:
  static constexpr std::uint32_t side_count = 4;
  static constexpr std::uint32_t bottom_face = side_count;
  static constexpr std::uint32_t first_of_cells = bottom_face + 1;

  /// Takes a field whose corners are valid. Throws Error (invalid_argument) for columns and rows
  /// that have no places of their own.
  explicit HeightFacets(const HeightField& field);

  const Bounds& bounds() const { return bounds_; }
  std::uint32_t face_count() const { return first_of_cells + 2 * cells_x_ * cells_z_; }
  /// Returns the bytes it takes beside the object itself, and without those of the heights.
  std::size_t more_bytes() const { return (xs_.capacity() + zs_.capacity()) * sizeof(double); }

  bool is_closed() const { return true; }
  bool is_oriented() const { return true; }
  bool counts_windings() const { return false; }
  /// Returns the corners of a face, or of a triangle in the plane of a side or the bottom.
  Triangle triangle(std::uint32_t face) const;
  Triangle corners_of_plane(std::uint32_t face) const { return triangle(face); }
  bool are_in_one_plane(std::uint32_t one, std::uint32_t other) const;
  bool are_opposite(std::uint32_t one, std::uint32_t other) const {
    return (one == bottom_face) != (other == bottom_face);
  }

  /// Returns triangles around all of the solid, counter-clockwise from outside, that meet in whole
  /// edges. There are none if the solid has no thickness somewhere.
  std::vector<Triangle> closed_triangles() const;

  /// A RoughPlane has all points where normal . p is `offset`, with rounded numbers.
  struct RoughPlane {
    Vec3 normal;
    double offset;
  };
  /// Appends the faces of cells that may lie in a plane and have a point in a box.
  void append_near(const RoughPlane& plane, const Bounds& box,
                   std::vector<std::uint32_t>& faces) const;

  /// An Item is a triangle that a line comes near.
  struct Item {
    Triangle corners;
    std::uint32_t number = 0;  ///< its face
  };
  const Triangle& corners_of(const Item& item) const { return item.corners; }
  Triangle corners_of_plane(const Item& item, const Triangle& own) const {
    return item.number < first_of_cells ? triangle(item.number) : own;
  }
  bool are_in_one_plane(const Item& item, std::uint32_t face) const {
    return are_in_one_plane(item.number, face);
  }
  Facing facing_of(const Item& item) const;

  /// A Leaf has the two triangles of a cell, of the side below a cell, or of the bottom.
  class Leaf {
   public:
    explicit Leaf(std::array<Item, 2> items) : items_(std::move(items)) {}
    std::uint32_t count() const { return static_cast<std::uint32_t>(items_.size()); }
    const Item& item(std::uint32_t i) const { return items_[i]; }
    TriangleLanes corners() const;

   private:
    std::array<Item, 2> items_;
  };

  /// A Child is a block of cells, or a leaf. It has no defaults, as many are made beforehand.
  struct Child {
    enum Kind : std::uint8_t { block, cell, side, bottom };

    Kind kind;
    std::uint8_t level;  ///< of a block; of a side its face
    std::uint32_t x;
    std::uint32_t z;

    bool is_leaf() const { return kind != block; }
  };

  /// Slabs are of a line that meets the blocks beside each other. Planes between two of them are
  /// met once.
  class Slabs : public RaySlabs {
   public:
    Slabs(const Vec3& origin, const Vec3& direction, double origin_error)
        : RaySlabs(origin, direction, origin_error), origin_(origin) {
      for (int axis = 0; axis < 3; ++axis) {
        inverse_[axis] = 1 / direction[axis];
        error_[axis] = origin_error * std::abs(inverse_[axis]);
        is_steep_ = is_steep_ || !(std::abs(inverse_[axis]) <= largest_inverse);
      }
    }
    /// Slabs have no scale of their own.
    double to_s(double t) const { return t; }
    /// Returns whether the line is parallel to an axis, or all but: then only spans() is right.
    bool is_steep() const { return is_steep_; }
    /// Returns where the line is within layers across an axis, between places and those after them.
    template <class Real>
    void clip(int axis, const Real& lower, const Real& upper, Real& enter, Real& leave) const {
      const bool is_upwards = inverse_[axis] > 0;
      const Real first = ((is_upwards ? lower : upper) - origin_[axis]) * inverse_[axis];
      const Real last = ((is_upwards ? upper : lower) - origin_[axis]) * inverse_[axis];
      enter = first - slack * abs(first) - error_[axis];
      leave = last + slack * abs(last) + error_[axis];
    }
    /// A Layers has numbers from which clip_y() goes on.
    struct Layers {
      double begin;  ///< where the line meets the height 0
      double along;  ///< from there to the height 1
      double error;
    };
    Layers layers(const Bounds& bounds, double size) const {
      const double begin = (bounds.lower.y - origin_.y) * inverse_.y;
      const double along = size * inverse_.y;
      const double of_places = slack * std::max(std::abs(bounds.lower.y), std::abs(bounds.upper.y));
      return {begin, along,
              2 * slack * (std::abs(begin) + std::abs(along)) + of_places * std::abs(inverse_.y) +
                  error_.y};
    }

   private:
    Vec3 origin_;
    Vec3 inverse_{0, 0, 0};
    Vec3 error_{0, 0, 0};
    bool is_steep_ = false;
  };

  Child root() const {
    return {.kind = Child::block,
            .level = static_cast<std::uint8_t>(grid_->top_level()),
            .x = 0,
            .z = 0};
  }
  Leaf leaf(const Child& child) const;

  /// Returns a part of a block of level 1 or more: a cell, or a block of the level below.
  static Child child_of(const Child& block, std::uint32_t i) {
    return {.kind = block.level == 1 ? Child::cell : Child::block,
            .level = static_cast<std::uint8_t>(block.level - 1),
            .x = parts_a_side * block.x + i % parts_a_side,
            .z = parts_a_side * block.z + i / parts_a_side};
  }

  /// Calls meet(child, enter) for what the line comes near in a block, within `part` of it.
  template <class Meet>
  void visit(const Child& block, const Slabs& slabs, const LineSpan& part, const Meet& meet) const {
    std::array<double, HeightGrid::parts_a_block> enters;
    for (std::uint32_t met = parts_near(block, slabs, part, enters); met != 0; met &= met - 1) {
      const auto i = static_cast<std::uint32_t>(std::countr_zero(met));
      meet(child_of(block, i), enters[i]);
    }
    const auto visit_flat = [&](const Child& child, const Bounds& box) {
      const LineSpan span = slabs.span(box);
      if (!span.empty() && span.leave >= part.enter && span.enter <= part.leave) {
        meet(child, span.enter);
      }
    };
    if (block.level == 1) for_sides(block, visit_flat);
    if (block.level == grid_->top_level()) {
      visit_flat({.kind = Child::bottom, .level = 0, .x = 0, .z = 0},
                 {bounds_.lower, {bounds_.upper.x, bounds_.lower.y, bounds_.upper.z}});
    }
  }

 private:
  static constexpr std::uint32_t parts_a_side = HeightGrid::parts_a_side;

  /// Parts are the parts of a block, side by side along x, in rows along z.
  struct Parts {
    std::array<double, parts_a_side + 1> xs;  ///< the places of their ends
    std::array<double, parts_a_side + 1> zs;
    std::array<Lanes, parts_a_side> low;  ///< heights that they are between
    std::array<Lanes, parts_a_side> high;
    std::uint32_t there;  ///< a bit for each that is there
  };

  double y_of(double height) const {
    if (height == 1) return bounds_.upper.y;
    return std::min(bounds_.lower.y + height * size_y_, bounds_.upper.y);
  }
  Vec3 corner(std::uint32_t column, std::uint32_t row) const {
    return {xs_[column], y_of(grid_->height(column, row)), zs_[row]};
  }
  std::array<Triangle, 2> triangles_of_cell(std::uint32_t x, std::uint32_t z) const;
  std::array<Triangle, 2> triangles_of_side(std::uint32_t side, std::uint32_t cell) const;
  /// Returns the two triangles between two points of the bottom and two above these, whose normals
  /// point out of a side.
  static std::array<Triangle, 2> wall(std::uint32_t side, const Vec3& one, const Vec3& other,
                                      double bottom);
  std::array<Triangle, 2> triangles_of_bottom() const;
  Parts parts_of(const Child& block) const;
  /// Returns the box of a part.
  Bounds box_of(const Parts& parts, std::uint32_t i) const {
    const std::uint32_t x = i % parts_a_side;
    const std::uint32_t z = i / parts_a_side;
    return {{parts.xs[x], y_of(parts.low[z][x]), parts.zs[z]},
            {parts.xs[x + 1], y_of(parts.high[z][x]), parts.zs[z + 1]}};
  }
  /// Returns which parts of a block the line comes near within `part` of it, and where it does.
  std::uint32_t parts_near(const Child& block, const Slabs& slabs, const LineSpan& part,
                           std::array<double, HeightGrid::parts_a_block>& enters) const;
  /// Returns where a line, which may be parallel to an axis, is within the parts of a row.
  LineSpanLanes spans_in_row(const Parts& parts, std::uint32_t row, const Slabs& slabs) const;
  void append_near_of_cell(const RoughPlane& plane, double margin, std::uint32_t x, std::uint32_t z,
                           std::vector<std::uint32_t>& faces) const;

  /// Calls use(child, box) for the sides below the cells of a block of level 1.
  template <class Use>
  void for_sides(const Child& block, const Use& use) const {
    const std::array<std::uint32_t, 2> cells = {cells_x_, cells_z_};
    const std::array<std::uint32_t, 2> first = {parts_a_side * block.x, parts_a_side * block.z};
    for (std::uint32_t side = 0; side < side_count; ++side) {
      const std::uint32_t across = side / 2;
      const std::uint32_t end = side % 2 == 0 ? 0 : cells[across] - 1;
      if (first[across] / parts_a_side != end / parts_a_side) continue;
      const std::uint32_t along = 1 - across;
      const std::uint32_t last = std::min(first[along] + parts_a_side, cells[along]);
      for (std::uint32_t i = first[along]; i < last; ++i) {
        const std::uint32_t x = across == 0 ? end : i;
        const std::uint32_t z = across == 0 ? i : end;
        Bounds box;
        for (const Triangle& triangle : triangles_of_side(side, i)) {
          for (const Vec3& place : {triangle.a, triangle.b, triangle.c}) box.include(place);
        }
        use(Child{.kind = Child::side, .level = static_cast<std::uint8_t>(side), .x = x, .z = z},
            box);
      }
    }
  }

  std::shared_ptr<const HeightGrid> grid_;
  Bounds bounds_;
  double size_y_;
  std::uint32_t cells_x_;
  std::uint32_t cells_z_;
  std::vector<double> xs_;  ///< of columns
  std::vector<double> zs_;  ///< of rows
};

}  // namespace crt::core
