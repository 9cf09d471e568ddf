// Phong's reflection model says how much of a light a surface sends to the viewer.
//
// Source: Phong, Illumination for computer generated pictures, 1975.
#pragma once

#include "core/shading/prepared_light.hpp"
#include "core/shading/rgb.hpp"

namespace crt::core {

/// A PhongSurfaces has points of as many surfaces as there are lanes, and the rays that see them.
struct PhongSurfaces {
  VectorLanes color;
  Lanes diffuse{};
  Lanes specular{};
  Lanes shininess{};
  VectorLanes normal;  ///< unit length, turned to the viewer
  VectorLanes view;    ///< unit length, from the viewer to the point
};

/// Returns what a surface sends back of all lights' ambient shares, lit or not.
template <class Real>
Vec3Of<Real> ambient_light(const Rgb& ambient, AmbientModel model, const Vec3Of<Real>& color,
                           const Real& reflectivity, const Real& transparency) {
  if (model == AmbientModel::light) return (1.0 - reflectivity) * broadcast<Real>(ambient);
  return max(Real{}, 1.0 - reflectivity - transparency) * broadcast<Real>(ambient) * color;
}

/// Writes the diffuse and the specular light of one unobstructed light into `seen`. It is black if
/// the light is behind the surface. Only lanes of `lit` are needed, and others may hold anything.
void direct_light(const PhongSurfaces& surfaces, const LightSamples& light, const LaneMask& lit,
                  VectorLanes& seen);

}  // namespace crt::core
