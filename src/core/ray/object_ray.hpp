#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/base/invalid_index.hpp"
#include "core/math/double_double.hpp"
#include "core/ray/plain_ray.hpp"
#include "crt/vec.hpp"

namespace crt::core {

/// Says to which side of a face a ray leaves: where the outward normal points, or into the solid.
enum class Side : std::uint8_t { outside, inside };

inline Side opposite(Side side) {
  return side == Side::outside ? Side::inside : Side::outside;
}

/// A FaceStart says where a ray starts that starts on a surface and not in free space. It is on the
/// face itself, or merely on the surface that the face is a piece of. In the latter case it is on
/// another primitive's face that lies on that surface too.
struct FaceStart {
  std::uint32_t face = invalid_index;
  Side side = Side::outside;  ///< of the face's surface
  bool on_face = true;
  /// Rounding has put the start so far off the surface, measured across it in units of t.
  double t_error = 0;
};

/// The start of an input ray may be a crossing that was computed, with an error like that of a
/// crossing beside it. So twice that error may lie between them.
inline constexpr double errors_at_start = 2;

/// Computes ObjectRay::from_center() for a ray or for lanes.
template <class Real, class Ray>
Vec3Of<Real> point_from_center(const Ray& ray, const Vec3& center, const Real& t,
                               const Real& t_low) {
  const auto component = [&](const Real& from, const Real& from_low, const Real& along,
                             const Real& along_low, double place) {
    const auto offset = two_sum(from, broadcast<Real>(-place));
    return fma(t, along, offset.hi) + (offset.lo + from_low + t * along_low + t_low * along);
  };
  const auto& o = ray.origin;
  const auto& o_low = ray.origin_low;
  const auto& d = ray.direction;
  const auto& d_low = ray.direction_low;
  return {component(o.x, o_low.x, d.x, d_low.x, center.x),
          component(o.y, o_low.y, d.y, d_low.y, center.y),
          component(o.z, o_low.z, d.z, d_low.z, center.z)};
}

/// An ObjectRay is a ray in the object space of one primitive. Origin and direction are unevaluated
/// sums of two doubles, the second far smaller, so that entering the space loses nothing. Without a
/// transform the low parts are 0.
struct ObjectRay {
  Vec3 origin{0, 0, 0};
  Vec3 origin_low{0, 0, 0};
  Vec3 direction{0, 0, 1};
  Vec3 direction_low{0, 0, 0};
  FaceStart start = {};
  /// Crossings with t below this matter only by their number. Where they are may be found roughly,
  /// with an error bound that says so. They may also be left out, if what is returned says whether
  /// the line is inside before the first that is not.
  double begin = -std::numeric_limits<double>::infinity();
  /// Crossings after the first one for which is_first_wanted() is true may be left out. Crossings
  /// nearer than this to where the ray begins may be at its start and not count.
  double first_wanted_after = std::numeric_limits<double>::infinity();

  /// Returns whether a crossing is surely ahead of `first_wanted_after`, whatever its error and
  /// that of the start.
  template <class Crossing>
  bool is_first_wanted(const Crossing& crossing) const {
    return crossing.t - errors_at_start * crossing.error > first_wanted_after;
  }

  /// Returns the point at t + t_low relative to `center`. Subtracting the center early keeps
  /// distant rays exact. If the point is near the center, the error is about one rounding of the
  /// result, whatever the distance from the origin.
  Vec3 from_center(const Vec3& center, double t, double t_low = 0) const {
    return point_from_center<double>(*this, center, t, t_low);
  }
};

/// ObjectRayLanes are as many rays as there are lanes, without where they start.
struct ObjectRayLanes {
  VectorLanes origin;
  VectorLanes origin_low;
  VectorLanes direction;
  VectorLanes direction_low;

  /// Returns what ObjectRay::from_center() returns, to the last bit.
  VectorLanes from_center(const Vec3& center, const Lanes& t, const Lanes& t_low = Lanes{}) const {
    return point_from_center<Lanes>(*this, center, t, t_low);
  }
};

}  // namespace crt::core
