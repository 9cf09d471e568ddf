// Phong's reflection model: what of a light a surface sends to the viewer. Source: Phong,
// Illumination for computer generated pictures, 1975.
#pragma once

#include "core/shading/prepared_light.hpp"
#include "core/shading/rgb.hpp"

namespace crt::core {

/// Points of as many surfaces as there are lanes, and the rays that see them.
struct PhongSurfaces {
  VectorLanes color;
  Lanes diffuse{};
  Lanes specular{};
  Lanes shininess{};
  VectorLanes normal;  ///< unit length, turned to the viewer
  VectorLanes view;    ///< unit length, from the viewer to the point
};

/// What the point gets of all lights' ambient shares, lit or not.
template <class Real>
Vec3Of<Real> ambient_light(const Rgb& ambient, const Real& reflectivity) {
  return (1.0 - reflectivity) * broadcast<Real>(ambient);
}

/// The diffuse and the specular light of one light that nothing hides, into `seen`; black if it is
/// behind the surface. Only lanes of `lit` are asked for, others may hold anything.
void direct_light(const PhongSurfaces& surfaces, const LightSamples& light, const Rgb& light_color,
                  const LaneMask& lit, VectorLanes& seen);

}  // namespace crt::core
