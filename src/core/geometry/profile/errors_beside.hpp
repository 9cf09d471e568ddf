// Where a line crosses several walls nearly in one place, rounding may take one for another. The
// errors of their crossings cover that.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/geometry/shape.hpp"

namespace crt::core {

/// Corrects the error of a crossing so near to another one that this may be meant.
inline void bound_by(const Crossing& other, Crossing& crossing) {
  const double gap = std::abs((other.t - crossing.t) + (other.t_low - crossing.t_low));
  if (!(gap <= crossing.error + other.error)) return;
  crossing.error = std::max(crossing.error, gap + other.error);
}

/// Corrects the error of a crossing by the walls that are crossed in its place, from `begin` to
/// `end`, and by those before and after it.
template <class Walls, class Place>
void bound_beside(const Walls& walls, Place begin, Place end, double largest_error,
                  Crossing& crossing) {
  for (auto here = begin; here != end; ++here) bound_by(here->crossing, crossing);
  const double farthest = crossing.error + largest_error;
  while (begin != walls.begin() && crossing.t - (--begin)->crossing.t <= farthest) {
    bound_by(begin->crossing, crossing);
  }
  for (; end != walls.end() && end->crossing.t - crossing.t <= farthest; ++end) {
    bound_by(end->crossing, crossing);
  }
}

}  // namespace crt::core
