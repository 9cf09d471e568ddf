// This table of the schema is that of settings, a row a field (see crt/schema.hpp).
#pragma once

#include <crt/schema.hpp>
#include <crt/settings.hpp>

/// @cond tables
namespace crt::schema {

template <>
inline constexpr auto choices<PixelFilter> = choice("PixelFilter", "crt_pixel_filter", "CRT_FILTER",
                                                    "box", "blackman_harris");
template <>
inline constexpr auto choices<Cutoff> = choice("Cutoff", "crt_cutoff", "CRT_CUTOFF", "black",
                                               "background");
template <>
inline constexpr auto choices<FalloffModel> = choice("FalloffModel", "crt_falloff_model",
                                                     "CRT_FALLOFF", "path", "light");
template <>
inline constexpr auto choices<AmbientModel> = choice("AmbientModel", "crt_ambient_model",
                                                     "CRT_AMBIENT", "light", "surface");
template <>
inline constexpr auto choices<ToneMap> = choice("ToneMap", "crt_tone_map", "CRT_TONE_MAP", "none",
                                                "filmic");
template <>
inline constexpr auto choices<Precision> = choice("Precision", "crt_precision", "CRT_PRECISION",
                                                  "standard", "exact");
template <>
inline constexpr auto choices<Unit> = choice("Unit", "crt_unit", "CRT_UNIT", "m", "cm", "mm", "in");

template <>
inline constexpr auto table<Settings> = Table{
    "Settings",
    field("title", &Settings::title, any, {.option = "of the picture, kept in its file"},
          "written into the picture's file, as the next three are"),
    field("author", &Settings::author, any, {.option = "likewise"}, ""),
    field("date", &Settings::date, any, {.option = "likewise"}, ""),
    field("notes", &Settings::notes, any, {.option = "likewise"}, ""),
    field("width", &Settings::width, between(1, 65536), {.option = "pixels across"},
          "pixels, 1 to 65536"),
    field("height", &Settings::height, between(1, 65536), {.option = "pixels down"},
          "likewise; width times height at most 2^27"),
    field("gamma", &Settings::gamma, between(0.1, 10),
          {.option = "8-bit files store value^(1/gamma)"},
          "of 8- and 16-bit files, 0.1 to 10; see below"),
    field("exposure", &Settings::exposure, between(-100, 100),
          {.option = "stops that pictures are brighter by, but not float files"},
          "stops by which these files are brighter, -100 to 100; see below"),
    field("tone_map", &Settings::tone_map, any,
          {.option = "none, or filmic: highlights fade out instead of clipping"},
          "`\"none\"` or `\"filmic\"`, see below"),
    field("supersampling", &Settings::supersampling, between(1, 64),
          {.option = "n x n rays for each pixel"}, "n x n rays for each pixel, 1 to 64"),
    field("dof_samples", &Settings::dof_samples, between(1, 65536),
          {.option = "points of the lens for each of them"},
          "points of the lens for each, 1 to 65536; 1: no lens"),
    field("light_samples", &Settings::light_samples, between(1, 1024),
          {.option = "samples of lights that have a size, for each ray"},
          "samples of lights that have a size, for each ray, 1 to 1024"),
    field("target_error", &Settings::target_error, share,
          {.option = "samples until pixels are this near the truth; 0.004 is an 8-bit step"},
          "above 0: how near the truth each pixel must be, 0 to 1; see below"),
    field("time_budget", &Settings::time_budget, between(0, 1e6),
          {.option = "samples for so many seconds of tracing"},
          "above 0: the seconds that tracing may take, 0 to 1e6; see below"),
    field("min_samples", &Settings::min_samples, power_of_two(4, 65536),
          {.option = "of a pixel, with one of these two: a power of 2"},
          "of a pixel, with one of these two: a power of 2, 4 to 65536"),
    field("max_samples", &Settings::max_samples, power_of_two(4, 65536), {.option = "likewise"},
          "likewise, at least `minsamples`"),
    field("filter", &Settings::filter, any,
          {.option = "what a pixel is the mean of: box or blackmanharris"},
          "what a pixel is the mean of, see below"),
    field("filter_width", &Settings::filter_width, between(1, 16),
          {.option = "pixels across, of filters other than the box"},
          "of the bell, in pixels, 1 to 16"),
    field("recursion_depth", &Settings::recursion_depth, between(0, 256),
          {.option = "bounces followed after the camera's ray"},
          "bounces that are followed, 0 to 256"),
    field("indirect", &Settings::indirect, between(0, 64),
          {.option = "diffuse bounces that light is followed over"},
          "diffuse bounces that light is followed over, 0 to 64"),
    field("min_weight", &Settings::min_weight, share,
          {.default_text = "1.0 / 1024",
           .option = "rays that add less than this share are not followed"},
          "rays of a smaller share of the pixel end, 0 to 1"),
    field("clamp", &Settings::clamp, factor,
          {.option = "above 0: the most that bounced light may show"},
          "above 0: the most that light by bounces may be; see below"),
    field("denoise", &Settings::denoise, any,
          {.option = "frees the finished picture of noise, without a claim; see docs/image.md"},
          "whether the finished picture is freed of noise; see below"),
    field("cutoff", &Settings::cutoff, any, {.option = "what ended rays see: black or background"},
          "`\"black\"` or `\"background\"`: what rays see that end there"),
    field("falloff_model", &Settings::falloff_model, any,
          {.option = "distance that dims a light: path or light"},
          "`\"path\"` or `\"light\"`, see below"),
    field("ambient_model", &Settings::ambient_model, any,
          {.option = "light, or surface: ambient light takes its colour"},
          "`\"light\"` or `\"surface\"`, see below"),
    field("head_light", &Settings::head_light, any,
          // In C it is 0 for true.
          {.c = "no_head_light",
           .option = "lights scenes without lights from the camera; --headlight=false does not"},
          "whether a scene without lights is lit from the camera"),
    field("show_clip", &Settings::show_clip, any,
          {.option = "marks pixels brighter than white in red; --showclip=false does not"},
          "marks pixels that are brighter than white in red"),
    field("seed", &Settings::seed, any, {.option = "another seed, another noise"},
          "of the renderer's random numbers, at least 0; not of `rand`"),
    field("precision", &Settings::precision, any,
          {.option = "standard, or exact: whether a line hits is always right"},
          "`\"standard\"` or `\"exact\"`, see below"),
    field("compat", &Settings::compat, any, {},
          "`2015` for a [script of that year](compat.md), see below"),
    field("unit", &Settings::unit, any, {.option = "what a scene unit is: m, cm, mm or in"},
          "what a scene unit is: `\"m\"`, `\"cm\"`, `\"mm\"` or `\"in\"`"),
    field("frames", &Settings::frames, between(0, 1e6), {},
          "of a film, `t` from 0 to `frames` - 1; 0: not said"),
};

}  // namespace crt::schema
/// @endcond
