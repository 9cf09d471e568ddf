// Few items are sorted by insertion.
#pragma once

#include <cstddef>
#include <utility>

namespace crt::core {

/// Sorts a vector or a span by insertion, which needs no strict order: if two items are equal to a
/// third, they need not be equal themselves.
template <class Items, class ComesFirst>
void sort_by_insertion(Items&& items, const ComesFirst& comes_first) {
  for (std::size_t i = 1; i < items.size(); ++i) {
    auto item = std::move(items[i]);
    std::size_t place = i;
    for (; place > 0 && comes_first(item, items[place - 1]); --place) {
      items[place] = std::move(items[place - 1]);
    }
    items[place] = std::move(item);
  }
}

}  // namespace crt::core
