// Materials are shared by entities. A principled one has a stand-in of the simpler kind, for
// whoever knows that alone.
#include <algorithm>

#include "crt/material.hpp"
#include "crt/validate.hpp"

namespace crt {

namespace {

/// Returns a share, or `otherwise` if it is a pattern.
double share_or(const Share& share, double otherwise) {
  const auto* number = std::get_if<double>(&share);
  return number != nullptr ? *number : otherwise;
}

/// Returns what looks roughly like a principled material: smooth metals mirror, rough ones are
/// diffuse, and what is no metal has a highlight as large as its roughness makes it.
Material stand_in(const PrincipledMaterial& material) {
  constexpr double some_roughness = 0.5;
  constexpr double sharpest = 1e4;
  const double metallic = share_or(material.metallic, 0);
  const double roughness = share_or(material.roughness, some_roughness);
  const double smoothness = (1 - roughness) * (1 - roughness);
  const double width = roughness * roughness;
  const auto* light = std::get_if<Color>(&material.emission);
  return {.color = material.color,
          .reflectivity = metallic * smoothness,
          .transparency = (1 - metallic) * material.transmission,
          .refractive_index = material.refractive_index,
          .specular = 0.5 * smoothness,
          .shininess = std::min(sharpest, 2 / std::max(width * width, 1 / sharpest)),
          .absorption = material.absorption,
          .bump = material.bump,
          .bump_height = material.bump_height,
          .emission = light != nullptr ? *light : Color{0, 0, 0},
          .density = material.density};
}

}  // namespace

SharedMaterial::SharedMaterial(Material material) {
  validate(material);
  material_ = std::make_shared<const Material>(std::move(material));
}

SharedMaterial::SharedMaterial(std::shared_ptr<const PrincipledMaterial> principled) {
  validate(*principled);
  material_ = std::make_shared<const Material>(stand_in(*principled));
  principled_ = std::move(principled);
}

}  // namespace crt
