// This file lists where the fields of the growable structs end, and has their crt_*_init functions.
#include "capi/structs.hpp"

// A field missing here would be read and written with the next one; the test of the layout finds
// it.
#define CRT_END(Struct, field) (offsetof(Struct, field) + sizeof(decltype(Struct::field)))

namespace crt::capi {

template <>
std::span<const std::size_t> field_ends<crt_pattern>() {
  using S = crt_pattern;
  static constexpr std::array ends = {
      CRT_END(S, type),      CRT_END(S, color_a),   CRT_END(S, alpha_a),
      CRT_END(S, color_b),   CRT_END(S, alpha_b),   CRT_END(S, direction),
      CRT_END(S, offset),    CRT_END(S, scale),     CRT_END(S, turbulence),
      CRT_END(S, octaves),   CRT_END(S, reserved),  CRT_END(S, image),
      CRT_END(S, repeat_u),  CRT_END(S, repeat_v),  CRT_END(S, pattern_a),
      CRT_END(S, pattern_b), CRT_END(S, colors),    CRT_END(S, color_count),
      CRT_END(S, mapping),   CRT_END(S, reserved_2)};
  return ends;
}

template <>
std::span<const std::size_t> field_ends<crt_material>() {
  using S = crt_material;
  static constexpr std::array ends = {
      CRT_END(S, reserved),         CRT_END(S, color),        CRT_END(S, alpha),
      CRT_END(S, pattern),          CRT_END(S, reflectivity), CRT_END(S, transparency),
      CRT_END(S, refractive_index), CRT_END(S, diffuse),      CRT_END(S, specular),
      CRT_END(S, shininess),        CRT_END(S, absorption),   CRT_END(S, bump),
      CRT_END(S, bump_height)};
  return ends;
}

template <>
std::span<const std::size_t> field_ends<crt_mesh>() {
  using S = crt_mesh;
  static constexpr std::array ends = {CRT_END(S, reserved),
                                      CRT_END(S, positions),
                                      CRT_END(S, vertex_count),
                                      CRT_END(S, indices),
                                      CRT_END(S, triangle_count),
                                      CRT_END(S, normals),
                                      CRT_END(S, normal_count),
                                      CRT_END(S, normal_indices),
                                      CRT_END(S, uv),
                                      CRT_END(S, uv_count),
                                      CRT_END(S, uv_indices),
                                      CRT_END(S, materials),
                                      CRT_END(S, material_count),
                                      CRT_END(S, material_of_triangle),
                                      CRT_END(S, smooth)};
  return ends;
}

template <>
std::span<const std::size_t> field_ends<crt_mesh_options>() {
  using S = crt_mesh_options;
  static constexpr std::array ends = {CRT_END(S, fill), CRT_END(S, weld), CRT_END(S, stitch)};
  return ends;
}

template <>
std::span<const std::size_t> field_ends<crt_mesh_report>() {
  using S = crt_mesh_report;
  static constexpr std::array ends = {CRT_END(S, fill),
                                      CRT_END(S, welded_vertices),
                                      CRT_END(S, welded_triangles),
                                      CRT_END(S, stitched_vertices),
                                      CRT_END(S, repeated_triangles),
                                      CRT_END(S, first_repeated),
                                      CRT_END(S, shells),
                                      CRT_END(S, overlapping_shells),
                                      CRT_END(S, first_overlap)};
  return ends;
}

template <>
std::span<const std::size_t> field_ends<crt_custom>() {
  using S = crt_custom;
  static constexpr std::array ends = {
      CRT_END(S, face_count), CRT_END(S, lower),   CRT_END(S, upper), CRT_END(S, crossings),
      CRT_END(S, point),      CRT_END(S, release), CRT_END(S, user),  CRT_END(S, name)};
  return ends;
}

template <>
std::span<const std::size_t> field_ends<crt_light>() {
  using S = crt_light;
  static constexpr std::array ends = {CRT_END(S, type),   CRT_END(S, origin),  CRT_END(S, pointing),
                                      CRT_END(S, color),  CRT_END(S, angle),   CRT_END(S, penumbra),
                                      CRT_END(S, radius), CRT_END(S, falloff), CRT_END(S, ambient)};
  return ends;
}

template <>
std::span<const std::size_t> field_ends<crt_camera>() {
  using S = crt_camera;
  static constexpr std::array ends = {CRT_END(S, projection),     CRT_END(S, position),
                                      CRT_END(S, pointing),       CRT_END(S, fov),
                                      CRT_END(S, roll),           CRT_END(S, aperture),
                                      CRT_END(S, focal_distance), CRT_END(S, aperture_shape),
                                      CRT_END(S, reserved),       CRT_END(S, lens_radius)};
  return ends;
}

template <>
std::span<const std::size_t> field_ends<crt_background>() {
  using S = crt_background;
  static constexpr std::array ends = {
      CRT_END(S, type),      CRT_END(S, color),         CRT_END(S, alpha),
      CRT_END(S, horizon),   CRT_END(S, horizon_alpha), CRT_END(S, sky),
      CRT_END(S, sky_alpha), CRT_END(S, image),         CRT_END(S, angle)};
  return ends;
}

template <>
std::span<const std::size_t> field_ends<crt_settings>() {
  using S = crt_settings;
  static constexpr std::array ends = {
      CRT_END(S, width),        CRT_END(S, height),          CRT_END(S, supersampling),
      CRT_END(S, dof_samples),  CRT_END(S, recursion_depth), CRT_END(S, gamma),
      CRT_END(S, min_weight),   CRT_END(S, falloff_model),   CRT_END(S, show_clip),
      CRT_END(S, seed),         CRT_END(S, title),           CRT_END(S, author),
      CRT_END(S, date),         CRT_END(S, notes),           CRT_END(S, precision),
      CRT_END(S, reserved),     CRT_END(S, target_error),    CRT_END(S, time_budget),
      CRT_END(S, filter_width), CRT_END(S, min_samples),     CRT_END(S, max_samples),
      CRT_END(S, filter),       CRT_END(S, reserved_2),      CRT_END(S, compat),
      CRT_END(S, reserved_3),   CRT_END(S, ambient_model),   CRT_END(S, no_head_light)};
  return ends;
}

template <>
std::span<const std::size_t> field_ends<crt_script_options>() {
  using S = crt_script_options;
  static constexpr std::array ends = {CRT_END(S, allow_outside_files),
                                      CRT_END(S, resource_directories),
                                      CRT_END(S, resource_directory_count),
                                      CRT_END(S, t),
                                      CRT_END(S, variable_names),
                                      CRT_END(S, variable_values),
                                      CRT_END(S, variable_count),
                                      CRT_END(S, setting_names),
                                      CRT_END(S, setting_values),
                                      CRT_END(S, setting_count),
                                      CRT_END(S, max_steps),
                                      CRT_END(S, max_entities),
                                      CRT_END(S, max_call_depth),
                                      CRT_END(S, max_list_length),
                                      CRT_END(S, max_string_bytes),
                                      CRT_END(S, max_memory_bytes),
                                      CRT_END(S, max_source_bytes),
                                      CRT_END(S, max_errors),
                                      CRT_END(S, open_file),
                                      CRT_END(S, open_file_user),
                                      CRT_END(S, print),
                                      CRT_END(S, print_user),
                                      CRT_END(S, poll),
                                      CRT_END(S, poll_user),
                                      CRT_END(S, compat),
                                      CRT_END(S, reserved),
                                      CRT_END(S, max_image_pixels)};
  return ends;
}

template <>
std::span<const std::size_t> field_ends<crt_diagnostic>() {
  using S = crt_diagnostic;
  static constexpr std::array ends = {
      CRT_END(S, severity), CRT_END(S, status),      CRT_END(S, line),
      CRT_END(S, column),   CRT_END(S, length),      CRT_END(S, message),
      CRT_END(S, file),     CRT_END(S, source_line), CRT_END(S, call_count)};
  return ends;
}

template <>
std::span<const std::size_t> field_ends<crt_diagnostic_call>() {
  using S = crt_diagnostic_call;
  static constexpr std::array ends = {CRT_END(S, line), CRT_END(S, column), CRT_END(S, reserved),
                                      CRT_END(S, name), CRT_END(S, file)};
  return ends;
}

template <>
std::span<const std::size_t> field_ends<crt_render_options>() {
  using S = crt_render_options;
  static constexpr std::array ends = {
      CRT_END(S, threads),      CRT_END(S, region_x),      CRT_END(S, region_y),
      CRT_END(S, region_width), CRT_END(S, region_height), CRT_END(S, seed),
      CRT_END(S, progress),     CRT_END(S, progress_user), CRT_END(S, log),
      CRT_END(S, log_user),     CRT_END(S, passes),        CRT_END(S, aovs),
      CRT_END(S, checkpoint),   CRT_END(S, max_ray_steps)};
  return ends;
}

template <>
std::span<const std::size_t> field_ends<crt_prepare_options>() {
  using S = crt_prepare_options;
  static constexpr std::array ends = {CRT_END(S, reserved), CRT_END(S, poll), CRT_END(S, poll_user),
                                      CRT_END(S, max_primitives)};
  return ends;
}

template <>
std::span<const std::size_t> field_ends<crt_render_stats>() {
  using S = crt_render_stats;
  static constexpr std::array ends = {CRT_END(S, threads),
                                      CRT_END(S, pixels),
                                      CRT_END(S, camera_rays),
                                      CRT_END(S, shadow_rays),
                                      CRT_END(S, reflection_rays),
                                      CRT_END(S, refraction_rays),
                                      CRT_END(S, rays_below_min_weight),
                                      CRT_END(S, rays_beyond_depth),
                                      CRT_END(S, samples_over_ray_bound),
                                      CRT_END(S, intersection_tests),
                                      CRT_END(S, interval_events),
                                      CRT_END(S, media_lookups),
                                      CRT_END(S, media_changes),
                                      CRT_END(S, pattern_lookups),
                                      CRT_END(S, lens_samples),
                                      CRT_END(S, prepare_seconds),
                                      CRT_END(S, trace_seconds),
                                      CRT_END(S, escalations),
                                      CRT_END(S, primitive_bytes),
                                      CRT_END(S, csg_bytes),
                                      CRT_END(S, tree_bytes),
                                      CRT_END(S, material_bytes),
                                      CRT_END(S, samples_min),
                                      CRT_END(S, samples_mean),
                                      CRT_END(S, samples_max),
                                      CRT_END(S, passes),
                                      CRT_END(S, reserved),
                                      CRT_END(S, half_width_rms),
                                      CRT_END(S, half_width_95),
                                      CRT_END(S, half_width_max),
                                      CRT_END(S, pixels_unresolved),
                                      CRT_END(S, unseen_share),
                                      CRT_END(S, cutoff_mean),
                                      CRT_END(S, cutoff_max),
                                      CRT_END(S, undecided)};
  return ends;
}

template <>
std::span<const std::size_t> field_ends<crt_write_options>() {
  static constexpr std::array ends = {CRT_END(crt_write_options, reproducible),
                                      CRT_END(crt_write_options, colors_only)};
  return ends;
}

template <>
std::span<const std::size_t> field_ends<crt_farm_options>() {
  using S = crt_farm_options;
  static constexpr std::array ends = {
      CRT_END(S, has_frames), CRT_END(S, first_frame),   CRT_END(S, last_frame),
      CRT_END(S, tasks),      CRT_END(S, tile_width),    CRT_END(S, tile_height),
      CRT_END(S, reserved),   CRT_END(S, least_seconds), CRT_END(S, script),
      CRT_END(S, render),     CRT_END(S, max_primitives)};
  return ends;
}

template <>
std::span<const std::size_t> field_ends<crt_farm_job>() {
  using S = crt_farm_job;
  static constexpr std::array ends = {
      CRT_END(S, tasks),      CRT_END(S, has_frames),     CRT_END(S, first_frame),
      CRT_END(S, last_frame), CRT_END(S, width),          CRT_END(S, height),
      CRT_END(S, passes),     CRT_END(S, has_channels),   CRT_END(S, reserved),
      CRT_END(S, seconds),    CRT_END(S, longest_seconds)};
  return ends;
}

template <>
std::span<const std::size_t> field_ends<crt_farm_work_options>() {
  using S = crt_farm_work_options;
  static constexpr std::array ends = {CRT_END(S, threads), CRT_END(S, progress),
                                      CRT_END(S, progress_user)};
  return ends;
}

template <>
std::span<const std::size_t> field_ends<crt_farm_merge_options>() {
  using S = crt_farm_merge_options;
  static constexpr std::array ends = {
      CRT_END(S, reserved), CRT_END(S, output),      CRT_END(S, skip), CRT_END(S, skip_count),
      CRT_END(S, report),   CRT_END(S, report_user), CRT_END(S, poll), CRT_END(S, poll_user)};
  return ends;
}

template <>
std::span<const std::size_t> field_ends<crt_farm_progress>() {
  using S = crt_farm_progress;
  static constexpr std::array ends = {CRT_END(S, waiting),       CRT_END(S, running),
                                      CRT_END(S, lost),          CRT_END(S, done),
                                      CRT_END(S, reserved),      CRT_END(S, share),
                                      CRT_END(S, seconds_spent), CRT_END(S, seconds_left)};
  return ends;
}

// The defaults of these structs are all 0.
template <>
crt_script_options defaults<crt_script_options>() {
  return {};
}
template <>
crt_render_options defaults<crt_render_options>() {
  return {};
}
template <>
crt_prepare_options defaults<crt_prepare_options>() {
  return {};
}
template <>
crt_write_options defaults<crt_write_options>() {
  return {};
}
template <>
crt_farm_options defaults<crt_farm_options>() {
  return {};
}
template <>
crt_farm_work_options defaults<crt_farm_work_options>() {
  return {};
}
template <>
crt_farm_merge_options defaults<crt_farm_merge_options>() {
  return {};
}

}  // namespace crt::capi

