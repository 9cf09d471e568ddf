// Where the boundary of a section crosses the sides of its cells. What neighbours have in common of
// their sides is an edge, so both have the same crossings there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/section/boundary_cells.hpp"
#include "core/tasks/workers.hpp"

namespace crt::core {

/// The surface of what could not be distinguished.
inline constexpr std::uint64_t no_surface = ~std::uint64_t{0};

/// An EdgeCrossing is where the boundary crosses an edge.
struct EdgeCrossing {
  double place = 0;     ///< along the edge
  bool enters = false;  ///< the solid is beyond it, as coordinates grow
  std::uint64_t surface = no_surface;
};

/// An BoundaryEdge is a part of a line along an axis, between two points of the grid that are next
/// to each other.
struct BoundaryEdge {
  std::size_t along = 0;  ///< 0 or 1: the number of the axis
  std::int64_t line = 0;  ///< its coordinate across
  std::int64_t from = 0;
  std::int64_t to = 0;
  std::uint32_t cell = 0;   ///< the first that it is a side of
  bool is_precise = false;  ///< a simple cell needs its crossings to rounding
  std::uint32_t first = 0;  ///< the number of its first crossing
  std::vector<EdgeCrossing> crossings{};

  GridPoint begin() const { return point(from); }
  GridPoint end() const { return point(to); }
  friend bool operator<(const BoundaryEdge& a, const BoundaryEdge& b) {
    if (a.along != b.along) return a.along < b.along;
    return a.line != b.line ? a.line < b.line : a.from < b.from;
  }

 private:
  GridPoint point(std::int64_t place) const {
    return along == 0 ? GridPoint{place, line} : GridPoint{line, place};
  }
};

/// A BorderCrossing is a crossing of a cell's border, as one walks around it counterclockwise.
struct BorderCrossing {
  std::uint32_t number = 0;  ///< in all edges
  PlanePoint point;
  bool enters = false;
  std::uint64_t surface = no_surface;
};

class BoundaryEdges {
 public:
  explicit BoundaryEdges(const BoundaryLooks& looks) : looks_(looks) {}

  /// Finds the edges of cells, and what crosses them. What is known of edges that were there
  /// before is kept.
  void find(std::span<const BoundaryCell> cells, const Workers& workers);
  /// Returns the crossings of a cell's border in their order.
  std::vector<BorderCrossing> around(const BoundaryCell& cell) const;
  std::uint32_t crossing_count() const { return crossing_count_; }
  /// Returns how many looks were taken since the last call.
  std::uint64_t take_looks();

 private:
  struct Vertex {
    GridPoint point{};
    std::uint32_t cell = 0;
    bool is_inside = false;
  };
  void find_vertices(std::span<const BoundaryCell> cells, const Workers& workers);
  void list_edges(std::span<const BoundaryCell> cells);
  bool is_inside(const GridPoint& point) const;
  void add_side(const BoundaryCell& cell, std::size_t along, std::int64_t line, bool backwards,
                std::vector<BorderCrossing>& list) const;

  const BoundaryLooks& looks_;
  std::vector<Vertex> vertices_;     ///< in the order of their points
  std::vector<GridPoint> by_lines_;  ///< the same points, by the second coordinate first
  std::vector<BoundaryEdge> edges_;  ///< in order
  std::uint32_t crossing_count_ = 0;
  std::uint64_t looks_taken_ = 0;
};

}  // namespace crt::core
