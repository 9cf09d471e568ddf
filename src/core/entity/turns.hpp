// Solids that wind about an axis share this.
#pragma once

#include <numbers>

#include "core/geometry/checks.hpp"
#include "crt/field.hpp"

namespace crt::core {

/// Checks that a length has at most 10000 turns. Throws Error (invalid_argument).
inline void check_turns(double length, double pitch) {
  constexpr double most_turns = 1e4;
  if (!(length <= most_turns * pitch)) reject("pitch", "must be at least a 10000th of the length");
}

/// Returns the distance from the z axis.
inline Field distance_from_axis() {
  return sqrt(Field::x() * Field::x() + Field::y() * Field::y());
}

/// Returns the cosine of the angle about z between a point and a helix whose pitch is 1. It begins
/// at x and goes towards -y, or towards y if it is left-handed in these axes. Nearer to the axis
/// than `inner`, where there is no angle, it is less.
inline Field cosine_to_helix(const Field& distance, bool is_left, double inner) {
  const Field around = 2 * std::numbers::pi * Field::z();
  const Field across = is_left ? sin(around) * Field::y() : -(sin(around) * Field::y());
  return (cos(around) * Field::x() + across) / max(distance, inner);
}

}  // namespace crt::core
