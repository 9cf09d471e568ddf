// A ray's hit is what it meets, as found along the ray.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/ray/world_ray.hpp"

namespace crt::core {

/// A RayHit is a crossing as it was found, with numbers only and without shading data.
struct RayHit {
  double t = std::numeric_limits<double>::infinity();
  double error = 0;
  double t_low = 0;  ///< t + t_low is t as the exact tier knows it
  std::uint32_t object =
      invalid_index;  ///< a lone primitive or a CSG object, which is what Embree knows
  std::uint32_t leaf = invalid_index;  ///< the primitive that the face belongs to
  std::uint32_t face = invalid_index;
  /// This is the whole surface that the face is a piece of. Those of instances have no number, as
  /// no other object knows of them.
  std::uint32_t surface = invalid_index;
  std::uint8_t root = 0;  ///< as in Crossing
  bool entering = false;
  bool has_coincident = false;  ///< other objects have crossings there: RayWorkspace::here and near

  bool found() const { return object != invalid_index; }
};

/// Returns whether crossings that have been put into order are at one place.
inline bool have_one_t(const RayHit& a, const RayHit& b) {
  return a.t == b.t && a.t_low == b.t_low;
}

/// Returns whether two crossings of one ray count as being at one place. Crossings of one surface
/// are compared by identity, and others by whether their error bounds can separate them.
inline bool same_place(const RayHit& a, const RayHit& b) {
  const bool is_one = a.surface != invalid_index
                          ? a.surface == b.surface
                          : a.object == b.object && a.leaf == b.leaf && a.face == b.face;
  if (is_one) return a.root == b.root;
  return std::abs((a.t - b.t) + (a.t_low - b.t_low)) <= a.error + b.error;
}

}  // namespace crt::core
