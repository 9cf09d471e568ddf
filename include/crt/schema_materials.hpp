// These tables of the schema are those of materials and patterns, a row a field (see
// crt/schema.hpp).
#pragma once

#include <crt/material.hpp>
#include <crt/pattern.hpp>
#include <crt/schema.hpp>

/// @cond tables
namespace crt::schema {

template <>
inline constexpr auto choices<ImageMapping> = choice("ImageMapping", "crt_image_mapping",
                                                     "CRT_MAPPING", "uv", "planar", "cylindrical",
                                                     "cubic");

template <>
inline constexpr auto table<Material> = Table{
    "Material",
    field("color", &Material::color, brightness, {.alpha = "alpha", .map = "pattern"},
          "channels at least 0, see below"),
    field("reflectivity", &Material::reflectivity, share, {},
          "share of the light that is mirrored, 0 to 1"),
    field("transparency", &Material::transparency, share, {},
          "share of the light that is let through, 0 to 1"),
    field("refractive_index", &Material::refractive_index, between(0.01, 100), {},
          "how much light bends on entering, 0.01 to 100"),
    field("diffuse", &Material::diffuse, factor,
          {.default_text = "1 - reflectivity - transparency, at least 0"}, "at least 0, see below"),
    field("specular", &Material::specular, factor, {}, "strength of the highlight, at least 0"),
    field("shininess", &Material::shininess, factor, {},
          "how small and sharp the highlight is, at least 0"),
    // It is proportional to the inverse of a length.
    field("absorption", &Material::absorption, channels_to(largest_length), {},
          "how fast each channel fades inside, at least 0"),
    field("bump", &Material::bump, any, {},
          "the surface seems raised by this pattern's brightness"),
    field("bump_height", &Material::bump_height, between(-largest_length, largest_length), {},
          "times this, in units of length"),
    field("emission", &Material::emission, brightness, {}, "the light that it gives off"),
    field("density", &Material::density, factor, {}, "kg in a cubic metre, for masses; 0: unknown"),
};

template <>
inline constexpr auto table<PrincipledMaterial> = Table{
    "PrincipledMaterial",
    field("color", &PrincipledMaterial::color, brightness, {.map = "pattern"},
          "what is scattered, mirrored, or let through"),
    field("metallic", &PrincipledMaterial::metallic, share, {.map = "metallic_map"},
          "how much of it is a metal, 0 to 1"),
    field("roughness", &PrincipledMaterial::roughness, share, {.map = "roughness_map"},
          "0 for a perfect mirror or clear glass, to 1"),
    field("refractive_index", &PrincipledMaterial::refractive_index, between(0.01, 100), {},
          "how much it mirrors and bends light, 0.01 to 100"),
    field("transmission", &PrincipledMaterial::transmission, share, {},
          "how much of what is no metal lets light through, 0 to 1"),
    field("absorption", &PrincipledMaterial::absorption, channels_to(largest_length), {},
          "how fast each channel fades inside, at least 0"),
    field("coat", &PrincipledMaterial::coat, share, {}, "strength of a clear varnish, 0 to 1"),
    field("coat_roughness", &PrincipledMaterial::coat_roughness, share, {},
          "roughness of the varnish, 0 to 1"),
    field("sheen", &PrincipledMaterial::sheen, share, {}, "strength of cloth's sheen, 0 to 1"),
    field("emission", &PrincipledMaterial::emission, brightness, {.map = "emission_map"},
          "the light that it gives off"),
    field("normal_map", &PrincipledMaterial::normal_map, any, {},
          "tilts the surface by this pattern's colours, see below"),
    field("bump", &PrincipledMaterial::bump, any, {},
          "the surface seems raised by this pattern's brightness"),
    field("bump_height", &PrincipledMaterial::bump_height, between(-largest_length, largest_length),
          {}, "times this, in units of length"),
    field("density", &PrincipledMaterial::density, factor, {},
          "kg in a cubic metre, for masses; 0: unknown"),
};

/// Patterns of two colours have these rows.
template <class Pattern>
inline constexpr auto color_a = field("color_a", &Pattern::color_a, brightness,
                                      {.alpha = "alpha_a"}, "");
template <class Pattern>
inline constexpr auto color_b = field("color_b", &Pattern::color_b, brightness,
                                      {.alpha = "alpha_b"}, "");
template <class Pattern>
inline constexpr auto scale = field("scale", &Pattern::scale, extent, {}, "");
template <class Pattern>
inline constexpr auto offset = field("offset", &Pattern::offset, point, {}, "");
template <class Pattern>
inline constexpr auto pattern_a = field("pattern_a", &Pattern::pattern_a, any,
                                        {.in_scripts = false}, "");
template <class Pattern>
inline constexpr auto pattern_b = field("pattern_b", &Pattern::pattern_b, any,
                                        {.in_scripts = false}, "");
template <class Pattern>
inline constexpr auto colors = field("colors", &Pattern::colors, any, {},
                                     "stops in the place of both");

inline constexpr Rule octaves = between(1, 16);

template <>
inline constexpr auto table<Checker> = Table{
    "Checker",       color_a<Checker>,   color_b<Checker>,   scale<Checker>,
    offset<Checker>, pattern_a<Checker>, pattern_b<Checker>,
};

template <>
inline constexpr auto table<Stripes> = Table{
    "Stripes",          color_a<Stripes>,
    color_b<Stripes>,   field("direction", &Stripes::direction, direction, {}, ""),
    scale<Stripes>,     offset<Stripes>,
    pattern_a<Stripes>, pattern_b<Stripes>,
};

template <>
inline constexpr auto table<Gradient> = Table{
    "Gradient",          color_a<Gradient>,
    color_b<Gradient>,   field("direction", &Gradient::direction, direction, {}, ""),
    scale<Gradient>,     offset<Gradient>,
    pattern_a<Gradient>, pattern_b<Gradient>,
    colors<Gradient>,
};

template <>
inline constexpr auto table<Noise> = Table{
    "Noise",
    color_a<Noise>,
    color_b<Noise>,
    field("octaves", &Noise::octaves, octaves, {}, "layers of detail, each half as large"),
    scale<Noise>,
    offset<Noise>,
    pattern_a<Noise>,
    pattern_b<Noise>,
    colors<Noise>,
};

template <>
inline constexpr auto table<Marble> = Table{
    "Marble",
    color_a<Marble>,
    color_b<Marble>,
    field("direction", &Marble::direction, direction, {}, ""),
    field("turbulence", &Marble::turbulence, factor, {}, "strength of the noise"),
    field("octaves", &Marble::octaves, octaves, {}, "layers of detail of the noise"),
    scale<Marble>,
    offset<Marble>,
    pattern_a<Marble>,
    pattern_b<Marble>,
    colors<Marble>,
};

template <>
inline constexpr auto table<Wood> = Table{
    "Wood",
    color_a<Wood>,
    color_b<Wood>,
    field("direction", &Wood::direction, direction, {}, ""),
    field("turbulence", &Wood::turbulence, factor, {}, "how uneven the rings are"),
    field("octaves", &Wood::octaves, octaves, {}, "layers of detail of that"),
    scale<Wood>,
    offset<Wood>,
    pattern_a<Wood>,
    pattern_b<Wood>,
    colors<Wood>,
};

template <>
inline constexpr auto table<ImageMap> = Table{
    "ImageMap",
    field("image", &ImageMap::image, any, required, "the picture's [file](#files)"),
    field("repeat_u", &ImageMap::repeat_u, above_0_to(largest_factor), {},
          "how often it is repeated around, above 0"),
    field("repeat_v", &ImageMap::repeat_v, above_0_to(largest_factor), {},
          "and from bottom to top"),
    field("mapping", &ImageMap::mapping, any, {}, "how it is laid over the surface, see below"),
    field("direction", &ImageMap::direction, direction, {},
          "of a planar mapping, or the axis of a cylindrical one"),
    field("scale", &ImageMap::scale, extent, {},
          "the picture's width and height in space, above 0"),
    field("offset", &ImageMap::offset, point, {}, "moves the picture in space"),
};

}  // namespace crt::schema
/// @endcond
