// Places of a solid's surface near a place in a cell.
#pragma once

#include <span>
#include <vector>

#include "core/measure/solid_cells.hpp"
#include "core/tessellate/cell_partition.hpp"

namespace crt::core {

/// A FacePull is where a face is from a place: along `normal`, which points out of the solid, at
/// -distance. Both are those of the face's tangent plane.
struct FacePull {
  std::size_t face = 0;
  Vec3 normal{0, 0, 0};
  double distance = 0;
};

class SurfacePlaces {
 public:
  SurfacePlaces(const CellSolid& solid, const PartitionNode& node) : solid_(solid), node_(node) {}

  /// Returns whether a place of the cell is in the solid, as far as rounding lets one know.
  bool is_inside(const Vec3& place) const;
  /// Returns where a line from a place inside to one outside leaves the solid.
  Vec3 between(Vec3 inside, Vec3 outside) const;
  /// Returns the faces of the cell as seen from a place.
  std::vector<FacePull> pulls_at(const Vec3& place) const;
  /// Returns which of the faces is the surface nearest to a place, by their tangent planes, and how
  /// far away it is. It is infinite if none is.
  const FacePull* nearest(std::span<const FacePull> pulls, double& distance) const;
  /// Finds the place on all the faces given, or on as many as meet, that is nearest to a place.
  /// Returns false if it is not in the cell.
  bool meet(std::span<const std::size_t> faces, Vec3& place) const {
    return meet(faces, invalid_side, place);
  }
  /// Finds a place about in the middle of where two faces meet in the cell. Returns false if there
  /// is none.
  bool meet_on_the_way(std::span<const std::size_t> faces, Vec3& place) const;

 private:
  static constexpr int invalid_side = 6;

  /// Finds the place on a side of the cell, too: 0 and 1 are those across x.
  bool meet(std::span<const std::size_t> faces, int side, Vec3& place) const;
  bool knows_faces() const { return node_.look.kind == CellLook::Kind::crossed; }

  const CellSolid& solid_;
  const PartitionNode& node_;
};

}  // namespace crt::core
