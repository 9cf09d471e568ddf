#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/vector.hpp"
#include "crt/vec.hpp"

namespace crt::core {

/// Bounds are an axis-parallel box. It is empty if lower > upper in any coordinate, and may be
/// infinite.
struct Bounds {
  Vec3 lower{std::numeric_limits<double>::infinity()};
  Vec3 upper{-std::numeric_limits<double>::infinity()};

  static Bounds everything() {
    return {Vec3(-std::numeric_limits<double>::infinity()),
            Vec3(std::numeric_limits<double>::infinity())};
  }

  bool empty() const { return lower.x > upper.x || lower.y > upper.y || lower.z > upper.z; }

  bool finite() const {
    return lower.x > -infinity && lower.y > -infinity && lower.z > -infinity &&
           upper.x < infinity && upper.y < infinity && upper.z < infinity;
  }

  /// Returns one of the eight corners: at the upper end of an axis if its bit is set.
  Vec3 corner(unsigned number) const {
    return {(number & 1U) != 0 ? upper.x : lower.x, (number & 2U) != 0 ? upper.y : lower.y,
            (number & 4U) != 0 ? upper.z : lower.z};
  }

  void include(const Vec3& point) {
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], point[axis]);
      upper[axis] = std::max(upper[axis], point[axis]);
    }
  }

  void include(const Bounds& other) {
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], other.lower[axis]);
      upper[axis] = std::max(upper[axis], other.upper[axis]);
    }
  }

  /// Includes center +- extents, rounded outwards by a few ulps of both.
  void include_around(const Vec3& center, const Vec3& extents) {
    constexpr double roundings = 0x1p-50;
    for (int axis = 0; axis < 3; ++axis) {
      const double extent = extents[axis] + roundings * (extents[axis] + std::abs(center[axis]));
      lower[axis] = std::min(lower[axis], center[axis] - extent);
      upper[axis] = std::max(upper[axis], center[axis] + extent);
    }
  }

  /// Returns the largest absolute value of a coordinate in the box.
  double farthest() const { return std::max(largest_component(lower), largest_component(upper)); }

  /// Returns the box with a margin on all sides.
  Bounds grown(double margin) const { return {lower - Vec3(margin), upper + Vec3(margin)}; }

  /// Returns what both boxes have in common, which may be empty.
  Bounds clipped(const Bounds& other) const {
    Bounds result;
    for (int axis = 0; axis < 3; ++axis) {
      result.lower[axis] = std::max(lower[axis], other.lower[axis]);
      result.upper[axis] = std::min(upper[axis], other.upper[axis]);
    }
    return result;
  }

  /// Returns whether the boxes have a point in common. Touching counts.
  bool touches(const Bounds& other) const { return !clipped(other).empty(); }
};

}  // namespace crt::core
