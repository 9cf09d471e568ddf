// A line goes through a tree over many items, depth first.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/bvh.hpp"

namespace crt::core {

/// OpenNodes are the nodes of a tree that are still to be looked at. They allocate only for trees
/// that are far deeper than usual.
class OpenNodes {
 public:
  bool empty() const { return count_ == 0; }
  void push(std::uint32_t node) {
    if (count_ < first_.size()) {
      first_[count_] = node;
    } else {
      more_.push_back(node);
    }
    ++count_;
  }
  std::uint32_t pop() {
    --count_;
    if (count_ < first_.size()) return first_[count_];
    const std::uint32_t node = more_.back();
    more_.pop_back();
    return node;
  }

 private:
  std::array<std::uint32_t, 128> first_;
  std::size_t count_ = 0;
  std::vector<std::uint32_t> more_;
};

/// Calls meet(items) for each leaf that a line comes near within `part` of it, with what is in the
/// leaf. `meet` may narrow `part`. The tree must have a root and several items a leaf.
template <class Meet>
void for_leaves(const Bvh& tree, const RaySlabs& slabs, const LineSpan& part, const Meet& meet) {
  OpenNodes open;
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
