// A BVH that takes little memory is here, for the triangles of a mesh.
#pragma once

#include "core/geometry/bvh.hpp"
#include "core/geometry/grid_boxes.hpp"

namespace crt::core {

/// A CompactNode has eight boxes on a grid.
struct alignas(64) CompactNode {
  static constexpr std::size_t width = GridBoxes::most;

  GridBoxes boxes;
  std::array<BvhChild, width> children{};

  CompactNode() = default;
  CompactNode(std::span<const Bounds> some, std::span<const BvhChild> of_boxes);

  /// Calls meet(child, enter) as a PlainNode does, with `part` and `enter` in units of s.
  template <class Meet>
  void visit(const GridSlabs& slabs, const LineSpan& part, const Meet& meet) const {
    std::array<double, width> enters;
    for (std::uint32_t met = slabs.meet(boxes, part.enter, part.leave, enters); met != 0;
         met &= met - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(met));
      if (children[i] != BvhChild()) meet(children[i], enters[i]);
    }
  }

  Bounds box(std::size_t i) const { return boxes.box(i); }
  std::uint32_t touching(const Bounds& other) const { return boxes.touching(other); }

  friend bool operator==(const CompactNode&, const CompactNode&) = default;
};

using CompactBvh = BvhOf<CompactNode>;

}  // namespace crt::core
