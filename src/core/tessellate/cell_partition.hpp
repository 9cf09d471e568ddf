// Space around a solid is divided into cells in each of which its surface is simple: one sheet,
// nearly flat but for sharp edges and corners. The cells are the leaves of a tree of boxes that are
// halved along one axis each.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/base/invalid_index.hpp"
#include "core/measure/measure_clock.hpp"
#include "core/measure/solid_cells.hpp"

namespace crt::core {

/// A PartitionNode is a cell, or it is halved at `place` along `axis`: into the cells `lower_half`
/// and the one after.
struct PartitionNode {
  Bounds box;
  CellLook look;
  std::uint32_t lower_half = invalid_index;
  int axis = 0;
  double place = 0;

  bool is_leaf() const { return lower_half == invalid_index; }
};

/// A GridEdge is an edge of cells that no corner of a cell divides. It runs along an axis. The four
/// cells around it, in order about the axis, need not differ.
struct GridEdge {
  int axis = 0;
  Vec3 from{0, 0, 0};
  double to = 0;  ///< the coordinate along the axis
  std::array<std::uint32_t, 4> cells{};

  Vec3 end() const {
    Vec3 result = from;
    result[axis] = to;
    return result;
  }
};

class CellPartition {
 public:
  /// Starts with one cell. What is given must outlive it. A part of the surface may be as far from
  /// a plane as the deviation.
  CellPartition(const CellSolid& solid, double deviation, MeasureClock& clock);

  /// Divides cells until all are simple, or small. Returns false if there would be too many.
  bool refine();
  /// Why a cell is divided.
  enum class Aim : std::uint8_t {
    simple,   ///< its faces curve too much, or are opposite
    apart,    ///< its faces do not meet
    near,     ///< a triangle is not near the surface: no side is to become much shorter than others
    covered,  ///< its surface is not near the mesh, as in a narrow gap: the parts may be small
  };
  /// Divides a cell, unless it is small. Returns whether it did.
  bool divide(std::uint32_t number, Aim aim);

  const PartitionNode& node(std::uint32_t number) const { return nodes_[number]; }
  std::uint32_t node_count() const { return static_cast<std::uint32_t>(nodes_.size()); }
  /// Returns the program of what is open in a box.
  std::shared_ptr<const OpenProgram> program_in(const Bounds& box) const;
  /// Calls a function for each edge that has at least one open cell at its side.
  void for_each_edge(const std::function<void(const GridEdge&)>& visit) const;
  /// Returns whether a cell is too small to be divided, but where its surface is not covered.
  bool is_small(std::uint32_t number) const { return is_smaller(number, 0.4); }

 private:
  class EdgeWalk;

  bool is_smaller(std::uint32_t number, double share_of_deviation) const;
  bool is_simple(const PartitionNode& node) const;
  /// Adds a cell that waits to be looked at.
  void add(const Cell& cell);
  void look_at(std::uint32_t number);

  const CellSolid& solid_;
  double deviation_;
  MeasureClock& clock_;
  std::vector<PartitionNode> nodes_;
  std::vector<std::uint32_t> waiting_;  ///< cells that may not be simple
};

/// Cells beside narrow gaps are halved down to this share of the deviation.
inline constexpr double share_of_gap = 0.002;

/// Returns 1 if the solid is left where a function of its faces grows to above 0, -1 if it is
/// entered there, 0 if it depends on the other faces.
int sign_of_face(const CellLook& look, std::size_t face);

/// Returns a direction along which all faces of a look surely grow, or shrink if the solid is
/// entered where they do, as steeply as can be. There is none if faces are opposite, or curve too
/// much.
std::optional<Vec3> outward_direction(const CellLook& look);

/// Returns the unit vector that goes along with all of some unit vectors as far as can be.
Vec3 common_direction(std::span<const Vec3> normals);

/// Returns the axis along which a cell is best halved so that its faces curve less, or come apart.
/// Sides that are no longer than `least` are not halved while others are.
int dividing_axis(const CellSolid& solid, const Bounds& box, const CellLook& look,
                  bool takes_faces_apart, double least);

}  // namespace crt::core
