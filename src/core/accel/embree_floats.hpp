// Doubles become the floats that Embree takes, rounded to the side on which nothing is lost.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/math/lanes.hpp"

namespace crt::core {

inline float round_up(double value) {
  const auto nearest = static_cast<float>(value);
  if (!(static_cast<double>(nearest) < value)) return nearest;
  // This computes what std::nextafter() does, which is a call.
  const auto bits = std::bit_cast<std::uint32_t>(nearest);
  if (nearest > 0) return std::bit_cast<float>(bits + 1);
  return nearest < 0 ? std::bit_cast<float>(bits - 1) : std::numeric_limits<float>::denorm_min();
}

inline float round_down(double value) {
  return -round_up(-value);
}

/// No ray is shorter than this, as Embree passes by what is met just where a ray ends.
inline constexpr float shortest_length = std::numeric_limits<float>::min();

inline float round_up_length(double length) {
  return std::max(round_up(length), shortest_length);
}

/// Returns each length rounded up, if it is not negative.
inline FloatLanes round_up_length(const Lanes& length) {
  const FloatLanes nearest = to_floats(length);
  const auto too_low = stdx::static_simd_cast<IntLanes>(
      select(to_doubles(nearest) < length, lanes_of(1), lanes_of(0)));
  const auto rounded_up = bits_as<FloatLanes>(bits_as<IntLanes>(nearest) + too_low);
  return max(rounded_up, FloatLanes(shortest_length));
}

/// Returns a component of a packet's directions as floats, with 0 for what is all but 0. Embree
/// takes the latter for a small number above 0, yet sorts rays by the sign that it has. So a ray
/// that goes downwards by next to nothing would cost others their boxes.
inline FloatLanes direction_floats(const Lanes& component) {
  constexpr double least = 0x1p-59;  // Embree's is 1e-18
  return to_floats(select(abs(component) > least, component, Lanes{}));
}

}  // namespace crt::core
