// A tree of boxes over the leaves of a CSG object, so that a ray asks only those that it comes
// near.
//
// Four boxes a node, in double precision, built by the surface area heuristic with bins (Wald, On
// fast construction of SAH-based bounding volume hierarchies, 2007) and then two levels in one.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "core/csg/ray_slabs.hpp"
#include "core/geometry/bounds.hpp"
#include "core/tasks/workers.hpp"

namespace crt::core {

class LeafBvh {
 public:
  static constexpr std::size_t width = lane_count;

  /// A node of the tree or a leaf of the object.
  class Child {
   public:
    static Child leaf(std::uint32_t index) { return Child(index | leaf_bit); }
    static Child node(std::uint32_t index) { return Child(index); }
    Child() = default;

    bool is_leaf() const { return (bits_ & leaf_bit) != 0; }
    std::uint32_t index() const { return bits_ & ~leaf_bit; }
    friend bool operator<(Child a, Child b) { return a.bits_ < b.bits_; }
    friend bool operator==(Child, Child) = default;

   private:
    static constexpr std::uint32_t leaf_bit = 0x80000000u;
    explicit Child(std::uint32_t bits) : bits_(bits) {}
    std::uint32_t bits_ = 0;
  };

  LeafBvh() = default;
  /// Over one box a leaf. Empty boxes are left out; infinite ones are kept apart. Built on up to
  /// `threads` threads (as run_tasks() has it); the tree is always the same.
  explicit LeafBvh(std::span<const Bounds> boxes, const Workers& workers = {});

  /// The leaves that a line may meet anywhere.
  std::span<const std::uint32_t> unbounded() const { return unbounded_; }
  /// Of memory, beside the object itself.
  std::size_t bytes() const {
    return nodes_.capacity() * sizeof(Node) + unbounded_.capacity() * sizeof(std::uint32_t);
  }
  bool has_root() const { return !nodes_.empty(); }

  /// Calls meet(child, enter) for what the line comes near below a node, within that part of it.
  template <class Meet>
  void visit(std::uint32_t node_index, const RaySlabs& slabs, const LineSpan& part,
             const Meet& meet) const {
    const Node& node = nodes_[node_index];
    const LineSpanLanes spans = slabs.spans(node.lower, node.upper);
    const LaneMask near =
        (spans.enter <= spans.leave) & (spans.leave >= part.enter) & (spans.enter <= part.leave);
    for (std::uint32_t met = mask_of(near) & ((1u << node.count) - 1); met != 0; met &= met - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(met));
      meet(node.children[i], spans.enter[i]);
    }
  }

  /// Calls use(child, box) for each child of a node.
  template <class Use>
  void for_each_child(std::uint32_t node_index, const Use& use) const {
    const Node& node = nodes_[node_index];
    for (std::size_t i = 0; i < node.count; ++i) {
      use(node.children[i], Bounds{{node.lower[0][i], node.lower[1][i], node.lower[2][i]},
                                   {node.upper[0][i], node.upper[1][i], node.upper[2][i]}});
    }
  }

  friend bool operator==(const LeafBvh&, const LeafBvh&) = default;

 private:
  struct alignas(32) Node {
    std::array<std::array<double, width>, 3> lower{};  ///< by axis
    std::array<std::array<double, width>, 3> upper{};
    std::array<Child, width> children;
    std::uint32_t count = 0;

    friend bool operator==(const Node&, const Node&) = default;
  };

  class Builder;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> unbounded_;
};

}  // namespace crt::core
