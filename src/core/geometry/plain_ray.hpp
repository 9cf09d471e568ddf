// A ray, or several side by side, in a space that it is known in without rounding: the world's.
#pragma once

#include "core/math/lanes.hpp"

namespace crt::core {

/// One line, or as many as a Real has lanes. What it has is that of an ObjectRay whose low parts are 0, to
/// the last bit.
template <class Real>
struct PlainRay {
  Vec3Of<Real> origin;
  Vec3Of<Real> direction;

  Vec3Of<Real> from_center(const Vec3& center, const Real& t, const Real& t_low) const {
    Vec3Of<Real> result;
    for (int axis = 0; axis < 3; ++axis) {
      const auto offset = two_sum(origin[axis], Real{} - center[axis]);
      result[axis] = fma(t, direction[axis], offset.hi) + (offset.lo + t_low * direction[axis]);
    }
    return result;
  }
};

}  // namespace crt::core