using namespace crt::capi;

crt_status crt_pattern_init(crt_pattern* pattern, size_t struct_size) {
  return guarded([&] { initialise(pattern, struct_size, defaults<crt_pattern>()); });
}

crt_status crt_pattern_init_type(crt_pattern* pattern, size_t struct_size, int32_t type) {
  return guarded([&] { initialise(pattern, struct_size, default_pattern(type)); });
}

crt_status crt_material_init(crt_material* material, size_t struct_size) {
  return guarded([&] { initialise(material, struct_size, defaults<crt_material>()); });
}

crt_status crt_light_init(crt_light* light, size_t struct_size) {
  return guarded([&] { initialise(light, struct_size, defaults<crt_light>()); });
}

crt_status crt_light_init_type(crt_light* light, size_t struct_size, int32_t type) {
  return guarded([&] { initialise(light, struct_size, default_light(type)); });
}

crt_status crt_camera_init(crt_camera* camera, size_t struct_size) {
  return guarded([&] { initialise(camera, struct_size, defaults<crt_camera>()); });
}

crt_status crt_background_init(crt_background* background, size_t struct_size) {
  return guarded([&] { initialise(background, struct_size, defaults<crt_background>()); });
}

crt_status crt_settings_init(crt_settings* settings, size_t struct_size) {
  return guarded(
      [&] { initialise(settings, struct_size, defaults_of_size<crt_settings>(struct_size)); });
}

