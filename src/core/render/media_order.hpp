// This is the order of the solids around a ray. The innermost one decides what the ray is in.
//
// The inner one of two solids is that whose span of the ray's line lies within the other's span. If
// the spans are equal or merely overlap, it is the one written later. That does not depend on the
// sense in which the ray runs.
#pragma once

#include <cstddef>
#include <vector>

#include "core/base/sort_by_insertion.hpp"
#include "core/prepare/prepared_data.hpp"
#include "core/render/media.hpp"

namespace crt::core {

/// If more solids than this are around one point, or are entered at one place, the rest is left
/// out. Their cost grows with the square of their number.
inline constexpr std::size_t max_media_at_once = 256;

/// Returns whether crossings are at one place, which may be at infinity.
inline bool same_end(const RayHit& a, const RayHit& b) {
  return a.t == b.t || same_place(a, b);
}

/// Returns `list` once the ray has entered `medium`. `exit_of(object)` says where the ray's line
/// leaves a solid. It is called only if it is needed.
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

/// Sorts solids that are entered at one place by the order in which to enter them.
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
