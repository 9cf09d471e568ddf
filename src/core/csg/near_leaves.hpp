// The leaves of a CSG object that some rays come near are gathered here, with the nodes above them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/base/invalid_index.hpp"
#include "core/csg/enclosed_lines.hpp"
#include "core/csg/interval_filter.hpp"
#include "core/csg/program.hpp"
#include "core/csg/ray_steps.hpp"

namespace crt::core {

/// A NearLeaf is a leaf that some line comes near.
template <class Real>
struct NearLeaf {
  Enclosure<Real> interval;
  std::uint32_t leaf = 0;              ///< its number within the object
  std::uint32_t node = 0;              ///< the node above it
  std::uint32_t next = invalid_index;  ///< the next leaf below the same node
  bool complemented = false;
};

/// A NearNode is a node of the program above such leaves.
struct NearNode {
  bool all = false;            ///< whether it is true if all of its children are, else if any is
  std::uint32_t deciding = 0;  ///< its other children that alone decide its value
  std::uint32_t first_leaf = invalid_index;
  std::uint32_t last_leaf = invalid_index;
  std::uint32_t first_node = invalid_index;
  std::uint32_t last_node = invalid_index;
  std::uint32_t parent = invalid_index;
  std::uint32_t next = invalid_index;  ///< the next node below the same one
  bool is_on_path = false;             ///< for whoever follows a path up to the root
};

/// A NearLeavesWorkspace is memory that one thread reuses from ray to ray.
class NearLeavesWorkspace {
  template <class Real>
  friend class NearLeaves;

  /// A Slot is where a node of the program is among the nodes here.
  struct Slot {
    std::uint64_t stamp = 0;
    std::uint32_t node = 0;
  };
  /// An Opening is a box that some line enters at `enter`, and none before.
  struct Opening {
    double enter = 0;
    Bvh::Child child;
  };

  template <class Real>
  std::vector<NearLeaf<Real>>& leaves() {
    if constexpr (std::is_same_v<Real, double>) {
      return leaves_of_one_;
    } else {
      return leaves_of_lanes_;
    }
  }

  std::uint64_t stamp_ = 0;
  std::vector<Slot> slots_;
  std::vector<NearNode> nodes_;    ///< the root first
  std::vector<Opening> openings_;  ///< a heap, the nearest first
  std::vector<NearLeaf<double>> leaves_of_one_;
  std::vector<NearLeaf<Lanes>> leaves_of_lanes_;
};

/// NearLeaves gathers leaves in the order in which lines come to their boxes, as far as that is
/// asked for. That is up to the horizon, beyond which there may be more. All other leaves are
/// outside of their primitives up to there, as far as it matters.
template <class Real>
class NearLeaves {
 public:
  /// All arguments must outlive it, and `asked` has a bit for each line. All leaves of a small
  /// object are gathered at once, which costs less than their boxes.
  NearLeaves(const IntervalFilter& filter, const CsgProgram& program,
             const EnclosedLines<Real>& lines, std::uint32_t asked, NearLeavesWorkspace& workspace,
             const RaySteps& steps)
      : filter_(filter),
        program_(program),
        lines_(lines),
        asked_(asked),
        work_(workspace),
        leaves_(workspace.leaves<Real>()),
        steps_(steps),
        slabs_(slabs_of(lines.lines())) {
    ++work_.stamp_;
    if (work_.slots_.size() < program.nodes.size()) work_.slots_.resize(program.nodes.size());
    work_.nodes_.clear();
    work_.openings_.clear();
    slot_of(0);
    if (program.leaf_count() <= max_small) {
      add_all();
      link_added();
      return;
    }
    for (const std::uint32_t leaf : program.tree.unbounded()) add(leaf);
    link_added();
    if (program.tree.has_root()) put_off(Bvh::Child::node(0), -infinity);
  }

  /// Returns a node by its index, which is 0 for the root.
  NearNode& node(std::uint32_t index) { return work_.nodes_[index]; }
  std::span<NearLeaf<Real>> leaves() { return {leaves_.data(), count_}; }

  /// Returns the t beyond which there may be other leaves, or infinity if there are none.
  double horizon() const {
    return work_.openings_.empty() ? infinity : work_.openings_.front().enter;
  }

  /// Gathers `more` leaves if there are so many, and all that lines may come to up to t. It does
  /// not gather many more than a ray may come near.
  void gather(std::size_t more, double t) {
    const std::size_t enough = count_ + more;
    auto& openings = work_.openings_;
    while (!openings.empty() && (count_ < enough || openings.front().enter <= t)) {
      if (count_ > steps_.most()) break;
      const Bvh::Child child = openings.front().child;
      std::pop_heap(openings.begin(), openings.end(), is_later);
      openings.pop_back();
      if (++opened_ % steps_per_look == 0) [[unlikely]]
        steps_.poll();
      if (child.is_leaf()) {
        add(child.index());
      } else {
        program_.tree.for_each_child(child.index(), [&](Bvh::Child next, const Bounds& box) {
          const double enter = first_enter(box);
          if (enter < infinity) put_off(next, enter);
        });
      }
    }
    link_added();
  }

