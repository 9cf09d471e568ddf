// Where a line crosses several walls nearly in one place, rounding may take one for another. The
// errors of their crossings cover that. A wall that the line is all but parallel to is not meant:
// its error may be longer than the solid, and says nothing of what else is there.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/geometry/shape.hpp"
#include "core/math/lanes.hpp"

namespace crt::core {

/// A LongestError tells errors that rounding leaves next to a corner from those of walls that the
/// line is all but parallel to.
class LongestError {
 public:
  /// `shortest` is the length in t of the shortest part of a line in the solid: the rounding of its
  /// size.
  explicit LongestError(double shortest) : longest_(roundings * shortest) {}

  bool is_exceeded_by(const Crossing& crossing) const {
    return !(crossing.error <= longest_ + 2 * rounding_of(crossing.t));
  }

 private:
  static constexpr double roundings = 0x1p33;

  double longest_;
};

/// Corrects the error of a crossing so near to another one that this may be meant.
inline void bound_by(const Crossing& other, const LongestError& longest, Crossing& crossing) {
  if (longest.is_exceeded_by(other)) return;
  const double gap = std::abs((other.t - crossing.t) + (other.t_low - crossing.t_low));
  if (!(gap <= crossing.error + other.error)) return;
  crossing.error = std::max(crossing.error, gap + other.error);
}

/// Corrects the error of a crossing by the walls that are crossed in its place, from `begin` to
/// `end`, and by those before and after it.
template <class Walls, class Place>
void bound_beside(const Walls& walls, Place begin, Place end, double largest_error,
                  const LongestError& longest, Crossing& crossing) {
  for (auto here = begin; here != end; ++here) bound_by(here->crossing, longest, crossing);
  const double farthest = crossing.error + largest_error;
  while (begin != walls.begin() && crossing.t - (--begin)->crossing.t <= farthest) {
    bound_by(begin->crossing, longest, crossing);
  }
  for (; end != walls.end() && end->crossing.t - crossing.t <= farthest; ++end) {
    bound_by(end->crossing, longest, crossing);
  }
}

}  // namespace crt::core
