#include "core/shading/phong.hpp"

#include <algorithm>
#include <cmath>

#include "core/shading/fresnel.hpp"

namespace crt::core {

Rgb direct_light(const PhongSurface& surface, const LightSample& light, const Rgb& light_color) {
  const double cosine = glm::dot(light.direction, surface.normal);
  if (!(cosine > 0)) return Rgb(0);
  double strength = surface.diffuse * cosine;
  if (surface.specular > 0) {
    const Vec3 reflected = mirrored(-light.direction, surface.normal);
    const double alignment = std::max(0.0, -glm::dot(reflected, surface.view));
    strength += surface.specular * std::pow(alignment, surface.shininess);
  }
  return strength * light.intensity * light_color * surface.color;
}

}  // namespace crt::core
