// This file lists the fields of the growable structs, and has their crt_*_init functions.
#include "capi/structs.hpp"

namespace crt::capi {

template <>
std::span<const CField> c_fields<crt_pattern>() {
  using S = crt_pattern;
  static constexpr std::array fields = {
      CRT_FIELD(S, type),      CRT_FIELD(S, color_a),   CRT_FIELD(S, alpha_a),
      CRT_FIELD(S, color_b),   CRT_FIELD(S, alpha_b),   CRT_FIELD(S, direction),
      CRT_FIELD(S, offset),    CRT_FIELD(S, scale),     CRT_FIELD(S, turbulence),
      CRT_FIELD(S, octaves),   CRT_FIELD(S, reserved),  CRT_FIELD(S, image),
      CRT_FIELD(S, repeat_u),  CRT_FIELD(S, repeat_v),  CRT_FIELD(S, pattern_a),
      CRT_FIELD(S, pattern_b), CRT_FIELD(S, colors),    CRT_FIELD(S, color_count),
      CRT_FIELD(S, mapping),   CRT_FIELD(S, reserved_2)};
  return fields;
}

template <>
std::span<const CField> c_fields<crt_material>() {
  using S = crt_material;
  static constexpr std::array fields = {
      CRT_FIELD(S, reserved),         CRT_FIELD(S, color),        CRT_FIELD(S, alpha),
      CRT_FIELD(S, pattern),          CRT_FIELD(S, reflectivity), CRT_FIELD(S, transparency),
      CRT_FIELD(S, refractive_index), CRT_FIELD(S, diffuse),      CRT_FIELD(S, specular),
      CRT_FIELD(S, shininess),        CRT_FIELD(S, absorption),   CRT_FIELD(S, bump),
      CRT_FIELD(S, bump_height),      CRT_FIELD(S, emission),     CRT_FIELD(S, density)};
  return fields;
}

template <>
std::span<const CField> c_fields<crt_principled>() {
  using S = crt_principled;
  static constexpr std::array fields = {
      CRT_FIELD(S, reserved),       CRT_FIELD(S, color),         CRT_FIELD(S, pattern),
      CRT_FIELD(S, metallic),       CRT_FIELD(S, roughness),     CRT_FIELD(S, refractive_index),
      CRT_FIELD(S, transmission),   CRT_FIELD(S, absorption),    CRT_FIELD(S, coat),
      CRT_FIELD(S, coat_roughness), CRT_FIELD(S, sheen),         CRT_FIELD(S, emission),
      CRT_FIELD(S, metallic_map),   CRT_FIELD(S, roughness_map), CRT_FIELD(S, emission_map),
      CRT_FIELD(S, bump),           CRT_FIELD(S, normal_map),    CRT_FIELD(S, bump_height),
      CRT_FIELD(S, density)};
  return fields;
}

template <>
std::span<const CField> c_fields<crt_mesh>() {
  using S = crt_mesh;
  static constexpr std::array fields = {CRT_FIELD(S, reserved),
                                        CRT_FIELD(S, positions),
                                        CRT_FIELD(S, vertex_count),
                                        CRT_FIELD(S, indices),
                                        CRT_FIELD(S, triangle_count),
                                        CRT_FIELD(S, normals),
                                        CRT_FIELD(S, normal_count),
                                        CRT_FIELD(S, normal_indices),
                                        CRT_FIELD(S, uv),
                                        CRT_FIELD(S, uv_count),
                                        CRT_FIELD(S, uv_indices),
                                        CRT_FIELD(S, materials),
                                        CRT_FIELD(S, material_count),
                                        CRT_FIELD(S, material_of_triangle),
                                        CRT_FIELD(S, smooth),
                                        CRT_FIELD(S, principled)};
  return fields;
}

template <>
std::span<const CField> c_fields<crt_mesh_options>() {
  using S = crt_mesh_options;
  static constexpr std::array fields = {CRT_FIELD(S, fill), CRT_FIELD(S, weld),
                                        CRT_FIELD(S, stitch)};
  return fields;
}

template <>
std::span<const CField> c_fields<crt_mesh_report>() {
  using S = crt_mesh_report;
  static constexpr std::array fields = {CRT_FIELD(S, fill),
                                        CRT_FIELD(S, welded_vertices),
                                        CRT_FIELD(S, welded_triangles),
                                        CRT_FIELD(S, stitched_vertices),
                                        CRT_FIELD(S, repeated_triangles),
                                        CRT_FIELD(S, first_repeated),
                                        CRT_FIELD(S, shells),
                                        CRT_FIELD(S, overlapping_shells),
                                        CRT_FIELD(S, first_overlap)};
  return fields;
}

template <>
std::span<const CField> c_fields<crt_custom>() {
  using S = crt_custom;
  static constexpr std::array fields = {
      CRT_FIELD(S, face_count), CRT_FIELD(S, lower),   CRT_FIELD(S, upper), CRT_FIELD(S, crossings),
      CRT_FIELD(S, point),      CRT_FIELD(S, release), CRT_FIELD(S, user),  CRT_FIELD(S, name)};
  return fields;
}

template <>
std::span<const CField> c_fields<crt_light>() {
  using S = crt_light;
  static constexpr std::array fields = {
      CRT_FIELD(S, type),      CRT_FIELD(S, origin),  CRT_FIELD(S, pointing),
      CRT_FIELD(S, color),     CRT_FIELD(S, angle),   CRT_FIELD(S, penumbra),
      CRT_FIELD(S, radius),    CRT_FIELD(S, falloff), CRT_FIELD(S, ambient),
      CRT_FIELD(S, edge_a),    CRT_FIELD(S, edge_b),  CRT_FIELD(S, visible),
      CRT_FIELD(S, two_sided), CRT_FIELD(S, scale)};
  return fields;
}

template <>
std::span<const CField> c_fields<crt_camera>() {
  using S = crt_camera;
  static constexpr std::array fields = {CRT_FIELD(S, projection),     CRT_FIELD(S, position),
                                        CRT_FIELD(S, pointing),       CRT_FIELD(S, fov),
                                        CRT_FIELD(S, roll),           CRT_FIELD(S, aperture),
                                        CRT_FIELD(S, focal_distance), CRT_FIELD(S, aperture_shape),
                                        CRT_FIELD(S, reserved),       CRT_FIELD(S, lens_radius),
                                        CRT_FIELD(S, section_normal), CRT_FIELD(S, section_offset),
                                        CRT_FIELD(S, section_hatch)};
  return fields;
}

template <>
std::span<const CField> c_fields<crt_background>() {
  using S = crt_background;
  static constexpr std::array fields = {
      CRT_FIELD(S, type),      CRT_FIELD(S, color),         CRT_FIELD(S, alpha),
      CRT_FIELD(S, horizon),   CRT_FIELD(S, horizon_alpha), CRT_FIELD(S, sky),
      CRT_FIELD(S, sky_alpha), CRT_FIELD(S, image),         CRT_FIELD(S, angle),
      CRT_FIELD(S, sun),       CRT_FIELD(S, turbidity),     CRT_FIELD(S, scale),
      CRT_FIELD(S, ground),    CRT_FIELD(S, shines),        CRT_FIELD(S, reserved)};
  return fields;
}

template <>
std::span<const CField> c_fields<crt_settings>() {
  using S = crt_settings;
  static constexpr std::array fields = {CRT_FIELD(S, width),
                                        CRT_FIELD(S, height),
                                        CRT_FIELD(S, supersampling),
                                        CRT_FIELD(S, dof_samples),
                                        CRT_FIELD(S, recursion_depth),
                                        CRT_FIELD(S, gamma),
                                        CRT_FIELD(S, min_weight),
                                        CRT_FIELD(S, falloff_model),
                                        CRT_FIELD(S, show_clip),
                                        CRT_FIELD(S, seed),
                                        CRT_FIELD(S, title),
                                        CRT_FIELD(S, author),
                                        CRT_FIELD(S, date),
                                        CRT_FIELD(S, notes),
                                        CRT_FIELD(S, precision),
                                        CRT_FIELD(S, reserved),
                                        CRT_FIELD(S, target_error),
                                        CRT_FIELD(S, time_budget),
                                        CRT_FIELD(S, filter_width),
                                        CRT_FIELD(S, min_samples),
                                        CRT_FIELD(S, max_samples),
                                        CRT_FIELD(S, filter),
                                        CRT_FIELD(S, reserved_2),
                                        CRT_FIELD(S, compat),
                                        CRT_FIELD(S, reserved_3),
                                        CRT_FIELD(S, ambient_model),
                                        CRT_FIELD(S, no_head_light),
                                        CRT_FIELD(S, indirect),
                                        CRT_FIELD(S, light_samples),
                                        CRT_FIELD(S, tone_map),
                                        CRT_FIELD(S, cutoff),
                                        CRT_FIELD(S, exposure),
                                        CRT_FIELD(S, clamp),
                                        CRT_FIELD(S, denoise),
                                        CRT_FIELD(S, unit),
                                        CRT_FIELD(S, frames),
                                        CRT_FIELD(S, reserved_4)};
  return fields;
}

template <>
std::span<const CField> c_fields<crt_script_options>() {
  using S = crt_script_options;
  static constexpr std::array fields = {CRT_FIELD(S, allow_outside_files),
                                        CRT_FIELD(S, resource_directories),
                                        CRT_FIELD(S, resource_directory_count),
                                        CRT_FIELD(S, t),
                                        CRT_FIELD(S, variable_names),
                                        CRT_FIELD(S, variable_values),
                                        CRT_FIELD(S, variable_count),
                                        CRT_FIELD(S, setting_names),
                                        CRT_FIELD(S, setting_values),
                                        CRT_FIELD(S, setting_count),
                                        CRT_FIELD(S, max_steps),
                                        CRT_FIELD(S, max_entities),
                                        CRT_FIELD(S, max_call_depth),
                                        CRT_FIELD(S, max_list_length),
                                        CRT_FIELD(S, max_string_bytes),
                                        CRT_FIELD(S, max_memory_bytes),
                                        CRT_FIELD(S, max_source_bytes),
                                        CRT_FIELD(S, max_errors),
                                        CRT_FIELD(S, open_file),
                                        CRT_FIELD(S, open_file_user),
                                        CRT_FIELD(S, print),
                                        CRT_FIELD(S, print_user),
                                        CRT_FIELD(S, poll),
                                        CRT_FIELD(S, poll_user),
                                        CRT_FIELD(S, compat),
                                        CRT_FIELD(S, reserved),
                                        CRT_FIELD(S, max_image_pixels)};
  return fields;
}

template <>
std::span<const CField> c_fields<crt_diagnostic>() {
  using S = crt_diagnostic;
  static constexpr std::array fields = {
      CRT_FIELD(S, severity), CRT_FIELD(S, status),      CRT_FIELD(S, line),
      CRT_FIELD(S, column),   CRT_FIELD(S, length),      CRT_FIELD(S, message),
      CRT_FIELD(S, file),     CRT_FIELD(S, source_line), CRT_FIELD(S, call_count)};
  return fields;
}

template <>
std::span<const CField> c_fields<crt_diagnostic_call>() {
  using S = crt_diagnostic_call;
  static constexpr std::array fields = {CRT_FIELD(S, line), CRT_FIELD(S, column),
                                        CRT_FIELD(S, reserved), CRT_FIELD(S, name),
                                        CRT_FIELD(S, file)};
  return fields;
}

template <>
std::span<const CField> c_fields<crt_render_options>() {
  using S = crt_render_options;
  static constexpr std::array fields = {
      CRT_FIELD(S, threads),      CRT_FIELD(S, region_x),      CRT_FIELD(S, region_y),
      CRT_FIELD(S, region_width), CRT_FIELD(S, region_height), CRT_FIELD(S, seed),
      CRT_FIELD(S, progress),     CRT_FIELD(S, progress_user), CRT_FIELD(S, log),
      CRT_FIELD(S, log_user),     CRT_FIELD(S, passes),        CRT_FIELD(S, aovs),
      CRT_FIELD(S, checkpoint),   CRT_FIELD(S, max_ray_steps)};
  return fields;
}

template <>
std::span<const CField> c_fields<crt_prepare_options>() {
  using S = crt_prepare_options;
  static constexpr std::array fields = {CRT_FIELD(S, reserved), CRT_FIELD(S, poll),
                                        CRT_FIELD(S, poll_user), CRT_FIELD(S, max_primitives),
                                        CRT_FIELD(S, previous)};
  return fields;
}

template <>
std::span<const CField> c_fields<crt_render_stats>() {
  using S = crt_render_stats;
  static constexpr std::array fields = {CRT_FIELD(S, threads),
                                        CRT_FIELD(S, pixels),
                                        CRT_FIELD(S, camera_rays),
                                        CRT_FIELD(S, shadow_rays),
                                        CRT_FIELD(S, reflection_rays),
                                        CRT_FIELD(S, refraction_rays),
                                        CRT_FIELD(S, rays_below_min_weight),
                                        CRT_FIELD(S, rays_beyond_depth),
                                        CRT_FIELD(S, samples_over_ray_bound),
                                        CRT_FIELD(S, intersection_tests),
                                        CRT_FIELD(S, interval_events),
                                        CRT_FIELD(S, media_lookups),
                                        CRT_FIELD(S, media_changes),
                                        CRT_FIELD(S, pattern_lookups),
                                        CRT_FIELD(S, lens_samples),
                                        CRT_FIELD(S, prepare_seconds),
                                        CRT_FIELD(S, trace_seconds),
                                        CRT_FIELD(S, escalations),
                                        CRT_FIELD(S, primitive_bytes),
                                        CRT_FIELD(S, csg_bytes),
                                        CRT_FIELD(S, tree_bytes),
                                        CRT_FIELD(S, material_bytes),
                                        CRT_FIELD(S, samples_min),
                                        CRT_FIELD(S, samples_mean),
                                        CRT_FIELD(S, samples_max),
                                        CRT_FIELD(S, passes),
                                        CRT_FIELD(S, reserved),
                                        CRT_FIELD(S, half_width_rms),
                                        CRT_FIELD(S, half_width_95),
                                        CRT_FIELD(S, half_width_max),
                                        CRT_FIELD(S, pixels_unresolved),
                                        CRT_FIELD(S, unseen_share),
                                        CRT_FIELD(S, cutoff_mean),
                                        CRT_FIELD(S, cutoff_max),
                                        CRT_FIELD(S, undecided)};
  return fields;
}

template <>
std::span<const CField> c_fields<crt_write_options>() {
  static constexpr std::array fields = {CRT_FIELD(crt_write_options, reproducible),
                                        CRT_FIELD(crt_write_options, colors_only)};
  return fields;
}

template <>
std::span<const CField> c_fields<crt_farm_options>() {
  using S = crt_farm_options;
  static constexpr std::array fields = {
      CRT_FIELD(S, has_frames), CRT_FIELD(S, first_frame),   CRT_FIELD(S, last_frame),
      CRT_FIELD(S, tasks),      CRT_FIELD(S, tile_width),    CRT_FIELD(S, tile_height),
      CRT_FIELD(S, reserved),   CRT_FIELD(S, least_seconds), CRT_FIELD(S, script),
      CRT_FIELD(S, render),     CRT_FIELD(S, max_primitives)};
  return fields;
}

template <>
std::span<const CField> c_fields<crt_farm_job>() {
  using S = crt_farm_job;
  static constexpr std::array fields = {
      CRT_FIELD(S, tasks),      CRT_FIELD(S, has_frames),     CRT_FIELD(S, first_frame),
      CRT_FIELD(S, last_frame), CRT_FIELD(S, width),          CRT_FIELD(S, height),
      CRT_FIELD(S, passes),     CRT_FIELD(S, has_channels),   CRT_FIELD(S, reserved),
      CRT_FIELD(S, seconds),    CRT_FIELD(S, longest_seconds)};
  return fields;
}

template <>
std::span<const CField> c_fields<crt_farm_work_options>() {
  using S = crt_farm_work_options;
  static constexpr std::array fields = {CRT_FIELD(S, threads), CRT_FIELD(S, progress),
                                        CRT_FIELD(S, progress_user)};
  return fields;
}

template <>
std::span<const CField> c_fields<crt_farm_merge_options>() {
  using S = crt_farm_merge_options;
  static constexpr std::array fields = {CRT_FIELD(S, reserved), CRT_FIELD(S, output),
                                        CRT_FIELD(S, skip),     CRT_FIELD(S, skip_count),
                                        CRT_FIELD(S, report),   CRT_FIELD(S, report_user),
                                        CRT_FIELD(S, poll),     CRT_FIELD(S, poll_user)};
  return fields;
}

template <>
std::span<const CField> c_fields<crt_farm_progress>() {
  using S = crt_farm_progress;
  static constexpr std::array fields = {CRT_FIELD(S, waiting),       CRT_FIELD(S, running),
                                        CRT_FIELD(S, lost),          CRT_FIELD(S, done),
                                        CRT_FIELD(S, reserved),      CRT_FIELD(S, share),
                                        CRT_FIELD(S, seconds_spent), CRT_FIELD(S, seconds_left)};
  return fields;
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

crt_status crt_principled_init(crt_principled* material, size_t struct_size) {
  return guarded([&] { initialise(material, struct_size, defaults<crt_principled>()); });
}

crt_status crt_light_init(crt_light* light, size_t struct_size) {
  return guarded([&] { initialise(light, struct_size, defaults_of_size<crt_light>(struct_size)); });
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
