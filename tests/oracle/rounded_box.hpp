// What the oracle knows of rounded boxes: the parts of space beside the inner box, which is the box
// less the radius on each side, and the equations of the round faces there.
#pragma once

#include <algorithm>
#include <glm/common.hpp>

#include "oracle/number_vec.hpp"
#include "oracle/roots.hpp"

namespace crt::test {

/// RoundedPlaces say along each axis whether a point of a rounded box is below its inner box (-1),
/// within (0) or above (1).
using RoundedPlaces = std::array<int, 3>;

/// Returns how far a point is from the inner box of a rounded box, along each axis. That is less
/// than 0 below it, and above 0 above it. `lower` and `upper` are the point relative to the
/// corners.
template <class Number>
NumberVec<Number> beyond_inner_box(const RoundedBox& b, const RoundedPlaces& places,
                                   const NumberVec<Number>& lower, const NumberVec<Number>& upper) {
  const Number radius(b.radius);
  NumberVec<Number> result{Number(0.0), Number(0.0), Number(0.0)};
  for (std::size_t i = 0; i < 3; ++i) {
    if (places[i] < 0) result[i] = lower[i] - radius;
    if (places[i] > 0) result[i] = upper[i] + radius;
  }
  return result;
}

/// Returns all places beside two or three sides of the inner box, in order: the edges along x, y
/// and z, and then the corners.
inline std::vector<RoundedPlaces> round_places() {
  std::vector<RoundedPlaces> result;
  for (std::size_t along = 0; along < 3; ++along) {
    for (int which = 0; which < 4; ++which) {
      RoundedPlaces places{};
      places[(along + 1) % 3] = which % 2 == 0 ? -1 : 1;
      places[(along + 2) % 3] = which / 2 == 0 ? -1 : 1;
      result.push_back(places);
    }
  }
  for (int which = 0; which < 8; ++which)
    result.push_back({which % 2 == 0 ? -1 : 1, which / 2 % 2 == 0 ? -1 : 1, which < 4 ? -1 : 1});
  return result;
}

/// A rounded box has the equations of so many flat faces.
inline constexpr std::size_t flat_equations = 6;

/// Appends the equations of the planes of the inner box, and of the cylinders and spheres in the
/// order of round_places().
template <class Line, class EquationList>
void append_rounding(const RoundedBox& b, const Line& line, EquationList& result) {
  const auto lower = line.from(glm::min(b.corner_a, b.corner_b));
  const auto upper = line.from(glm::max(b.corner_a, b.corner_b));
  using Number = std::decay_t<decltype(lower[0])>;
  const Number radius(b.radius);
  for (std::size_t i = 0; i < 3; ++i) {
    result.push_back({lower[i] - radius, line.direction[i]});
    result.push_back({upper[i] + radius, line.direction[i]});
  }
  for (const RoundedPlaces& places : round_places()) {
    const NumberVec<Number> p = beyond_inner_box(b, places, lower, upper);
    NumberVec<Number> d = line.direction;
    for (std::size_t i = 0; i < 3; ++i) {
      if (places[i] == 0) d[i] = Number(0.0);
    }
    result.push_back({squared(p) - square(radius), Number(2) * dot(p, d), squared(d)});
  }
}

/// Says whether a point is in a rounded box, by the signs of its equations there.
template <class Signs>
bool is_inside_rounded_box(const Signs& signs) {
  RoundedPlaces places{};
  std::size_t flat = 0;
  int count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const bool is_below = signs[flat_equations + 2 * i] < 0;
    const bool is_above = signs[flat_equations + 2 * i + 1] > 0;
    if (!is_below && !is_above) continue;
    places[i] = is_below ? -1 : 1;
    flat = 2 * i + (is_below ? 0 : 1);
    ++count;
  }
  if (count < 2) return count == 0 || signs[flat] < 0;
  static const std::vector<RoundedPlaces> all = round_places();
  const auto found = std::find(all.begin(), all.end(), places);
  return signs[2 * flat_equations + static_cast<std::size_t>(found - all.begin())] < 0;
}

}  // namespace crt::test
