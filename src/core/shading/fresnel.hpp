// Light at the boundary between two transparent media follows Snell's law and the exact Fresnel
// equations for unpolarised light. The mirror direction is here, too.
//
// Notation: directions are unit length. `normal` is turned against `direction` (normal . direction
// <= 0). n1 is the refractive index on the side light comes from, n2 that beyond.
#pragma once

#include "core/math/vector_lanes.hpp"

namespace crt::core {

/// A Refraction is that of one ray, or of as many side by side as a Real has lanes.
template <class Real>
struct Refraction {
  /// This is the share of light that is reflected (Fresnel), 1 under total internal reflection.
  Real reflectance{};
  /// This is the direction of the rest, of unit length, and 0 under total internal reflection.
  Vec3Of<Real> direction{};
};

/// Refracts one ray or lanes: Real is double or Lanes. Equal indices let everything through exactly
/// straight.
template <class Real>
Refraction<Real> refract(const Vec3Of<Real>& direction, const Vec3Of<Real>& normal, const Real& n1,
                         const Real& n2);

/// Returns the reflected share alone, for the cosine (in [0, 1]) of the angle of incidence.
template <class Real>
Real fresnel_reflectance(const Real& cosine, const Real& n1, const Real& n2);

/// Returns the mirror image of `direction` at the plane across `normal`, for a Vec3 or VectorLanes.
template <class Vector>
Vector mirrored(const Vector& direction, const Vector& normal) {
  return direction - 2.0 * dot(direction, normal) * normal;
}

}  // namespace crt::core
