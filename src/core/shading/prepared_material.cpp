#include "core/shading/prepared_material.hpp"

#include <algorithm>

namespace crt::core {

namespace {

template <class Value>
void prepare(const std::variant<Value, Pattern>& value, TexturePool& textures,
             std::optional<PreparedPattern>& prepared) {
  if (const auto* pattern = std::get_if<Pattern>(&value)) prepared.emplace(*pattern, textures);
}

bool uses_uv_of(const std::optional<PreparedPattern>& pattern) {
  return pattern && pattern->uses_uv();
}

Layers layers_of(const PrincipledMaterial& material) {
  constexpr double all = -1;
  const auto* roughness = std::get_if<double>(&material.roughness);
  const bool has_coat = material.coat > 0;
  return {.index_behind = material.refractive_index,
          .coat = material.coat,
          .coat_roughness = has_coat ? material.coat_roughness : 0,
          .sheen = material.sheen,
          .transmits = material.transmission > 0,
          .roughness = roughness != nullptr ? *roughness : all};
}

}  // namespace

PreparedPrincipled::PreparedPrincipled(const PrincipledMaterial& material,
                                       const MaterialPools& pools)
    : tables(pools.tables.get(layers_of(material))) {
  TexturePool& textures = pools.textures;
  if (material.normal_map) normal_map.emplace(*material.normal_map, pools.normals);
  prepare(material.metallic, textures, metallic);
  prepare(material.roughness, textures, roughness);
  prepare(material.emission, textures, emission);
}

bool PreparedPrincipled::uses_uv() const {
  return uses_uv_of(metallic) || uses_uv_of(roughness) || uses_uv_of(emission) ||
         uses_uv_of(normal_map);
}

PreparedMaterial::PreparedMaterial(const SharedMaterial& material, const MaterialPools& pools)
    : description(material) {
  if (const auto* plain = std::get_if<Color>(&description->color)) {
    color = *plain;
  } else {
    pattern.emplace(std::get<Pattern>(description->color), pools.textures);
  }
  if (description->bump && description->bump_height != 0)
    bump.emplace(*description->bump, pools.textures);

  const bool gapless = pattern ? pattern->opaque() : color.a == 1;
  opaque = gapless && description->transparency == 0;
  if (!opaque) gain = std::max(1.0, pattern ? pattern->brightest() : brightest_channel(color));
  ends_paths = opaque && description->reflectivity <= 0;
  const Color& absorption = description->absorption;
  absorbing = !opaque && (absorption.r > 0 || absorption.g > 0 || absorption.b > 0);
  if (const PrincipledMaterial* given = material.principled()) principled.emplace(*given, pools);
  emits = brightest_channel(description->emission) > 0 || (principled && principled->emission);
  uses_uv = uses_uv_of(pattern) || uses_uv_of(bump) || (principled && principled->uses_uv());
}

}  // namespace crt::core
