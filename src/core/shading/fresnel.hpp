// What happens to light at the boundary between two transparent media: Snell's law and the exact
// Fresnel equations for unpolarised light. Also the mirror direction.
//
// Notation: directions are unit length. `normal` is turned against `direction` (normal . direction
// <= 0). n1 is the refractive index on the side light comes from, n2 that beyond.
#pragma once

#include <glm/geometric.hpp>

#include "crt/vec.hpp"

namespace crt::core {

struct Refraction {
  /// The share of light that is reflected (Fresnel); 1 under total internal reflection.
  double reflectance = 0;
  /// Where the rest goes, unit length; 0 under total internal reflection.
  Vec3 direction{0, 0, 0};
};

/// Equal indices let everything through exactly straight.
Refraction refract(const Vec3& direction, const Vec3& normal, double n1, double n2);

/// The reflected share alone, for the cosine (in [0, 1]) of the angle of incidence.
double fresnel_reflectance(double cosine, double n1, double n2);

/// The mirror image of `direction` at the plane across `normal`.
inline Vec3 mirrored(const Vec3& direction, const Vec3& normal) {
  return direction - 2 * glm::dot(direction, normal) * normal;
}

}  // namespace crt::core
