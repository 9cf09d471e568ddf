// The mesh of a partition has a corner in each cell that the surface crosses, and a polygon for
// each edge of cells that it crosses, between the corners of the cells around. A corner lies on the
// surface, and on its edge or corner if that is in the cell.
// Source: Ju, Losasso, Schaefer, Warren, Dual contouring of Hermite data, 2002.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
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

/// A DualMesher makes the meshes of a partition that grows. What was found for cells that are not
/// divided since is taken over.
class DualMesher {
 public:
  /// What is given must outlive it.
  DualMesher(const CellSolid& solid, const CellPartition& partition, MeasureClock& clock)
      : solid_(solid), partition_(partition), clock_(clock) {}

  DualMesh mesh();

 private:
  struct PlaceHash {
    std::size_t operator()(const Vec3& place) const;
  };
  /// A GridCorner is an end of edges.
  struct GridCorner {
    Vec3 place{0, 0, 0};
    std::uint32_t cell = 0;
    bool is_known = false;
    bool is_inside = false;
  };
  /// A SurfaceEdge is one that the surface crosses.
  struct SurfaceEdge {
    GridEdge grid;
    bool starts_inside = false;
    bool has_crossing = false;
    bool has_diagonal = false;
    bool is_even = false;  ///< the diagonal of its polygon begins at the first cell
    Vec3 crossing{0, 0, 0};
  };
  struct Polygon {
    std::array<std::uint32_t, 4> corners{};
    std::size_t count = 0;
  };
  using CellCrossing = std::pair<std::uint32_t, Vec3>;
  /// The corners of the mesh, one for each cell with crossings.
  struct CellVertices {
    std::vector<DualVertex> vertices;
    std::vector<char> is_new;
    std::vector<CellCrossing> crossings;  ///< cells with theirs, sorted
    std::vector<std::size_t> starts;      ///< the first crossing of each, and one past the last
    std::vector<std::uint32_t> of_cell;

    std::span<const CellCrossing> crossings_of(std::uint32_t vertex) const {
      return std::span(crossings).subspan(starts[vertex], starts[vertex + 1] - starts[vertex]);
    }
  };

  const PartitionNode& node(std::uint32_t cell) const { return partition_.node(cell); }
  std::uint32_t corner_at(const Vec3& place, std::uint32_t cell);
  void find_edges();
  void find_corners();
  void take_over(const std::vector<SurfaceEdge>& before);
  void find_crossings();
  std::uint32_t plainest_cell(const GridEdge& edge) const;
  void place_vertices();
  DualVertex vertex(std::span<const CellCrossing> cell_crossings) const;
  Polygon polygon_of(const SurfaceEdge& edge) const;
  void find_diagonals();
  void add_polygon(const SurfaceEdge& edge, DualMesh& mesh) const;
  bool is_even_nearer(const std::array<std::uint32_t, 4>& corners) const;
  double length_of(std::uint32_t a, std::uint32_t b) const;
  double distance_of_middle(const std::array<std::uint32_t, 4>& around, std::uint32_t a,
                            std::uint32_t b) const;

  const CellSolid& solid_;
  const CellPartition& partition_;
  MeasureClock& clock_;
  std::unordered_map<Vec3, std::uint32_t, PlaceHash> corner_numbers_;
  std::vector<GridCorner> corners_;
  std::vector<SurfaceEdge> edges_;
  CellVertices cells_;
};

}  // namespace crt::core
