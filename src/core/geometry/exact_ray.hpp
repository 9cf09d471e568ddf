// A ray as the exact tier takes it: nearly exact at once, and exactly where that is not enough.
#pragma once

#include <array>

#include "core/geometry/object_ray.hpp"
#include "core/math/dyadic.hpp"
#include "crt/transform.hpp"

namespace crt::core {

/// A line in object space without any rounding: (origin + t direction) / weight, with weight > 0. The
/// division that the inverse of a transform needs is never carried out.
struct ExactLine {
  std::array<Dyadic, 3> origin;
  std::array<Dyadic, 3> direction;
  Dyadic weight = 1;
};

/// How exactly t must be known for its rounding to be within 0.51 ulp.
inline constexpr double last_bit_tolerance = 0x1p-60;

struct ExactRay {
  /// In object space, to about 100 bits.
  ObjectRay near;
  /// What each component of origin and direction may be off by at most.
  double origin_error = 0;
  double direction_error = 0;
  // The same in the world, and the map from object space (none for the identity).
  Vec3 world_origin{0, 0, 0};
  Vec3 world_direction{0, 0, 1};
  const Transform* to_world = nullptr;
  /// A ray that starts on a surface has a rounded origin: what it meets at |t| below this is at the start for
  /// all that is known.
  double start_error = 0;
  /// Counts how often exact() is asked.
  std::uint64_t* escalations = nullptr;

  ExactLine exact() const;

  /// Whether a t that may be off by `error` is known well enough: its last bit, or of what is at the start
  /// for all that is known the side.
  bool is_settled(double t, double error) const {
    constexpr double at_start_tolerance = 0x1p-20;
    const double size = std::abs(t);
    return error <= last_bit_tolerance * size || (size < start_error && error <= at_start_tolerance * size);
  }

  /// What each component of a point p(t) - center is off by at most, where it is computed in double-double.
  double point_error(const Vec3& center, double t) const;
};

/// p(t + t_low) - center to about 100 bits.
std::array<DoubleDouble, 3> precise_from_center(const ObjectRay& ray, const Vec3& center, DoubleDouble t);

/// What double-double arithmetic leaves as an error of its result: a few of its roundings of 2^-105.
inline constexpr double precise_roundoff = 0x1p-100;

}  // namespace crt::core
