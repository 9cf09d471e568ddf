// Sorting what is often little.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace crt::core {

/// Sorts; what is equal stays in order. Takes no memory for some dozens, which insertion sorts; for more it is
/// the sort that is made for them.
template <class Item, class Before>
void sort_stably(std::vector<Item>& items, const Before& is_before) {
  constexpr std::size_t few = 32;
  if (items.size() > few) {
    std::stable_sort(items.begin(), items.end(), is_before);
    return;
  }
  for (auto next = items.begin(); next != items.end(); ++next) {
    std::rotate(std::upper_bound(items.begin(), next, *next, is_before), next, next + 1);
  }
}

}  // namespace crt::core
