// Affine maps have entries of more than double precision.
#pragma once

#include <array>

#include "core/math/double_double.hpp"
#include "crt/transform.hpp"

namespace crt::core {

/// A PreciseVec3 is a vector of double-doubles.
using PreciseVec3 = std::array<DoubleDouble, 3>;

// These use the operators of double-double. geometry/exact_ray.hpp has faster ones for the exact
// tier.
inline DoubleDouble dot(const PreciseVec3& a, const PreciseVec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline PreciseVec3 cross(const PreciseVec3& a, const PreciseVec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Rounds each component to the nearest double.
inline Vec3 rounded(const PreciseVec3& v) {
  return {v[0].value(), v[1].value(), v[2].value()};
}

/// A PreciseTransform is an affine map with entries of about 106 bits, in which nested transforms
/// are composed.
struct PreciseTransform {
  std::array<PreciseVec3, 3> rows{PreciseVec3{1.0, 0.0, 0.0}, PreciseVec3{0.0, 1.0, 0.0},
                                  PreciseVec3{0.0, 0.0, 1.0}};
  PreciseVec3 translation{0.0, 0.0, 0.0};

  PreciseTransform() = default;
  explicit PreciseTransform(const Transform& transform);

  /// Rounds every entry to the nearest double.
  Transform rounded() const;
};

/// Returns the map that applies `first` and then `second`.
PreciseTransform compose(const PreciseTransform& second, const PreciseTransform& first);

/// Returns the determinant of the linear part.
DoubleDouble determinant(const PreciseTransform& transform);

/// Returns the inverse. The determinant must not be 0.
PreciseTransform inverse(const PreciseTransform& transform);

}  // namespace crt::core