crt_status crt_script_options_init(crt_script_options* options, size_t struct_size) {
  return guarded([&] { initialise(options, struct_size, defaults<crt_script_options>()); });
}

crt_status crt_render_options_init(crt_render_options* options, size_t struct_size) {
  return guarded([&] { initialise(options, struct_size, defaults<crt_render_options>()); });
}

crt_status crt_prepare_options_init(crt_prepare_options* options, size_t struct_size) {
  return guarded([&] { initialise(options, struct_size, defaults<crt_prepare_options>()); });
}

crt_status crt_write_options_init(crt_write_options* options, size_t struct_size) {
  return guarded([&] { initialise(options, struct_size, defaults<crt_write_options>()); });
}

crt_status crt_farm_options_init(crt_farm_options* options, size_t struct_size) {
  return guarded([&] { initialise(options, struct_size, defaults<crt_farm_options>()); });
}

crt_status crt_farm_work_options_init(crt_farm_work_options* options, size_t struct_size) {
  return guarded([&] { initialise(options, struct_size, defaults<crt_farm_work_options>()); });
}

crt_status crt_farm_merge_options_init(crt_farm_merge_options* options, size_t struct_size) {
  return guarded([&] { initialise(options, struct_size, defaults<crt_farm_merge_options>()); });
}
