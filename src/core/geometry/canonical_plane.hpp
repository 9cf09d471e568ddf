// Planes are compared by their equations.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "core/math/precise_transform.hpp"

namespace crt::core {

/// A CanonicalPlane is a plane's equation in the form that all descriptions of the plane have in
/// common.
struct CanonicalPlane {
  std::array<double, 4> numbers{};  ///< normal and offset, and no -0
  bool flipped = false;             ///< whether the normal that was given is opposite

  /// Takes all points p with normal . p = offset. The equation is divided by the normal's largest
  /// component. It is exact to about 100 bits before it is rounded, so planes that are equal but
  /// described differently agree.
  static CanonicalPlane of(const PreciseVec3& normal, const DoubleDouble& offset) {
    std::size_t largest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis) {
      if (std::abs(normal[axis].hi) > std::abs(normal[largest].hi)) largest = axis;
    }
    const DoubleDouble divisor = normal[largest];
    // Adding 0 makes 0 of -0.
    const auto rounded = [&](const DoubleDouble& number) {
      return (number / divisor).value() + 0.0;
    };
    return {
        .numbers = {rounded(normal[0]), rounded(normal[1]), rounded(normal[2]), rounded(offset)},
        .flipped = divisor.hi < 0};
  }
};

}  // namespace crt::core
