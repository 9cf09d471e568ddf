// Crossings of a ray that starts on a face agree with it, whatever rounding made of its origin.
#pragma once

#include <cstddef>

#include "core/geometry/shape.hpp"

namespace crt::core {

/// Makes crossings from `begin` on, which enter and leave by turns, those of a ray that starts on a
/// face itself: it crosses that at t = 0, to the side that it is known to leave to. Next to an edge
/// rounding may have put its origin beyond another face. `root` is the number of the crossing at
/// the start. `farthest` is the largest coordinate of the solid, and `shortest` the length in t of
/// the shortest part of a line.
void agree_with_start(const ObjectRay& ray, std::uint8_t root, double farthest, double shortest,
                      std::size_t begin, CrossingList& list);

}  // namespace crt::core
