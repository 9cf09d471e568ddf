// The mesh of a partition has a corner in each cell that the surface crosses, and a polygon for
// each edge of cells that it crosses, between the corners of the cells around. A corner lies on the
// surface, and on its edge or corner if that is in the cell.
// Source: Ju, Losasso, Schaefer, Warren, Dual contouring of Hermite data, 2002.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/tessellate/cell_partition.hpp"

namespace crt::core {

/// A DualVertex is a corner of the mesh.
struct DualVertex {
  Vec3 place{0, 0, 0};
  Vec3 outwards{0, 0, 1};  ///< a unit vector to where the solid is not
  std::uint32_t cell = 0;
  int sharpness = 1;        ///< 2 on a sharp edge, 3 at a corner
  Vec3 edge{0, 0, 0};       ///< a unit vector along the sharp edge
  bool is_partial = false;  ///< the cell has faces that none of its sides shows
  bool is_plain = true;     ///< all faces that cross the sides of the cell meet there
};

/// A DualMesh is closed: beside each edge are two triangles.
struct DualMesh {
  std::vector<DualVertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise from outside
  /// Cells with an edge that several pairs of triangles share, or with faces that do not meet.
  std::vector<std::uint32_t> tangled;
};

DualMesh dual_mesh_of(const CellSolid& solid, const CellPartition& partition, MeasureClock& clock);

}  // namespace crt::core
