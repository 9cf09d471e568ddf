// This file converts settings and statistics from C to C++ and back.
#include "capi/fields.hpp"
#include "capi/structs.hpp"
#include "crt/schema_settings.hpp"

namespace crt::capi {

crt_settings to_c(const Settings& settings) {
  crt_settings out{};
  out.struct_size = sizeof out;
  put_fields(out, settings);
  return out;
}

template <>
crt_settings defaults_of_size<crt_settings>(std::size_t size) {
  // In version 1.0, whose struct ends before this field, the defaults were those of 2015.
  constexpr std::size_t size_in_1_0 = offsetof(crt_settings, precision);
  Settings settings = size == size_in_1_0 ? settings_of_2015() : Settings{};
  settings.compat = 0;
  crt_settings out = to_c(settings);
  out.title = out.author = out.date = out.notes = nullptr;
  return out;
}

template <>
crt_settings defaults<crt_settings>() {
  return defaults_of_size<crt_settings>(sizeof(crt_settings));
}

static_assert(static_cast<int>(FalloffModel::light) == CRT_FALLOFF_LIGHT);
static_assert(static_cast<int>(AmbientModel::surface) == CRT_AMBIENT_SURFACE);
static_assert(static_cast<int>(ToneMap::filmic) == CRT_TONE_MAP_FILMIC);
static_assert(static_cast<int>(Precision::exact) == CRT_PRECISION_EXACT);
static_assert(static_cast<int>(Unit::in) == CRT_UNIT_IN);
static_assert(static_cast<int>(PixelFilter::blackman_harris) == CRT_FILTER_BLACKMAN_HARRIS);

Settings to_settings(const crt_settings* settings) {
  Settings result;
  take_fields(result, taken(settings, "settings"), "settings");
  return result;
}

crt_render_stats to_c(const RenderStats& stats) {
  crt_render_stats out{};
  out.struct_size = sizeof out;
  out.threads = stats.threads;
  out.pixels = stats.pixels;
  out.camera_rays = stats.camera_rays;
  out.shadow_rays = stats.shadow_rays;
  out.reflection_rays = stats.reflection_rays;
  out.refraction_rays = stats.refraction_rays;
  out.rays_below_min_weight = stats.rays_below_min_weight;
  out.rays_beyond_depth = stats.rays_beyond_depth;
  out.samples_over_ray_bound = stats.samples_over_ray_bound;
  out.intersection_tests = stats.intersection_tests;
  out.interval_events = stats.interval_events;
  out.media_lookups = stats.media_lookups;
  out.media_changes = stats.media_changes;
  out.pattern_lookups = stats.pattern_lookups;
  out.lens_samples = stats.lens_samples;
  out.prepare_seconds = stats.prepare_seconds;
  out.trace_seconds = stats.trace_seconds;
  out.escalations = stats.escalations;
  out.primitive_bytes = stats.memory.primitives;
  out.csg_bytes = stats.memory.csg;
  out.tree_bytes = stats.memory.tree;
  out.material_bytes = stats.memory.materials;
  out.samples_min = stats.samples_min;
  out.samples_mean = stats.samples_mean;
  out.samples_max = stats.samples_max;
  out.passes = stats.passes;
  out.half_width_rms = stats.half_width_rms;
  out.half_width_95 = stats.half_width_95;
  out.half_width_max = stats.half_width_max;
  out.pixels_unresolved = stats.pixels_unresolved;
  out.unseen_share = stats.unseen_share;
  out.cutoff_mean = stats.cutoff_mean;
  out.cutoff_max = stats.cutoff_max;
  out.undecided = stats.undecided;
  return out;
}

}  // namespace crt::capi
