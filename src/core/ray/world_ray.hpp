// A ray in the world, and what is known of the surface that it starts on.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/ray/object_ray.hpp"

namespace crt::core {

inline constexpr std::uint32_t nothing = 0xffffffffu;

/// Where a ray starts, by identity: (leaf, face) is the piece of surface, `surface` the whole
/// surface it lies on (shared by all faces of the scene that coincide). In free space all are
/// nothing.
struct StartPoint {
  std::uint32_t leaf = nothing;
  std::uint32_t face = no_face;
  std::uint32_t surface = nothing;
  Side side = Side::outside;  ///< of that surface, by its canonical orientation
  /// How far rounding may have put the start from *other* surfaces that are there too: see
  /// is_at_start().
  double t_error = 0;

  /// Takes all but the error from another. Member by member: to copy as a whole what has just been
  /// written by members waits until they have reached the cache.
  void set_face(const StartPoint& other) {
    leaf = other.leaf;
    face = other.face;
    surface = other.surface;
    side = other.side;
  }

  /// Whether both are on one face, to one side of its surface.
  bool is_to_same_side(const StartPoint& other) const {
    return leaf == other.leaf && face == other.face && side == other.side;
  }
};

/// What rounding makes of a point that was meant to be on several surfaces: it is this far from
/// them at most, as a multiple of its largest coordinate.
inline constexpr double start_rounding = 8 * std::numeric_limits<double>::epsilon();

/// A ray in the world: origin + t * direction, t_min < t < t_max.
struct WorldRay {
  Vec3 origin{0, 0, 0};
  Vec3 direction{0, 0, 1};
  double t_min = 0;
  double t_max = std::numeric_limits<double>::infinity();
  StartPoint start{};
  /// If what the ray ends at may be on a surface: how far from that surface rounding may have put
  /// it. Where asked what is on the way there, surfaces through the end are not.
  double end_error = 0;
};

/// The flatter a ray meets a surface, the farther from its start it may do so if that is on the
/// surface: up to this many times the rounding of the start.
inline constexpr double flattest_start = 0x1p24;

/// Up to where surfaces through the start may be met.
template <class Real>
Real farthest_start(const Real& begin, const Real& start_error) {
  return begin + flattest_start * start_error;
}
inline double farthest_start(const WorldRay& ray) {
  return farthest_start(ray.t_min, ray.start.t_error);
}

/// ObjectRay::first_above of a ray whose farthest_start() that is: a crossing above that is not at
/// the start.
template <class Real>
Real asked_above(const Real& farthest_start) {
  // It is also more than its error above, to the last bit or so.
  constexpr double more_than_rounding = 0x1p-50;
  return farthest_start + more_than_rounding * abs(farthest_start);
}

}  // namespace crt::core
