// It is proved that each point of a mesh has a point of the solid's surface within a distance, and
// each point of the surface one of the mesh.
//
// Of a triangle: its copy moved inwards by the distance is in the solid, and the one moved outwards
// is not. So on the way from the one to the other, through each of its points, there is surface. Of
// a cell: what the linear bounds of its faces leave open as surface is covered by triangles that
// are near enough.
#pragma once

#include <vector>

#include "core/tessellate/cell_partition.hpp"
#include "core/tessellate/dual_mesh.hpp"
#include "core/tessellate/triangle_boxes.hpp"

namespace crt::core {

/// The corners of a triangle.
using DualTriangle = std::array<const DualVertex*, 3>;

/// A SurfaceProof proves that triangles are near the surface.
class SurfaceProof {
 public:
  /// What is given must outlive it.
  SurfaceProof(const CellSolid& solid, const CellPartition& partition, double deviation)
      : solid_(solid), partition_(partition), deviation_(deviation) {}

  double deviation() const { return deviation_; }
  /// Returns how much nearer than the deviation triangles are proved to be.
  double slack() const { return share_of_deviation * deviation_; }
  /// Returns whether a triangle is surely near the surface.
  bool is_near_surface(const DualTriangle& corners) const;
  /// Guesses whether it is worth while to ask so.
  bool may_be_near_surface(const DualTriangle& corners) const;

 private:
  static constexpr double share_of_deviation = 0x1p-10;

  bool is_small(const DualTriangle& corners, double distance) const;
  /// Returns whether a triangle is surely all in the solid, or all outside, as far as it follows
  /// from a look at what is around it.
  bool is_all(const FlatTriangle& triangle, bool inside, const CellLook& around,
              int halvings) const;

  const CellSolid& solid_;
  const CellPartition& partition_;
  double deviation_;
};

/// A MeshProof proves that the surface is near a mesh.
class MeshProof {
 public:
  /// What is given must outlive it.
  MeshProof(const CellSolid& solid, const CellPartition& partition, const DualMesh& mesh,
            double deviation)
      : solid_(solid), partition_(partition), mesh_(mesh), deviation_(deviation), boxes_(mesh) {}

  /// Returns whether what is surface in a cell is surely near a triangle.
  bool is_near_mesh(std::uint32_t cell) const;

 private:
  bool is_near_mesh(const Cell& cell, std::span<const std::uint32_t> near, int halvings) const;

  const CellSolid& solid_;
  const CellPartition& partition_;
  const DualMesh& mesh_;
  double deviation_;
  TriangleBoxes boxes_;
};

}  // namespace crt::core
