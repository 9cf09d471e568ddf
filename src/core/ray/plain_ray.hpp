// A ray, or several side by side, in a space that it is known in without rounding: the world's.
#pragma once

#include "core/math/vector_lanes.hpp"

namespace crt::core {

/// One line, or as many as a Real has lanes. What it has is that of an ObjectRay whose low parts
/// are 0, to the last bit.
template <class Real>
struct PlainRay {
  Vec3Of<Real> origin;
  Vec3Of<Real> direction;

  /// The points at t, each component rounded once.
  Vec3Of<Real> at(const Real& t) const {
    return {fma(t, direction.x, origin.x), fma(t, direction.y, origin.y),
            fma(t, direction.z, origin.z)};
  }

  /// Of one center, or of a VectorLanes with one for each lane.
  template <class Center>
  Vec3Of<Real> from_center(const Center& center, const Real& t, const Real& t_low = Real{}) const {
    const auto component = [&](const Real& from, const Real& along, const auto& place) {
      const auto offset = two_sum(from, broadcast<Real>(-place));
      return fma(t, along, offset.hi) + (offset.lo + t_low * along);
    };
    return {component(origin.x, direction.x, center.x), component(origin.y, direction.y, center.y),
            component(origin.z, direction.z, center.z)};
  }
};

using RayLanes = PlainRay<Lanes>;

}  // namespace crt::core
