// Winding numbers along a line say what is inside of meshes whose parts overlap. This is a part of
// find_met_triangles.hpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "core/geometry/mesh/find_met_triangles.hpp"
#include "core/geometry/mesh/met_triangles.hpp"

namespace crt::core {

/// Returns the winding number before the first crossing. That after a start is as the crossings
/// ahead have it. Before it the line is on the other side, whatever rounding has made of the
/// crossings there.
template <class Triangles>
int MetTriangles<Triangles>::winding_at_begin() const {
  const int at_begin = rest_winding_ - turns_of(std::span(first(), list_.end()));
  const auto start = std::find_if(
      first(), list_.end(), [this](const Crossing& crossing) { return starts_on(crossing.face); });
  if (start == list_.end()) return at_begin;
  int behind = 0;
  int after = rest_winding_;
  for (auto met = first(); met != list_.end(); ++met) {
    const int place = order(*met, *start);
    if (place < 0) behind += met->entering ? 1 : -1;
    if (place > 0) after -= met->entering ? 1 : -1;
  }
  if (is_inside(at_begin + behind) != is_inside(after)) return at_begin;
  return (is_inside(after) ? 0 : 1) - behind;
}

/// Drops gaps that there may not be: where rounding may have put the end of one part before the
/// begin of the next, though they touch or overlap. In the exact tier there are none.
template <class Triangles>
void MetTriangles<Triangles>::close_gaps() {
  auto kept = first();
  for (auto met = first(); met != list_.end(); ++met) {
    if (kept != first() && met->entering) {
      const Crossing& before = *(kept - 1);
      const double reach =
          std::min(before.error, max_overlap_) + std::min(met->error, max_overlap_);
      if (!starts_on(before.face) && !starts_on(met->face) && met->t - before.t <= reach &&
          tier_.may_be_out_of_order()) {
        --kept;
        continue;
      }
    }
    *kept++ = *met;
  }
  list_.erase(kept, list_.end());
}

/// Returns whether the line is inside where it leaves its start, as the crossings ahead have it.
template <class Triangles>
bool MetTriangles<Triangles>::is_inside_ahead() const {
  int winding = mesh_.counts_windings() ? rest_winding_ : (rest_is_odd_ ? 1 : 0);
  for (auto met = first(); met != list_.end(); ++met) {
    if (met->t > 0 && !starts_on(met->face)) winding -= met->entering ? 1 : -1;
  }
  return is_inside(winding);
}

/// Returns the nearest crossing that rounding may have put on the other side of the origin.
template <class Triangles>
typename MetTriangles<Triangles>::Place MetTriangles<Triangles>::nearest_through_origin() {
  auto nearest = list_.end();
  for (auto met = first(); met != list_.end(); ++met) {
    if (starts_on(met->face) || !is_through_origin(*met)) continue;
    if (nearest == list_.end() || std::abs(met->t) < std::abs(nearest->t)) nearest = met;
  }
  return nearest;
}

}  // namespace crt::core
