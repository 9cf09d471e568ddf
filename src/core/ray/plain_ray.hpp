// A PlainRay is one ray or several side by side in the world's space, where they are known without
// rounding.
#pragma once

#include "core/math/vector_lanes.hpp"

namespace crt::core {

/// A PlainRay has one line, or as many as a Real has lanes. Its results are those of an ObjectRay
/// whose low parts are 0, to the last bit.
template <class Real>
struct PlainRay {
  Vec3Of<Real> origin;
  Vec3Of<Real> direction;

  /// Returns the points at t, each component rounded once.
  Vec3Of<Real> at(const Real& t) const {
    return {fma(t, direction.x, origin.x), fma(t, direction.y, origin.y),
            fma(t, direction.z, origin.z)};
  }

  /// Returns the points relative to one center, or to a VectorLanes with a center for each lane.
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
