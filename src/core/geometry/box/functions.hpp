// The functions of a box's faces, for questions about boxes (face_functions.hpp).
#pragma once

#include "core/geometry/face_functions.hpp"

namespace crt::core {

struct BoxFunctions {
  Vec3 lower{0, 0, 0};
  Vec3 upper{0, 0, 0};

  static constexpr std::uint32_t face_count() { return 6; }
  static constexpr int max_crossings(std::uint32_t) { return 1; }
  template <class Number>
  Number value(std::uint32_t face, const PointOf<Number>& point) const {
    const std::uint32_t axis = face / 2;
    const auto place = static_cast<int>(axis);
    if (face % 2 == 0) return -(point[axis] - Interval::of(lower[place]));
    return point[axis] - Interval::of(upper[place]);
  }
};

}  // namespace crt::core
