#include "core/measure/cell_tree.hpp"

#include "core/measure/cell_reach.hpp"
#include "core/measure/measure_clock.hpp"

namespace crt::core {

CellTree::CellTree(const EntityCells& entity) : solids_(entity.solids()) {
  for (std::uint32_t i = 0; i < solids_.size(); ++i)
    add(solids_[i].cell(first_box(solids_[i].bounds())), i);
  root_count_ = static_cast<std::uint32_t>(nodes_.size());
}

void CellTree::add(Cell&& cell, std::uint32_t object) {
  looks_ += cell.program->leaves.size() + looks_of_cell;
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

Cell CellTree::cell(std::uint32_t object, const Bounds& box) const {
  const auto has_box = [&](std::uint32_t number) {
    const Bounds& around = nodes_[number].cell.box;
    for (int axis = 0; axis < 3; ++axis)
      if (box.lower[axis] < around.lower[axis] || box.upper[axis] > around.upper[axis])
        return false;
    return true;
  };
  std::uint32_t number = object;
  if (!has_box(number)) return solids_[object].cell(box);
  for (bool is_smaller = true; is_smaller;) {
    const Node& node = nodes_[number];
    is_smaller = false;
    for (std::uint32_t i = 0; i < node.part_count && !is_smaller; ++i) {
      is_smaller = has_box(node.first_part + i);
      if (is_smaller) number = node.first_part + i;
    }
  }
  return {box, nodes_[number].cell.program};
}

}  // namespace crt::core
