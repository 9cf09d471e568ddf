// What an oracle asks of the crossings of any solid.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/geometry/shape.hpp"

namespace crt::test {

/// Returns whether crossings enter and leave by turns, in order, and end outside.
inline bool take_turns(const core::CrossingList& found) {
  bool inside = false;
  for (const core::Crossing& crossing : found) {
    if (crossing.entering == inside || !std::isfinite(crossing.t)) return false;
    inside = crossing.entering;
  }
  return !inside && std::is_sorted(found.begin(), found.end(),
                                   [](const auto& a, const auto& b) { return a.t < b.t; });
}

}  // namespace crt::test
