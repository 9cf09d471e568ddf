// How large solids are together, whatever has no end beside them.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/geometry/bounds.hpp"

namespace crt::core {

class FiniteSides {
 public:
  /// Takes a box in, but for those axes along which it has no end, or is empty.
  void include(const Vec3& lower, const Vec3& upper) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(upper[axis] - lower[axis])) continue;
      around_.lower[axis] = std::min(around_.lower[axis], lower[axis]);
      around_.upper[axis] = std::max(around_.upper[axis], upper[axis]);
    }
  }
  /// Returns the longest side of the box around all, or 0.
  double longest() const {
    double longest = 0;
    for (int axis = 0; axis < 3; ++axis)
      longest = std::max(longest, around_.upper[axis] - around_.lower[axis]);
    return longest;
  }

 private:
  Bounds around_;
};

}  // namespace crt::core
