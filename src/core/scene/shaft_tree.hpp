// A tree of boxes that all rays of a packet go down together.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "core/scene/shaft.hpp"

namespace crt::core {

/// Four boxes that follow each other are the children of a node, four such nodes that of another, and so
/// forth: what is where need not be written down. It does for packets whose rays keep together what
/// EmbreeTree does for any.
class ShaftTree {
 public:
  ShaftTree() = default;
  /// Of finite boxes, in an order in which neighbours are near each other; at most 2^30.
  explicit ShaftTree(std::span<const Bounds> boxes);

  std::uint64_t bytes() const { return nodes_.capacity() * sizeof(BoxLanes); }

  /// Visits, roughly from near to far, at least every box that one of the rays of a shaft meets. visit(box)
  /// may bring the shaft's end nearer.
  template <class Visit>
  void traverse(const Shaft& shaft, const Visit& visit) const {
    std::array<Entry, most_entries> entries;
    std::size_t count = 0;
    if (level_count_ > 0) entries[count++] = {0, 0, level_count_};
    while (count > 0) {
      const Entry entry = entries[--count];
      if (entry.begin > shaft.end()) continue;
      if (entry.level == 0) {
        visit(entry.index);
      } else {
        count = open(entry, shaft, entries, count);
      }
    }
  }

 private:
  /// A node of a level; at level 0 a box.
  struct Entry {
    double begin;  ///< along the shaft
    std::uint32_t index;
    std::uint32_t level;
  };
  static constexpr std::size_t most_levels = 15;
  static constexpr std::size_t most_entries = most_levels * (lane_count - 1) + 1;

  /// Puts the children of a node that a shaft meets onto a stack, the nearest last.
  std::size_t open(const Entry& node, const Shaft& shaft, std::array<Entry, most_entries>& entries,
                   std::size_t count) const {
    Lanes begin;
    const std::uint32_t met = shaft.meets(nodes_[level_begin_[node.level - 1] + node.index], begin);
    const std::size_t bottom = count;
    for (std::uint32_t rest = met; rest != 0; rest &= rest - 1) {
      const int lane = std::countr_zero(rest);
      const Entry child = {begin[lane], node.index * lane_count + static_cast<std::uint32_t>(lane),
                           node.level - 1};
      std::size_t place = count++;
      for (; place > bottom && entries[place - 1].begin < child.begin; --place) {
        entries[place] = entries[place - 1];
      }
      entries[place] = child;
    }
    return count;
  }

  std::vector<BoxLanes> nodes_;  ///< level by level, the lowest first
  std::array<std::uint32_t, most_levels> level_begin_{};
  std::uint32_t level_count_ = 0;
};

}  // namespace crt::core