 private:
  /// An object with up to this many leaves is small.
  static constexpr std::uint32_t max_small = 32;

  static bool is_later(const NearLeavesWorkspace::Opening& a,
                       const NearLeavesWorkspace::Opening& b) {
    return a.enter > b.enter;
  }
  void put_off(Bvh::Child child, double enter) {
    work_.openings_.push_back({enter, child});
    std::push_heap(work_.openings_.begin(), work_.openings_.end(), is_later);
  }

  /// Slabs are those of one line, or nothing, as lines side by side have what it takes.
  using Slabs = std::conditional_t<std::is_same_v<Real, double>, RaySlabs, std::monostate>;
  static Slabs slabs_of(const FilterLine<Real>& line) {
    if constexpr (std::is_same_v<Real, double>) {
      const auto& [x, y, z] = line.origin;
      const auto& [dx, dy, dz] = line.direction;
      return RaySlabs({x, y, z}, {dx, dy, dz}, line.start_error);
    } else {
      return {};
    }
  }
  auto span_in(const Bounds& box) const {
    if constexpr (std::is_same_v<Real, double>) {
      return slabs_.span(box);
    } else {
      return RaySlabs::spans(lines_.lines(), box, asked_, lines_.lines().start_error);
    }
  }

  /// Returns where the first of the lines enters a box, or infinity if none does while it matters.
  double first_enter(const Bounds& box) const {
    const FilterLine<Real>& lines = lines_.lines();
    const auto part = span_in(box);
    const MaskOf<Real> near = part.enter <= part.leave && part.enter <= lines_.limits() &&
                              part.leave >= lines.begin - lines.start_error;
    return least(select(near && lines_.asked(), part.enter, broadcast<Real>(infinity)));
  }

  void add(std::uint32_t leaf) {
    if (count_ == leaves_.size()) leaves_.resize(2 * count_ + max_small);
    NearLeaf<Real>& near = leaves_[count_];
    if (!lines_.enclose(filter_.solid(leaf), near.interval)) return;
    near.leaf = leaf;
    ++count_;
  }

  void add_all() {
    if (leaves_.size() < program_.leaf_count()) leaves_.resize(max_small);
    for (std::uint32_t leaf = 0; leaf < program_.leaf_count(); ++leaf) add(leaf);
  }

  /// Links the leaves that were added to the nodes above them. It does so afterwards, so that the
  /// processor encloses several leaves at once.
  void link_added() {
    std::uint32_t node = invalid_index;
    std::uint32_t slot = invalid_index;
    for (; linked_ < count_; ++linked_) {
      NearLeaf<Real>& near = leaves_[linked_];
      if (const std::uint32_t above = program_.leaf_parents[near.leaf]; above != node) {
        node = above;
        slot = slot_of(node);
      }
      near.complemented = filter_.is_complemented(near.leaf);
      near.node = slot;
      near.next = invalid_index;
      NearNode& parent = work_.nodes_[slot];
      take(parent, near.complemented);
      const auto index = static_cast<std::uint32_t>(linked_);
      if (parent.first_leaf == invalid_index) {
        parent.first_leaf = index;
      } else {
        leaves_[parent.last_leaf].next = index;
      }
      parent.last_leaf = index;
    }
  }

  std::uint32_t slot_of(std::uint32_t node_index) {
    NearLeavesWorkspace::Slot& slot = work_.slots_[node_index];
    if (slot.stamp == work_.stamp_) return slot.node;
    const CsgNode& node = program_.nodes[node_index];
    const auto index = static_cast<std::uint32_t>(work_.nodes_.size());
    slot = {work_.stamp_, index};
    const bool all = node.needed > 1;
    work_.nodes_.push_back(
        {.all = all, .deciding = all ? node.needed - node.count_outside : node.count_outside});
    if (node_index == 0) return index;
    const std::uint32_t above = slot_of(node.parent);
    work_.nodes_[index].parent = above;
    NearNode& parent = work_.nodes_[above];
    take(parent, node.count_outside >= node.needed);
    if (parent.first_node == invalid_index) {
      parent.first_node = index;
    } else {
      work_.nodes_[parent.last_node].next = index;
    }
    parent.last_node = index;
    return index;
  }

  /// Takes a child out of those that decide a node. `value_outside` is the child's value where all
  /// leaves are outside.
  static void take(NearNode& node, bool value_outside) {
    if (value_outside != node.all) --node.deciding;
  }

  const IntervalFilter& filter_;
  const CsgProgram& program_;
  const EnclosedLines<Real>& lines_;
  std::uint32_t asked_;
  NearLeavesWorkspace& work_;
  std::vector<NearLeaf<Real>>& leaves_;  ///< at least count_ of them
  std::size_t count_ = 0;
  std::size_t linked_ = 0;
  const RaySteps& steps_;
  Slabs slabs_;
  std::uint64_t opened_ = 0;
};

}  // namespace crt::core
