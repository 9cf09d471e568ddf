// The function of a plane, for questions about boxes (face_functions.hpp).
#pragma once

#include "core/geometry/face_functions.hpp"

namespace crt::core {

struct PlaneFunction {
  HalfSpaceFunction half_space;

  static constexpr std::uint32_t face_count() { return 1; }
  static constexpr int max_crossings(std::uint32_t) { return 1; }
  template <class Number>
  Number value(std::uint32_t /*face*/, const PointOf<Number>& point) const {
    return half_space.value(point);
  }
};

}  // namespace crt::core
