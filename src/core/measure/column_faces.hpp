// The faces in a column are heights over the square across it, or walls along it.
#pragma once

#include <vector>

#include "core/geometry/face_functions.hpp"
#include "core/measure/simplices.hpp"
#include "core/measure/solid_cells.hpp"

namespace crt::core {

/// A ColumnHeight is where a face is over the square across a column, s and t from -1 to 1.
struct ColumnHeight {
  std::size_t face = 0;
  bool grows = false;  ///< its function is below 0 under it
  PatchSeries place;
};

/// A ColumnWall is a face along the column: its function depends on s and t alone, but for `error`.
struct ColumnWall {
  std::size_t face = 0;
  LinearFunction function;
  double error = 0;
  /// Says where it is surface of the solid, as CellLook::inside does of where the solid is.
  std::uint32_t surface = 0;
};

/// A ColumnFrame has the axes of a cell as a column along c has them: s runs along a, and t along
/// b.
struct ColumnFrame {
  const Bounds& box;
  CellFrame frame;
  int a;
  int b;
  int c;

  ColumnFrame(const Bounds& of_box, int axis)
      : box(of_box), frame(of_box), a((axis + 1) % 3), b((axis + 2) % 3), c(axis) {}

  Interval side(int axis) const {
    return Interval::of(box.upper[axis]) - Interval::of(box.lower[axis]);
  }
  /// Returns a coordinate across the column.
  PatchSeries across(int axis) const;
  /// Returns the places of a height.
  std::array<PatchSeries, 3> places_of(const PatchSeries& height) const;
};

/// The number of an axis as a place in an array.
inline std::size_t at(int axis) {
  return static_cast<std::size_t>(axis);
}

/// ColumnFaces are the faces that cross a column.
struct ColumnFaces {
  std::vector<ColumnWall> walls;
  std::vector<ColumnHeight> heights;

  /// Finds walls, and heights to a tolerance if they can be. Returns false if a face is neither, if
  /// none is a height, or if a joint that is bent is not the only wall.
  bool find(const CellSolid& solid, const CellLook& look, const ColumnFrame& frame,
            double tolerance);
};

/// Returns how much area a height has over one across the column.
PatchSeries slant_of(const CellSolid& solid, const CellLook& look, const ColumnFrame& frame,
                     const ColumnHeight& height);

/// Returns the axis along which all faces are surely heights, or walls, as steeply as can be. It is
/// -1 if there is none.
int column_axis_of(const CellLook& look, const Vec3& half);

/// Returns whether it may matter which of two heights is above the other for what a table says. It
/// does not if another face says which of them counts.
bool order_matters(const CellLook& look, std::uint32_t table, const ColumnHeight& one,
                   const ColumnHeight& other);
/// Returns whether a wall only says which of two heights is surface: on its sides the solid differs
/// between them alone, and one of them always counts.
bool only_exchanges(const CellLook& look, const ColumnWall& wall, const ColumnHeight& one,
                    const ColumnHeight& other);

}  // namespace crt::core
