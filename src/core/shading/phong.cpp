#include "core/shading/phong.hpp"

#include "core/math/power.hpp"

namespace crt::core {

void direct_light(const PhongSurfaces& surfaces, const LightSamples& light, const LaneMask& lit,
                  VectorLanes& seen) {
  const VectorLanes& normal = surfaces.normal;
  const Lanes cosine = dot(light.directions, normal);
  const LaneMask before = cosine > 0.0;
  Lanes strength = light.diffuse_shares * surfaces.diffuse * cosine;
  const LaneMask shines = surfaces.specular > 0.0;
  if (any(lit & before & shines)) {
    const VectorLanes from_light = -light.directions;
    const VectorLanes mirrored = from_light - 2.0 * dot(from_light, normal) * normal;
    const Lanes alignment = max(Lanes{}, -dot(mirrored, surfaces.view));
    const Lanes highlight = surfaces.specular * power(alignment, surfaces.shininess);
    strength += select(shines, highlight, Lanes{});
  }
  strength = select(before, strength, Lanes{});
  seen = strength * light.intensities * light.colors * surfaces.color;
}

}  // namespace crt::core
