// The function of a torus's face, for questions about boxes (face_functions.hpp): G of torus.hpp.
#pragma once

#include "core/geometry/face_functions.hpp"

namespace crt::core {

struct TorusFunction {
  Vec3 center{0, 0, 0};
  PointOf<Interval> axis;
  double inverse_unit = 1;
  Interval ring;  ///< in units
  Interval tube;

  static constexpr std::uint32_t face_count() { return 1; }
  static constexpr int max_crossings(std::uint32_t) { return 4; }
  template <class Number>
  Number value(std::uint32_t /*face*/, const PointOf<Number>& point) const {
    const PointOf<Number> p = scaled(relative_to(point, center), inverse_unit);
    return square(root(squared_length_across(p, axis)) - ring) + square(component_along(p, axis)) -
           square(tube);
  }
};

}  // namespace crt::core
