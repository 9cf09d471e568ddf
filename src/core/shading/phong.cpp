#include "core/shading/phong.hpp"

#include <cmath>

namespace crt::core {

namespace {

/// Where the mask says so: the powers are taken one by one, and few surfaces shine.
Lanes powers(const Lanes& bases, const Lanes& exponents, std::uint32_t mask) {
  Lanes result{};
  for (int lane = 0; lane < lane_count; ++lane) {
    if ((mask >> lane & 1u) != 0) result[lane] = std::pow(bases[lane], exponents[lane]);
  }
  return result;
}

}  // namespace

VectorLanes direct_light(const PhongSurfaces& surfaces, const LightSamples& light, const Rgb& light_color,
                         const LaneMask& lit) {
  const VectorLanes& normal = surfaces.normal;
  const Lanes cosine = dot(light.directions, normal);
  const LaneMask before = cosine > 0.0;
  Lanes strength = surfaces.diffuse * cosine;
  const LaneMask shines = surfaces.specular > 0.0;
  if (const std::uint32_t mask = mask_of(lit & before & shines); mask != 0) {
    const VectorLanes from_light = -light.directions;
    const VectorLanes mirrored = from_light - 2.0 * dot(from_light, normal) * normal;
    const Lanes alignment = max(Lanes{}, -dot(mirrored, surfaces.view));
    const Lanes highlight = surfaces.specular * powers(alignment, surfaces.shininess, mask);
    strength += shines ? highlight : Lanes{};
  }
  strength = before ? strength : Lanes{};
  return strength * light.intensities * lanes_of(light_color) * surfaces.color;
}

}  // namespace crt::core
