// A BVH over boxes is here, so that a ray asks only what it comes near: leaves of a CSG object, or
// triangles of a mesh.
//
// It has four boxes a node, in double precision. It is built by the surface area heuristic with
// bins (Wald, On fast construction of SAH-based bounding volume hierarchies, 2007), and then two
// levels become one.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/bounds.hpp"
#include "core/geometry/ray_slabs.hpp"
#include "core/tasks/workers.hpp"

namespace crt::core {

class Bvh {
 public:
  static constexpr std::size_t width = lane_count;

  /// A Child is a node of the tree or a leaf: one of the boxes, or several in order().
  class Child {
   public:
    static Child leaf(std::uint32_t index, std::uint32_t count = 1) {
      return Child(index | (count - 1) << count_place | leaf_bit);
    }
    static Child node(std::uint32_t index) { return Child(index); }
    Child() = default;

    bool is_leaf() const { return (bits_ & leaf_bit) != 0; }
    std::uint32_t index() const { return is_leaf() ? bits_ & (most_items - 1) : bits_; }
    std::uint32_t count() const { return 1 + (bits_ >> count_place & (most_a_leaf - 1)); }
    friend bool operator<(Child a, Child b) { return a.bits_ < b.bits_; }
    friend bool operator==(Child, Child) = default;

   private:
    static constexpr std::uint32_t leaf_bit = 0x80000000u;
    static constexpr std::uint32_t count_place = 28;
    explicit Child(std::uint32_t bits) : bits_(bits) {}
    std::uint32_t bits_ = 0;
  };

  /// There may be fewer boxes than this, and up to so many in a leaf.
  static constexpr std::uint32_t most_items = std::uint32_t{1} << 28;
  static constexpr std::uint32_t most_a_leaf = 8;

  Bvh() = default;
  /// Builds the tree over one box a leaf. Empty boxes are left out, and infinite ones are kept
  /// separately. The tree is always the same, whatever the number of `workers`.
  explicit Bvh(std::span<const Bounds> boxes, const Workers& workers = {})
      : Bvh(boxes, 1, workers) {}
  /// Builds a tree with up to `items_a_leaf` of the boxes in a leaf. If these are more than one, a
  /// leaf has Child::count() of them, which follow one another in order() from Child::index() on.
  Bvh(std::span<const Bounds> boxes, std::uint32_t items_a_leaf, const Workers& workers);

  /// Returns the leaves that a line may meet anywhere.
  std::span<const std::uint32_t> unbounded() const { return unbounded_; }
  /// Returns the numbers of the boxes as leaves of several name them.
  std::span<const std::uint32_t> order() const { return order_; }
  /// Returns the bytes of memory that it takes beside the object itself.
  std::size_t bytes() const {
    return nodes_.capacity() * sizeof(Node) +
           (unbounded_.capacity() + order_.capacity()) * sizeof(std::uint32_t);
  }
  bool has_root() const { return !nodes_.empty(); }

  /// Calls meet(child, enter) for what the line comes near below a node, within `part` of it.
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

  friend bool operator==(const Bvh&, const Bvh&) = default;

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
  std::vector<std::uint32_t> order_;  ///< empty where a leaf is one of the boxes
};

}  // namespace crt::core
