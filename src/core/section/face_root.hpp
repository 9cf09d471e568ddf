// The function of a face along a line of the plane, and where it is 0.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/face_functions.hpp"
#include "core/section/boundary_cells.hpp"

namespace crt::core {

struct FaceOnLine {
  const CellSolid& solid;
  const BoundaryGrid& grid;
  const CellFace& face;
  std::size_t along = 0;  ///< 0 or 1: the axis that the line follows
  double across = 0;      ///< its coordinate along the other one

  PlanePoint at(double place) const {
    return along == 0 ? PlanePoint{place, across} : PlanePoint{across, place};
  }
  /// Returns the value at a place, rounded.
  double value(double place) const {
    const Interval range = solid.value(face, known_point(grid.in_space(at(place))));
    return 0.5 * range.lo + 0.5 * range.hi;
  }
  /// Returns where a function that grows or shrinks all along is 0, or else the end that is
  /// nearer to that. By the Illinois method, which keeps the root between two places.
  double root(double low, double high) const {
    double at_low = value(low);
    double at_high = value(high);
    double best = std::abs(at_low) < std::abs(at_high) ? low : high;
    if ((at_low < 0) == (at_high < 0)) return best;
    double least = std::min(std::abs(at_low), std::abs(at_high));
    constexpr int most_steps = 100;
    int side = 0;
    for (int step = 0; step < most_steps && least > 0; ++step) {
      double next = low - at_low * ((high - low) / (at_high - at_low));
      // Every few steps halve, whatever the function's form.
      if (step % 8 == 7 || !(next > low && next < high)) next = 0.5 * low + 0.5 * high;
      if (!(next > low && next < high)) break;
      const double at_next = value(next);
      const double last_place = 0x1p-52 * std::abs(next);
      const bool is_last = std::min(next - low, high - next) <= last_place;
      if (std::abs(at_next) < least) {
        least = std::abs(at_next);
        best = next;
      }
      const bool is_low = (at_next < 0) == (at_low < 0);
      if (is_last && side == (is_low ? 1 : -1)) break;
      if (is_low) {
        low = next;
        at_low = at_next;
        if (side == -1) at_high *= 0.5;
        side = -1;
      } else {
        high = next;
        at_high = at_next;
        if (side == 1) at_low *= 0.5;
        side = 1;
      }
    }
    return best;
  }
  /// Returns the root between two places from a guess, by steps for the middle of what its slopes
  /// are there.
  double root_near(double guess, const Interval& slopes, double low, double high) const {
    const double slope = 0.5 * slopes.lo + 0.5 * slopes.hi;
    double place = guess;
    double last_step = std::numeric_limits<double>::infinity();
    constexpr int most_steps = 12;
    for (int i = 0; i < most_steps; ++i) {
      const double step = value(place) / slope;
      place = std::clamp(place - step, low, high);
      if (std::abs(step) <= 0.5 * grid.rounding()) return place;
      if (!(std::abs(step) < 0.5 * last_step)) break;
      last_step = std::abs(step);
    }
    return root(low, high);
  }
};

}  // namespace crt::core
