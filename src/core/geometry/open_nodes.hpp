// A line goes through a tree over many items, depth first.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/bvh.hpp"

namespace crt::core {

/// OpenNodes are the nodes of a tree that are still to be looked at, with what is known of each.
/// They allocate only for trees that are far deeper than `usual` ones.
template <class Node, std::size_t usual>
class OpenNodes {
 public:
  bool empty() const { return count_ == 0; }
  std::size_t count() const { return count_; }
  void push(const Node& node) {
    if (count_ < first_.size()) {
      first_[count_] = node;
    } else {
      more_.push_back(node);
    }
    ++count_;
  }
  Node pop() {
    --count_;
    if (count_ < first_.size()) return first_[count_];
    const Node node = more_.back();
    more_.pop_back();
    return node;
  }
  /// Returns the nodes that were pushed from `begin` on, or none if there are more than usual.
  std::span<Node> from(std::size_t begin) {
    if (count_ > first_.size()) return {};
    return std::span(first_).first(count_).subspan(begin);
  }

 private:
  std::array<Node, usual> first_;
  std::size_t count_ = 0;
  std::vector<Node> more_;
};

/// Calls meet(items) for each leaf that a line comes near within `part` of it, with what is in the
/// leaf. The tree must have a root and several items a leaf.
template <class Meet>
void for_leaves(const Bvh& tree, const RaySlabs& slabs, const LineSpan& part, const Meet& meet) {
  OpenNodes<std::uint32_t, 128> open;
  open.push(0);
  while (!open.empty()) {
    tree.visit(open.pop(), slabs, part, [&](Bvh::Child child, double) {
      if (child.is_leaf()) {
        meet(tree.order().subspan(child.index(), child.count()));
      } else {
        open.push(child.index());
      }
    });
  }
}

}  // namespace crt::core
