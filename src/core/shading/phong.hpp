// Phong's reflection model: what of a light a surface sends to the viewer. Source: Phong,
// Illumination for computer generated pictures, 1975.
#pragma once

#include "core/shading/prepared_light.hpp"
#include "core/shading/rgb.hpp"

namespace crt::core {

/// A point of a surface and the ray that sees it.
struct PhongSurface {
  Rgb color{1, 1, 1};
  double diffuse = 1;
  double specular = 0;
  double shininess = 3;
  Vec3 normal{0, 1, 0};  ///< unit length, turned to the viewer
  Vec3 view{0, -1, 0};   ///< unit length, from the viewer to the point
};

/// What the point gets of all lights' ambient shares, lit or not.
inline Rgb ambient_light(const Rgb& ambient, double reflectivity) {
  return (1 - reflectivity) * ambient;
}

/// The diffuse and the specular light of one light that nothing hides; black if it is behind the
/// surface.
Rgb direct_light(const PhongSurface& surface, const LightSample& light, const Rgb& light_color);

}  // namespace crt::core
