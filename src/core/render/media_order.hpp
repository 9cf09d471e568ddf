// Which of the solids around a ray decides.
//
// Of two solids the inner one is that whose stretch of the ray's line lies within the other's
// stretch; if the spans are equal or merely overlap, the one written later is. That does not depend
// on the sense in which the ray runs. The innermost decides.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/prepare/prepared_data.hpp"
#include "core/render/media.hpp"

namespace crt::core {

/// Of more solids than this around one point, or entered at one place, the rest is left out: what
/// many of them cost grows with the square of their number.
inline constexpr std::size_t most_media_at_once = 256;

/// Whether crossings are at one place, be it at infinity.
inline bool same_end(const RayHit& a, const RayHit& b) {
  return a.t == b.t || same_place(a, b);
}

/// `list` once the ray has entered `medium`. `exit_of(object)` says where the ray's line leaves a
/// solid; it is asked only if need be.
template <class ExitOf>
MediaLists::List entered_in_order(MediaLists& media, MediaLists::List list, const Medium& medium,
                                  const ExitOf& exit_of) {
  return media.entered(list, medium, [&](std::uint32_t around) {
    if (medium.object > around) return true;
    const RayHit own = exit_of(medium.object);
    const RayHit other = exit_of(around);
    return own.t < other.t || same_end(own, other);
  });
}

/// Sorts by insertion, which needs no strict order: two ends that both are at one place with a
/// third need not be so themselves.
template <class Item, class ComesFirst>
void sort_by_insertion(std::vector<Item>& items, const ComesFirst& comes_first) {
  for (std::size_t i = 1; i < items.size(); ++i) {
    for (std::size_t k = i; k > 0 && comes_first(items[k], items[k - 1]); --k) {
      std::swap(items[k], items[k - 1]);
    }
  }
}

/// Brings solids that are entered at one place into the order in which to enter them.
template <class ExitOf>
void sort_outermost_first(std::vector<RayHit>& entered, const ExitOf& exit_of) {
  if (entered.size() < 2) return;
  struct Span {
    RayHit enter;
    RayHit exit;
  };
  std::vector<Span> spans;
  spans.reserve(entered.size());
  for (const RayHit& enter : entered) spans.push_back({enter, exit_of(enter.object)});
  sort_by_insertion(spans, [](const Span& a, const Span& b) {
    return same_end(a.exit, b.exit) ? a.enter.object < b.enter.object : a.exit.t > b.exit.t;
  });
  for (std::size_t i = 0; i < entered.size(); ++i) entered[i] = spans[i].enter;
}

}  // namespace crt::core
