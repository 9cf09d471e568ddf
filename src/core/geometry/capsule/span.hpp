// The spans that a line has in common with the parts of a capsule are put together here, in both
// tiers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/geometry/shape.hpp"

namespace crt::core {

/// A CapsuleSpan is what of a line is inside a capsule, or inside one of its parts. Part 0 is the
/// cylinder, parts 1 and 2 are the spheres. Ends have the faces of the capsule: a cap of the
/// cylinder lies within the half sphere of that number.
struct CapsuleSpan {
  bool found = false;
  Crossing enter;
  Crossing leave{.face = invalid_index};  ///< has no face if it was left out, as nobody asks for it
};

/// Returns where a ray starts, as a part has it. The surface of a part has the number 0 there.
inline FaceStart start_on_part(FaceStart start, std::uint32_t part) {
  start.face = start.face == part ? 0 : invalid_index;
  return start;
}

/// Takes the crossings of a part off a list that had `size` of others before.
inline CapsuleSpan take_span(CrossingList& list, std::size_t size, std::uint32_t part) {
  CapsuleSpan span;
  const std::size_t count = list.size() - size;
  span.found = count > 0;
  if (count > 0) span.enter = list[size];
  if (count > 1) span.leave = list[size + 1];
  list.resize(size);
  if (part == 0) return span;
  if (count > 0) span.enter.face = part;
  if (count > 1) span.leave.face = part;
  return span;
}

inline bool is_before(const Crossing& a, const Crossing& b) {
  return a.t < b.t || (a.t == b.t && a.t_low < b.t_low);
}

/// Returns the span from the first entry to the last exit. As a capsule is convex, its parts leave
/// no gap in between.
inline CapsuleSpan united(const std::array<CapsuleSpan, 3>& parts) {
  CapsuleSpan whole = parts[0];
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const CapsuleSpan& part = parts[i];
    if (!part.found) continue;
    if (!whole.found) {
      whole = part;
      continue;
    }
    if (is_before(part.enter, whole.enter)) whole.enter = part.enter;
    if (is_before(whole.leave, part.leave)) whole.leave = part.leave;
  }
  return whole;
}

/// Makes the span of a ray that starts on a face begin or end there, whatever rounding says next to
/// a seam. `shortest` is the length in t that remains for a ray that starts into the solid, if
/// rounding would have it leave at once.
inline void begin_at_start(const FaceStart& start, double shortest, CapsuleSpan& span) {
  const bool leaves = start.side == Side::outside;
  const Crossing here{.face = start.face, .root = static_cast<std::uint8_t>(leaves ? 1 : 0)};
  if (leaves) {
    span.found = span.found && span.enter.t < 0;
    span.leave = here;
    return;
  }
  if (!span.found || !(span.leave.t > 0)) {
    span.leave = {.t = shortest, .face = start.face, .root = 1};
  }
  span.enter = here;
  span.found = span.leave.t > 0;
}

/// Appends the ends of a span.
inline void append(CapsuleSpan span, CrossingList& out) {
  if (!span.found) return;
  span.enter.entering = true;
  span.leave.entering = false;
  out.push_back(span.enter);
  out.push_back(span.leave);
}

}  // namespace crt::core
