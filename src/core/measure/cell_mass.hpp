// How much of a solid is in a cell, surely: its volume, its moments, and the area of its surface.
//
// Where one face crosses a column from side to side, its height is a polynomial of degree 4, found
// by Newton's iteration and proved by what its function is there. All other crossed cells are cut
// by planes, with the volume between what a face may be and its plane as the error. So the errors
// shrink with the fifth and the second power of a cell's size, and flat faces have none.
#pragma once

#include <array>

#include "core/measure/solid_cells.hpp"

namespace crt::core {

/// A MassPart has what is asked of a part of a solid. Places are relative to a point.
struct MassPart {
  Interval volume{0, 0};
  std::array<Interval, 3> first{};   ///< integrals of x, y, z
  std::array<Interval, 6> second{};  ///< of x x, y y, z z, x y, y z, z x
  Interval area{0, 0};

  MassPart& operator+=(const MassPart& other);
};

/// A MassQuestion says what is asked.
struct MassQuestion {
  Vec3 reference{0, 0, 0};
  bool with_moments = true;
  bool with_area = true;
  /// Heights of faces need not be known better than this.
  double height_tolerance = 0;
  double area_tolerance = 0;  ///< nor areas, as a share of what is in question
};

/// Those integrals' coordinates.
inline constexpr std::array<std::array<std::size_t, 2>, 6> moment_pairs = {
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};

/// A CellMass is what is in a cell, and how it is best divided to know more.
struct CellMass {
  MassPart part;
  /// This is the axis along which a cell is one column, or -1.
  int column_axis = -1;
};

CellMass mass_of(const CellSolid& solid, const Bounds& box, const CellLook& look,
                 const MassQuestion& question);

}  // namespace crt::core
