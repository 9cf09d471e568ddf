// A BVH over boxes is here, so that a ray asks only what it comes near: leaves of a CSG object, or
// triangles of a mesh.
//
// It is built by the surface area heuristic with bins (Wald, On fast construction of SAH-based
// bounding volume hierarchies, 2007), and then some levels become one. A tree of PlainNodes has
// four boxes a node, in double precision. One of CompactNodes (compact_bvh.hpp) has eight, in
// little memory.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/geometry/bounds.hpp"
#include "core/geometry/ray_slabs.hpp"
#include "core/tasks/workers.hpp"

namespace crt::core {

/// A BvhChild is a node of a tree or a leaf: one of the boxes, or several in order(). A
/// BvhChild() is the root, which is no child.
class BvhChild {
 public:
  /// There may be fewer boxes than this, and up to so many in a leaf.
  static constexpr std::uint32_t max_items = std::uint32_t{1} << 28;
  static constexpr std::uint32_t max_a_leaf = 8;

  static BvhChild leaf(std::uint32_t index, std::uint32_t count = 1) {
    return BvhChild(index | (count - 1) << count_place | leaf_bit);
  }
  static BvhChild node(std::uint32_t index) { return BvhChild(index); }
  BvhChild() = default;

  bool is_leaf() const { return (bits_ & leaf_bit) != 0; }
  std::uint32_t index() const { return is_leaf() ? bits_ & (max_items - 1) : bits_; }
  std::uint32_t count() const { return 1 + (bits_ >> count_place & (max_a_leaf - 1)); }
  friend bool operator<(BvhChild a, BvhChild b) { return a.bits_ < b.bits_; }
  friend bool operator==(BvhChild, BvhChild) = default;

 private:
  static constexpr std::uint32_t leaf_bit = 0x80000000u;
  static constexpr std::uint32_t count_place = 28;
  explicit BvhChild(std::uint32_t bits) : bits_(bits) {}
  std::uint32_t bits_;
};

/// A PlainNode has four boxes in double.
struct alignas(32) PlainNode {
  static constexpr std::size_t width = lane_count;

  RaySlabs::Corners lower{};
  RaySlabs::Corners upper{};
  std::array<BvhChild, width> children{};
  std::uint32_t count = 0;

  PlainNode() = default;
  PlainNode(std::span<const Bounds> boxes, std::span<const BvhChild> of_boxes);

  /// Calls meet(child, enter) for what the line comes near within `part` of it.
  template <class Meet>
  void visit(const RaySlabs& slabs, const LineSpan& part, const Meet& meet) const {
    const LineSpanLanes spans = slabs.spans(lower, upper);
    const LaneMask near =
        (spans.enter <= spans.leave) & (spans.leave >= part.enter) & (spans.enter <= part.leave);
    for (std::uint32_t met = mask_of(near) & ((1u << count) - 1); met != 0; met &= met - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(met));
      meet(children[i], spans.enter[i]);
    }
  }

  Bounds box(std::size_t i) const {
    return {{lower[0][i], lower[1][i], lower[2][i]}, {upper[0][i], upper[1][i], upper[2][i]}};
  }

  friend bool operator==(const PlainNode&, const PlainNode&) = default;
};

/// A BvhOf has nodes of one kind.
template <class Node>
class BvhOf {
 public:
  using Child = BvhChild;

  BvhOf() = default;
  /// Builds the tree over one box a leaf. Empty boxes are left out, and infinite ones are kept
  /// separately. The tree is always the same, whatever the number of `workers`.
  explicit BvhOf(std::span<const Bounds> boxes, const Workers& workers = {})
      : BvhOf(boxes, 1, workers) {}
  /// Builds a tree with up to `items_a_leaf` of the boxes in a leaf. If these are more than one, a
  /// leaf has Child::count() of them, which follow one another in order() from Child::index() on.
  BvhOf(std::span<const Bounds> boxes, std::uint32_t items_a_leaf, const Workers& workers);

  /// Returns the leaves that a line may meet anywhere.
  std::span<const std::uint32_t> unbounded() const { return unbounded_; }
  /// Returns the numbers of the boxes as leaves of several name them.
  std::span<const std::uint32_t> order() const { return order_; }
  /// Returns order(), which then is gone.
  std::vector<std::uint32_t> take_order() { return std::move(order_); }
  /// Returns the bytes of memory that it takes beside the object itself.
  std::size_t bytes() const {
    return nodes_.capacity() * sizeof(Node) +
           (unbounded_.capacity() + order_.capacity()) * sizeof(std::uint32_t);
  }
  bool has_root() const { return !nodes_.empty(); }

  /// Calls meet(child, enter) for what the line comes near below a node, within `part` of it.
  template <class Slabs, class Meet>
  void visit(std::uint32_t node_index, const Slabs& slabs, const LineSpan& part,
             const Meet& meet) const {
    nodes_[node_index].visit(slabs, part, meet);
  }

  /// Fetches beforehand what visit() looks at, if the child is a node.
  void prefetch(Child child) const {
    if (!child.is_leaf()) __builtin_prefetch(&nodes_[child.index()]);
  }

  /// Calls use(child, box) for each child of a node.
  template <class Use>
  void for_each_child(std::uint32_t node_index, const Use& use) const {
    const Node& node = nodes_[node_index];
    for (std::size_t i = 0; i < Node::width && node.children[i] != Child(); ++i) {
      use(node.children[i], node.box(i));
    }
  }

  /// Calls use(child) for each child of a node that touches a box, or that may touch it.
  template <class Use>
  void for_each_touching(std::uint32_t node_index, const Bounds& box, const Use& use) const {
    const Node& node = nodes_[node_index];
    for (std::uint32_t left = node.touching(box); left != 0; left &= left - 1) {
      const Child child = node.children[static_cast<std::size_t>(std::countr_zero(left))];
      if (child != Child()) use(child);
    }
  }

  friend bool operator==(const BvhOf&, const BvhOf&) = default;

 private:
  class Builder;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> unbounded_;
  std::vector<std::uint32_t> order_;  ///< empty where a leaf is one of the boxes
};

using Bvh = BvhOf<PlainNode>;

}  // namespace crt::core
