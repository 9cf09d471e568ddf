// The plane of a section is divided into cells until each has one face of the solid in it, or two
// that meet in a corner. Their corners are points of a grid, so neighbours agree on them.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/math/plane_point.hpp"
#include "core/measure/solid_cells.hpp"
#include "core/section/section_plane.hpp"

namespace crt::core {

/// A GridPoint has coordinates along the two axes of a plane, from 0 to BoundaryGrid::whole.
using GridPoint = std::array<std::int64_t, 2>;

/// An BoundaryGrid says where the points of a grid are. It covers a rectangle of a plane.
class BoundaryGrid {
 public:
  static constexpr std::int64_t whole = std::int64_t{1} << 44;

  /// `shift` is the number of an attempt: grids of other numbers have other points.
  BoundaryGrid(const SectionPlane& plane, const Bounds& bounds, int shift);

  std::size_t axis(std::size_t i) const { return axes_[i]; }
  double at(std::size_t i, std::int64_t place) const {
    return lower_[i] + size_[i] * (0x1p-44 * static_cast<double>(place));
  }
  PlanePoint at(const GridPoint& p) const { return {at(0, p[0]), at(1, p[1])}; }
  Vec3 in_space(const PlanePoint& p) const {
    Vec3 place;
    place[static_cast<int>(axes_[0])] = p.x;
    place[static_cast<int>(axes_[1])] = p.y;
    place[across_] = place_;
    return place;
  }
  /// Returns the flat box with two opposite corners, of which the first has smaller coordinates.
  Bounds box(const PlanePoint& lower, const PlanePoint& upper) const {
    return {in_space(lower), in_space(upper)};
  }
  Bounds box(const GridPoint& lower, const GridPoint& upper) const {
    return box(at(lower), at(upper));
  }
  /// Returns how long the sides of a cell are.
  std::array<double, 2> size(const GridPoint& lower, const GridPoint& upper) const;
  /// Returns the longest side of the whole grid.
  double size() const { return std::max(size_[0], size_[1]); }
  /// Returns the coordinate across the plane.
  double place() const { return place_; }
  /// Coordinates are rounded by less than this.
  double rounding() const { return rounding_; }

 private:
  std::array<std::size_t, 2> axes_;
  int across_;
  double place_;
  std::array<double, 2> lower_{};
  std::array<double, 2> size_{};
  double rounding_ = 0;
};

/// An BoundaryCell is a part of the plane with what crosses it.
struct BoundaryCell {
  GridPoint lower{};
  GridPoint upper{};
  std::shared_ptr<const OpenProgram> program{};
  CellLook look{};
  /// Each face is a graph over one axis, and no two meet but `first` and `second` in one corner at
  /// most, if these are not unknown_face.
  bool is_simple = false;
  static constexpr std::size_t unknown_face = ~std::size_t{0};
  std::size_t first = unknown_face;
  std::size_t second = unknown_face;
};

/// BoundaryLooks look at the cells of one solid.
class BoundaryLooks {
 public:
  BoundaryLooks(const CellSolid& solid, const BoundaryGrid& grid, int across, double size)
      : solid_(solid), grid_(grid), across_(static_cast<std::size_t>(across)), size_(size) {}

  const CellSolid& solid() const { return solid_; }
  const BoundaryGrid& grid() const { return grid_; }
  BoundaryCell root() const;
  enum class Found : std::uint8_t {
    nothing,   ///< nothing crosses the cell
    crossed,   ///< something may
    in_plane,  ///< a face lies in the plane
  };
  /// Finds out what crosses a cell.
  Found look_at(BoundaryCell& cell) const;
  /// Returns the parts of a cell, or nothing if it cannot be divided.
  std::vector<BoundaryCell> parts_of(const BoundaryCell& cell) const;
  /// Returns the longest side of a cell.
  double size(const BoundaryCell& cell) const;
  double diagonal(const BoundaryCell& cell) const;

 private:
  bool lies_in_plane(const CellFace& face) const;
  void find_form(BoundaryCell& cell) const;

  const CellSolid& solid_;
  const BoundaryGrid& grid_;
  std::size_t across_;
  double size_;
};

/// Returns whether a face is a graph over the other axis: its function grows, or shrinks, all along
/// this one.
inline bool is_steep(const CellFace& face, std::size_t axis) {
  return !face.slopes[axis].contains(0);
}

}  // namespace crt::core
