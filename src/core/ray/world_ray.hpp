// A ray in the world knows the surface that it starts on.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "core/base/invalid_index.hpp"
#include "core/ray/object_ray.hpp"

namespace crt::core {

/// A StartPoint says where a ray starts, by identity. (leaf, face) is the piece of surface.
/// `surface` is the whole surface that it lies on, which all faces that coincide share. In free
/// space all three are `nothing`.
struct StartPoint {
  std::uint32_t leaf = invalid_index;
  std::uint32_t face = invalid_index;
  std::uint32_t surface = invalid_index;
  Side side = Side::outside;  ///< the side of that surface, by its canonical orientation
  /// This is how far rounding may have put the start from *other* surfaces that are there too. See
  /// is_at_start().
  double t_error = 0;

  /// Takes all but the error from another start. It copies each member alone: copying the whole at
  /// once would stall, as its members were written just before and are not in the cache yet.
  void set_face(const StartPoint& other) {
    leaf = other.leaf;
    face = other.face;
    surface = other.surface;
    side = other.side;
  }

  /// Returns whether both are on one face, to one side of its surface.
  bool is_to_same_side(const StartPoint& other) const {
    return leaf == other.leaf && face == other.face && side == other.side;
  }
};

/// An EndPoint says on what a ray ends, by identity, as a StartPoint does. All are `nothing` for a
/// ray that ends in free space, or on what nobody knows.
struct EndPoint {
  std::uint32_t leaf = invalid_index;
  std::uint32_t face = invalid_index;
  std::uint32_t surface = invalid_index;

  bool is_known() const { return leaf != invalid_index; }
  /// Returns whether a hit is on the surface of the end.
  template <class Hit>
  bool is_surface_of(const Hit& hit) const {
    if (surface != invalid_index) return hit.surface == surface;
    return is_known() && hit.leaf == leaf && hit.face == face;
  }
};

/// A point that was meant to be on several surfaces is at most so far from them after rounding, as
/// a multiple of its largest coordinate. A point that somebody else has computed to be on an object
/// may be off by as much of the object's radius, too.
inline constexpr double start_rounding = 8 * std::numeric_limits<double>::epsilon();

/// A WorldRay is a ray in the world: origin + t * direction, t_min < t < t_max.
struct WorldRay {
  Vec3 origin{0, 0, 0};
  Vec3 direction{0, 0, 1};
  double t_min = 0;
  double t_max = std::numeric_limits<double>::infinity();
  StartPoint start{};
  /// If the ray ends at something that may be on a surface, this is how far rounding may have put
  /// that from the surface. Surfaces through the end do not count as in between.
  double end_error = 0;
  EndPoint end_point{};
  /// The errors at start and end are larger by that, or by less for small objects. Only input rays
  /// have it, as their start and end are on surfaces that nobody knows. See
  /// Accelerator::size_error().
  double max_size_error = 0;
  /// Says whether it is an input ray, whose start may be a crossing that was computed.
  bool is_input = false;

  // A packet is made of one ray or of a RayBatch, which has these functions as well.
  const WorldRay& ray(std::size_t /*index*/) const { return *this; }
  PlainRay<double> line(std::size_t /*group*/) const { return {origin, direction}; }
  const double& begin(std::size_t /*group*/) const { return t_min; }
  const double& end(std::size_t /*group*/) const { return t_max; }
  std::span<const StartPoint> group_starts(std::size_t /*group*/) const { return {&start, 1}; }
};

inline PlainRay<double> plain_ray(const WorldRay& ray) {
  return {.origin = ray.origin, .direction = ray.direction};
}

/// Returns how far from the start a surface through it may be met, of which this is the rounding.
/// The flatter the ray meets it, the farther that is.
template <class Real>
Real start_tolerance(const Real& start_error) {
  constexpr double flattest = 0x1p24;
  return flattest * start_error;
}

/// Returns up to which t surfaces through the start may be met.
template <class Real>
Real tolerated_start(const Real& begin, const Real& start_error) {
  return begin + start_tolerance(start_error);
}
inline double tolerated_start(const WorldRay& ray) {
  return tolerated_start(ray.t_min, ray.start.t_error + ray.max_size_error);
}

/// Returns ObjectRay::first_wanted_after for a ray with that tolerated_start(). A crossing above it
/// is not at the start.
template <class Real>
Real surely_after(const Real& tolerated_start) {
  // The margin covers the rounding of the test. So a crossing that passes it is above
  // tolerated_start by more than its error.
  constexpr double more_than_rounding = 0x1p-50;
  return tolerated_start + more_than_rounding * abs(tolerated_start);
}

}  // namespace crt::core
