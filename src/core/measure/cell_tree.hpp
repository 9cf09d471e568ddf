// A cell tree keeps what is known of cells that several questions look into. It grows as it is
// asked. One thread uses it.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/base/invalid_index.hpp"
#include "core/measure/entity_cells.hpp"

namespace crt::core {

class CellTree {
 public:
  struct Node {
    Cell cell;
    std::uint32_t object = 0;
    CellLook look;
    std::uint32_t first_part = invalid_index;  ///< of part_count, once it is divided
    std::uint32_t part_count = 0;
  };

  /// The entity must outlive it.
  explicit CellTree(const EntityCells& entity);

  /// There is a root for each object of the entity.
  std::uint32_t root_count() const { return root_count_; }
  /// The node is there until others are divided.
  const Node& node(std::uint32_t number) const { return nodes_[number]; }
  /// Divides a node into those that follow `first_part`. There are none if it cannot be divided, or
  /// if nothing crosses it.
  void divide(std::uint32_t number);
  /// Returns a cell of an object, with what is open of its program in the smallest node around it.
  Cell cell(std::uint32_t object, const Bounds& box) const;
  std::size_t size() const { return nodes_.size(); }
  /// Returns how many looks at leaves there were since it was last asked, with those for the cells
  /// themselves.
  std::uint64_t take_looks() { return std::exchange(looks_, 0); }

 private:
  void add(Cell&& cell, std::uint32_t object);

  std::span<const CellSolid> solids_;
  std::vector<Node> nodes_;
  std::uint32_t root_count_ = 0;
  std::uint64_t looks_ = 0;
};

}  // namespace crt::core
