// Loops over many small items, and sorting, run on several threads. The result never depends on how
// many.
#pragma once

#include <algorithm>
#include <span>

#include "core/math/float_environment.hpp"
#include "core/tasks/tasks.hpp"
#include "core/tasks/workers.hpp"

namespace crt::core {

/// Fewer items than this, each of little work, are not worth another thread.
inline constexpr std::size_t items_for_a_thread = 4096;

/// Calls body(begin, end) for ranges that make up 0 ... count, as run_tasks() does. A single range
/// of up to `range_size` stays on this thread. The workers may be stopped between ranges.
template <class Body>
void for_ranges(std::size_t count, std::size_t range_size, const Workers& workers,
                const Body& body) {
  run_tasks((count + range_size - 1) / range_size, workers.threads, [&](std::size_t range) {
    const FloatEnvironment ieee;
    workers.poll();
    const std::size_t begin = range * range_size;
    body(begin, std::min(begin + range_size, count));
  });
}

/// Sorts one piece after the other. The work may be stopped between them.
template <class Item, class Less>
void sort_in_pieces(std::span<Item> items, const Workers& workers, const Less& less) {
  constexpr std::size_t largest_piece = std::size_t{1} << 19;
  workers.poll();
  if (items.size() <= largest_piece) {
    std::sort(items.begin(), items.end(), less);
    return;
  }
  const std::size_t half = items.size() / 2;
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                   less);
  sort_in_pieces(items.first(half), workers, less);
  sort_in_pieces(items.subspan(half), workers, less);
}

/// Sorts on several threads. No two items may be equal to `less`, so that there is one order only.
template <class Item, class Less>
void sort_in_parallel(std::span<Item> items, const Workers& workers, const Less& less) {
  std::size_t pieces = 1;
  const auto max_pieces = static_cast<std::size_t>(allowed_threads(workers.threads));
  while (pieces < max_pieces && items.size() / pieces > 2 * items_for_a_thread) pieces *= 2;
  const auto border = [&](std::size_t piece) {
    return items.begin() + static_cast<std::ptrdiff_t>(items.size() * piece / pieces);
  };
  run_tasks(pieces, workers.threads, [&](std::size_t piece) {
    sort_in_pieces(std::span<Item>(border(piece), border(piece + 1)), workers, less);
  });
  for (std::size_t merged = 1; merged < pieces; merged *= 2) {
    run_tasks(pieces / (2 * merged), workers.threads, [&](std::size_t pair) {
      workers.poll();
      const std::size_t first = 2 * merged * pair;
      std::inplace_merge(border(first), border(first + merged), border(first + 2 * merged), less);
    });
  }
}

}  // namespace crt::core
