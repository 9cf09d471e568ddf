// Crossings of one line are ordered by where they are.
#pragma once

#include <cmath>

#include "core/geometry/shape.hpp"

namespace crt::core {

/// Returns the sign of the place of a crossing less that of another. Where their errors do not tell
/// the two apart, decide(a, b) does. But t of the start is exact: it decides if starts_on(face) of
/// either is true. An infinite t may be of no face, and nothing is asked about it.
template <class StartsOn, class Decide>
int order_of_places(const Crossing& a, const Crossing& b, const StartsOn& starts_on,
                    const Decide& decide) {
  const auto compared = [](double x, double y) { return x < y ? -1 : (x > y ? 1 : 0); };
  if (!std::isfinite(a.t) || !std::isfinite(b.t)) return compared(a.t, b.t);
  const double distance = (a.t - b.t) + (a.t_low - b.t_low);
  const bool is_start = starts_on(a.face) || starts_on(b.face);
  if (!is_start && std::abs(distance) <= a.error + b.error) return decide(a, b);
  return compared(distance, 0);
}

}  // namespace crt::core
