// The function of a sphere's face, for questions about boxes (face_functions.hpp).
#pragma once

#include "core/geometry/face_functions.hpp"

namespace crt::core {

struct SphereFunction {
  Vec3 center{0, 0, 0};
  double inverse_unit = 1;
  Interval radius;  ///< in units

  static constexpr std::uint32_t face_count() { return 1; }
  static constexpr int max_crossings(std::uint32_t) { return 2; }
  template <class Number>
  Number value(std::uint32_t /*face*/, const PointOf<Number>& point) const {
    return squared_length(scaled(relative_to(point, center), inverse_unit)) - square(radius);
  }
};

}  // namespace crt::core
