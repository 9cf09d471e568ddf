// This file converts settings and statistics from C to C++ and back.
#include "capi/structs.hpp"

namespace crt::capi {

namespace {

const char* text_or_empty(const char* text) {
  return text == nullptr ? "" : text;
}

}  // namespace

crt_settings to_c(const Settings& settings) {
  crt_settings out{};
  out.struct_size = sizeof out;
  out.width = settings.width;
  out.height = settings.height;
  out.supersampling = settings.supersampling;
  out.dof_samples = settings.dof_samples;
  out.recursion_depth = settings.recursion_depth;
  out.gamma = settings.gamma;
  out.min_weight = settings.min_weight;
  out.falloff_model = static_cast<std::int32_t>(settings.falloff_model);
  out.show_clip = settings.show_clip ? 1 : 0;
  out.seed = settings.seed;
  out.title = settings.title.c_str();
  out.author = settings.author.c_str();
  out.date = settings.date.c_str();
  out.notes = settings.notes.c_str();
  out.precision = static_cast<std::int32_t>(settings.precision);
  out.target_error = settings.target_error;
  out.time_budget = settings.time_budget;
  out.filter_width = settings.filter_width;
  out.min_samples = settings.min_samples;
  out.max_samples = settings.max_samples;
  out.filter = static_cast<std::int32_t>(settings.filter);
  out.compat = settings.compat;
  out.ambient_model = static_cast<std::int32_t>(settings.ambient_model);
  out.no_head_light = settings.head_light ? 0 : 1;
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

static_assert(static_cast<int>(FalloffModel::path) == CRT_FALLOFF_PATH);
static_assert(static_cast<int>(FalloffModel::light) == CRT_FALLOFF_LIGHT);
static_assert(static_cast<int>(AmbientModel::light) == CRT_AMBIENT_LIGHT);
static_assert(static_cast<int>(AmbientModel::surface) == CRT_AMBIENT_SURFACE);
static_assert(static_cast<int>(Precision::standard) == CRT_PRECISION_STANDARD);
static_assert(static_cast<int>(Precision::exact) == CRT_PRECISION_EXACT);
static_assert(static_cast<int>(PixelFilter::box) == CRT_FILTER_BOX);
static_assert(static_cast<int>(PixelFilter::blackman_harris) == CRT_FILTER_BLACKMAN_HARRIS);

Settings to_settings(const crt_settings* settings) {
  const auto given = taken(settings, "settings");
  Settings result;
  result.width = given.width;
  result.height = given.height;
  result.supersampling = given.supersampling;
  result.dof_samples = given.dof_samples;
  result.recursion_depth = given.recursion_depth;
  result.gamma = given.gamma;
  result.min_weight = given.min_weight;
  result.falloff_model = to_enum(given.falloff_model, FalloffModel::light, "settings.falloff_model",
                                 "crt_falloff_model");
  result.show_clip = given.show_clip != 0;
  result.seed = given.seed;
  result.title = text_or_empty(given.title);
  result.author = text_or_empty(given.author);
  result.date = text_or_empty(given.date);
  result.notes = text_or_empty(given.notes);
  result.precision =
      to_enum(given.precision, Precision::exact, "settings.precision", "crt_precision");
  result.target_error = given.target_error;
  result.time_budget = given.time_budget;
  result.filter_width = given.filter_width;
  result.min_samples = given.min_samples;
  result.max_samples = given.max_samples;
  result.filter =
      to_enum(given.filter, PixelFilter::blackman_harris, "settings.filter", "crt_pixel_filter");
  result.compat = given.compat;
  result.ambient_model = to_enum(given.ambient_model, AmbientModel::surface,
                                 "settings.ambient_model", "crt_ambient_model");
  result.head_light = given.no_head_light == 0;
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
