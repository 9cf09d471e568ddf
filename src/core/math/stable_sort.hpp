// Lists that are mostly short are sorted without taking memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

namespace crt::core {

/// Sorts and keeps the order of equal items. Up to 32 items take an insertion sort, which needs no
/// memory. More take the standard library's stable sort.
template <class Item, class Before>
void sort_stably(std::vector<Item>& items, const Before& is_before) {
  constexpr std::size_t few = 32;
  if (items.size() > few) {
    std::stable_sort(items.begin(), items.end(), is_before);
    return;
  }
  for (std::size_t i = 1; i < items.size(); ++i) {
    const auto next = items.begin() + static_cast<std::ptrdiff_t>(i);
    if (!is_before(*next, *std::prev(next))) continue;
    std::rotate(std::upper_bound(items.begin(), next, *next, is_before), next, next + 1);
  }
}

}  // namespace crt::core
