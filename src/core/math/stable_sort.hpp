// Sorting what is often little.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

namespace crt::core {

/// Sorts; what is equal stays in order. Takes no memory for some dozens, which insertion sorts; for
/// more it is the sort that is made for them.
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
