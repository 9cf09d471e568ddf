#include "core/measure/cell_tree.hpp"

#include "core/measure/cell_reach.hpp"

namespace crt::core {

CellTree::CellTree(const EntityCells& entity) : solids_(entity.solids()) {
  for (std::uint32_t i = 0; i < solids_.size(); ++i)
    add(solids_[i].cell(first_box(solids_[i].bounds())), i);
  root_count_ = static_cast<std::uint32_t>(nodes_.size());
}

void CellTree::add(Cell&& cell, std::uint32_t object) {
  CellLook look = solids_[object].look(cell);
  if (look.program) cell.program = look.program;
  nodes_.push_back({.cell = std::move(cell), .object = object, .look = std::move(look)});
}

void CellTree::divide(std::uint32_t number) {
  if (nodes_[number].first_part != invalid_index) return;
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  if (nodes_[number].look.is_open()) {
    const Cell whole = nodes_[number].cell;
    const std::vector<Bounds> boxes = halves_of(whole.box);
    if (boxes.size() > 1) {
      for (const Bounds& box : boxes) add({box, whole.program}, nodes_[number].object);
    }
  }
  nodes_[number].first_part = first;
  nodes_[number].part_count = static_cast<std::uint32_t>(nodes_.size()) - first;
}

}  // namespace crt::core
