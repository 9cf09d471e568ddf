#include "core/shading/prepared_material.hpp"

#include <algorithm>

namespace crt::core {

PreparedMaterial::PreparedMaterial(const SharedMaterial& material, TexturePool& textures)
    : description(material) {
  if (const auto* plain = std::get_if<Color>(&description->color)) {
    color = *plain;
  } else {
    pattern.emplace(std::get<Pattern>(description->color), textures);
  }
  if (description->bump && description->bump_height != 0)
    bump.emplace(*description->bump, textures);

  const bool gapless = pattern ? pattern->opaque() : color.a == 1;
  opaque = gapless && description->transparency == 0;
  if (!opaque) gain = std::max(1.0, pattern ? pattern->brightest() : brightest_channel(color));
  ends_paths = opaque && description->reflectivity <= 0;
  const Color& absorption = description->absorption;
  absorbing = !opaque && (absorption.r > 0 || absorption.g > 0 || absorption.b > 0);
  uses_uv = (pattern && pattern->uses_uv()) || (bump && bump->uses_uv());
}

}  // namespace crt::core
