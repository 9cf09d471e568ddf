// This is the layout of what crt.h declares, on every machine where pointers and size_t have 64
// bits. It is written down once, and never changes. A version that appends a field adds its line
// here and corrects the size.
#include <stdio.h>
#include <string.h>

#include "layout.h"

SIZE(crt_pattern, 208);
AT(crt_pattern, struct_size, 0);
AT(crt_pattern, type, 4);
AT(crt_pattern, color_a, 8);
AT(crt_pattern, alpha_a, 32);
AT(crt_pattern, color_b, 40);
AT(crt_pattern, alpha_b, 64);
AT(crt_pattern, direction, 72);
AT(crt_pattern, offset, 96);
AT(crt_pattern, scale, 120);
AT(crt_pattern, turbulence, 128);
AT(crt_pattern, octaves, 136);
AT(crt_pattern, reserved, 140);
AT(crt_pattern, image, 144);
AT(crt_pattern, repeat_u, 152);
AT(crt_pattern, repeat_v, 160);
AT(crt_pattern, pattern_a, 168);
AT(crt_pattern, pattern_b, 176);
AT(crt_pattern, colors, 184);
AT(crt_pattern, color_count, 192);
AT(crt_pattern, mapping, 200);
AT(crt_pattern, reserved_2, 204);

SIZE(crt_color_stop, 40);
AT(crt_color_stop, position, 0);
AT(crt_color_stop, color, 8);
AT(crt_color_stop, alpha, 32);

VALUE(CRT_MAPPING_UV, 0);
VALUE(CRT_MAPPING_PLANAR, 1);
VALUE(CRT_MAPPING_CYLINDRICAL, 2);
VALUE(CRT_MAPPING_CUBIC, 3);

SIZE(crt_mesh, 128);
AT(crt_mesh, struct_size, 0);
AT(crt_mesh, reserved, 4);
AT(crt_mesh, positions, 8);
AT(crt_mesh, vertex_count, 16);
AT(crt_mesh, indices, 24);
AT(crt_mesh, triangle_count, 32);
AT(crt_mesh, normals, 40);
AT(crt_mesh, normal_count, 48);
AT(crt_mesh, normal_indices, 56);
AT(crt_mesh, uv, 64);
AT(crt_mesh, uv_count, 72);
AT(crt_mesh, uv_indices, 80);
AT(crt_mesh, materials, 88);
AT(crt_mesh, material_count, 96);
AT(crt_mesh, material_of_triangle, 104);
AT(crt_mesh, smooth, 112);
AT(crt_mesh, principled, 120);

SIZE(crt_mesh_options, 24);
AT(crt_mesh_options, struct_size, 0);
AT(crt_mesh_options, fill, 4);
AT(crt_mesh_options, weld, 8);
AT(crt_mesh_options, stitch, 16);

SIZE(crt_mesh_report, 104);
AT(crt_mesh_report, struct_size, 0);
AT(crt_mesh_report, fill, 4);
AT(crt_mesh_report, welded_vertices, 8);
AT(crt_mesh_report, welded_triangles, 16);
AT(crt_mesh_report, stitched_vertices, 24);
AT(crt_mesh_report, repeated_triangles, 32);
AT(crt_mesh_report, first_repeated, 40);
AT(crt_mesh_report, shells, 64);
AT(crt_mesh_report, overlapping_shells, 72);
AT(crt_mesh_report, first_overlap, 80);

SIZE(crt_light, 184);
AT(crt_light, struct_size, 0);
AT(crt_light, type, 4);
AT(crt_light, origin, 8);
AT(crt_light, pointing, 32);
AT(crt_light, color, 56);
AT(crt_light, angle, 80);
AT(crt_light, penumbra, 88);
AT(crt_light, radius, 96);
AT(crt_light, falloff, 104);
AT(crt_light, ambient, 112);
AT(crt_light, edge_a, 120);
AT(crt_light, edge_b, 144);
AT(crt_light, visible, 168);
AT(crt_light, two_sided, 172);
AT(crt_light, scale, 176);

SIZE(crt_camera, 144);
AT(crt_camera, struct_size, 0);
AT(crt_camera, projection, 4);
AT(crt_camera, position, 8);
AT(crt_camera, pointing, 32);
AT(crt_camera, fov, 56);
AT(crt_camera, roll, 64);
AT(crt_camera, aperture, 72);
AT(crt_camera, focal_distance, 80);
AT(crt_camera, aperture_shape, 88);
AT(crt_camera, reserved, 92);
AT(crt_camera, lens_radius, 96);
AT(crt_camera, section_normal, 104);
AT(crt_camera, section_offset, 128);
AT(crt_camera, section_hatch, 136);

SIZE(crt_background, 192);
AT(crt_background, struct_size, 0);
AT(crt_background, type, 4);
AT(crt_background, color, 8);
AT(crt_background, alpha, 32);
AT(crt_background, horizon, 40);
AT(crt_background, horizon_alpha, 64);
AT(crt_background, sky, 72);
AT(crt_background, sky_alpha, 96);
AT(crt_background, image, 104);
AT(crt_background, angle, 112);
AT(crt_background, sun, 120);
AT(crt_background, turbidity, 144);
AT(crt_background, scale, 152);
AT(crt_background, ground, 160);
AT(crt_background, shines, 184);
AT(crt_background, reserved, 188);

SIZE(crt_script_options, 208);
AT(crt_script_options, struct_size, 0);
AT(crt_script_options, allow_outside_files, 4);
AT(crt_script_options, resource_directories, 8);
AT(crt_script_options, resource_directory_count, 16);
AT(crt_script_options, t, 24);
AT(crt_script_options, variable_names, 32);
AT(crt_script_options, variable_values, 40);
AT(crt_script_options, variable_count, 48);
AT(crt_script_options, setting_names, 56);
AT(crt_script_options, setting_values, 64);
AT(crt_script_options, setting_count, 72);
AT(crt_script_options, max_steps, 80);
AT(crt_script_options, max_entities, 88);
AT(crt_script_options, max_call_depth, 96);
AT(crt_script_options, max_list_length, 104);
AT(crt_script_options, max_string_bytes, 112);
AT(crt_script_options, max_memory_bytes, 120);
AT(crt_script_options, max_source_bytes, 128);
AT(crt_script_options, max_errors, 136);
AT(crt_script_options, open_file, 144);
AT(crt_script_options, open_file_user, 152);
AT(crt_script_options, print, 160);
AT(crt_script_options, print_user, 168);
AT(crt_script_options, poll, 176);
AT(crt_script_options, poll_user, 184);
AT(crt_script_options, compat, 192);
AT(crt_script_options, reserved, 196);
AT(crt_script_options, max_image_pixels, 200);

SIZE(crt_diagnostic, 56);
AT(crt_diagnostic, struct_size, 0);
AT(crt_diagnostic, severity, 4);
AT(crt_diagnostic, status, 8);
AT(crt_diagnostic, line, 12);
AT(crt_diagnostic, column, 16);
AT(crt_diagnostic, length, 20);
AT(crt_diagnostic, message, 24);
AT(crt_diagnostic, file, 32);
AT(crt_diagnostic, source_line, 40);
AT(crt_diagnostic, call_count, 48);

SIZE(crt_diagnostic_call, 32);
AT(crt_diagnostic_call, struct_size, 0);
AT(crt_diagnostic_call, line, 4);
AT(crt_diagnostic_call, column, 8);
AT(crt_diagnostic_call, reserved, 12);
AT(crt_diagnostic_call, name, 16);
AT(crt_diagnostic_call, file, 24);

SIZE(crt_render_options, 88);
AT(crt_render_options, struct_size, 0);
AT(crt_render_options, threads, 4);
AT(crt_render_options, region_x, 8);
AT(crt_render_options, region_y, 12);
AT(crt_render_options, region_width, 16);
AT(crt_render_options, region_height, 20);
AT(crt_render_options, seed, 24);
AT(crt_render_options, progress, 32);
AT(crt_render_options, progress_user, 40);
AT(crt_render_options, log, 48);
AT(crt_render_options, log_user, 56);
AT(crt_render_options, passes, 64);
AT(crt_render_options, aovs, 68);
AT(crt_render_options, checkpoint, 72);
AT(crt_render_options, max_ray_steps, 80);

SIZE(crt_measure_options, 40);
AT(crt_measure_options, struct_size, 0);
AT(crt_measure_options, threads, 4);
AT(crt_measure_options, relative_width, 8);
AT(crt_measure_options, seconds, 16);
AT(crt_measure_options, poll, 24);
AT(crt_measure_options, poll_user, 32);
SIZE(crt_prepare_options, 40);
AT(crt_prepare_options, struct_size, 0);
AT(crt_prepare_options, reserved, 4);
AT(crt_prepare_options, poll, 8);
AT(crt_prepare_options, poll_user, 16);
AT(crt_prepare_options, max_primitives, 24);
AT(crt_prepare_options, previous, 32);

SIZE(crt_blob_part, 64);
AT(crt_blob_part, from, 0);
AT(crt_blob_part, to, 24);
AT(crt_blob_part, radius, 48);
AT(crt_blob_part, strength, 56);

SIZE(crt_custom_crossing, 24);
AT(crt_custom_crossing, t, 0);
AT(crt_custom_crossing, error, 8);
AT(crt_custom_crossing, face, 16);
AT(crt_custom_crossing, reserved, 20);

SIZE(crt_custom_point, 40);
AT(crt_custom_point, normal, 0);
AT(crt_custom_point, u, 24);
AT(crt_custom_point, v, 32);

SIZE(crt_custom, 96);
AT(crt_custom, struct_size, 0);
AT(crt_custom, face_count, 4);
AT(crt_custom, lower, 8);
AT(crt_custom, upper, 32);
AT(crt_custom, crossings, 56);
AT(crt_custom, point, 64);
AT(crt_custom, release, 72);
AT(crt_custom, user, 80);
AT(crt_custom, name, 88);

SIZE(crt_render_stats, 272);
AT(crt_render_stats, struct_size, 0);
AT(crt_render_stats, threads, 4);
AT(crt_render_stats, pixels, 8);
AT(crt_render_stats, camera_rays, 16);
AT(crt_render_stats, shadow_rays, 24);
AT(crt_render_stats, reflection_rays, 32);
AT(crt_render_stats, refraction_rays, 40);
AT(crt_render_stats, rays_below_min_weight, 48);
AT(crt_render_stats, rays_beyond_depth, 56);
AT(crt_render_stats, samples_over_ray_bound, 64);
AT(crt_render_stats, intersection_tests, 72);
AT(crt_render_stats, interval_events, 80);
AT(crt_render_stats, media_lookups, 88);
AT(crt_render_stats, media_changes, 96);
AT(crt_render_stats, pattern_lookups, 104);
AT(crt_render_stats, lens_samples, 112);
AT(crt_render_stats, prepare_seconds, 120);
AT(crt_render_stats, trace_seconds, 128);
AT(crt_render_stats, escalations, 136);
AT(crt_render_stats, primitive_bytes, 144);
AT(crt_render_stats, csg_bytes, 152);
AT(crt_render_stats, tree_bytes, 160);
AT(crt_render_stats, material_bytes, 168);
AT(crt_render_stats, samples_min, 176);
AT(crt_render_stats, samples_mean, 184);
AT(crt_render_stats, samples_max, 192);
AT(crt_render_stats, passes, 200);
AT(crt_render_stats, reserved, 204);
AT(crt_render_stats, half_width_rms, 208);
AT(crt_render_stats, half_width_95, 216);
AT(crt_render_stats, half_width_max, 224);
AT(crt_render_stats, pixels_unresolved, 232);
AT(crt_render_stats, unseen_share, 240);
AT(crt_render_stats, cutoff_mean, 248);
AT(crt_render_stats, cutoff_max, 256);
AT(crt_render_stats, undecided, 264);

SIZE(crt_write_options, 12);
AT(crt_write_options, struct_size, 0);
AT(crt_write_options, reproducible, 4);
AT(crt_write_options, colors_only, 8);

SIZE(crt_ray, 64);
AT(crt_ray, origin, 0);
AT(crt_ray, direction, 24);
AT(crt_ray, t_min, 48);
AT(crt_ray, t_max, 56);

SIZE(crt_hit, 56);
AT(crt_hit, t, 0);
AT(crt_hit, normal, 8);
AT(crt_hit, u, 32);
AT(crt_hit, v, 40);
AT(crt_hit, entity_id, 48);
AT(crt_hit, flags, 52);

SIZE(crt_start, 16);
AT(crt_start, bits, 0);

SIZE(crt_full_hit, 112);
AT(crt_full_hit, t, 0);
AT(crt_full_hit, position, 8);
AT(crt_full_hit, normal, 32);
AT(crt_full_hit, u, 56);
AT(crt_full_hit, v, 64);
AT(crt_full_hit, entity_id, 72);
AT(crt_full_hit, part_id, 76);
AT(crt_full_hit, face, 80);
AT(crt_full_hit, flags, 84);
AT(crt_full_hit, user, 88);
AT(crt_full_hit, start, 96);

VALUE(CRT_OK, 0);
VALUE(CRT_ERROR_INVALID_ARGUMENT, 1);
VALUE(CRT_ERROR_SCRIPT, 2);
VALUE(CRT_ERROR_IO, 3);
VALUE(CRT_ERROR_UNSUPPORTED, 4);
VALUE(CRT_ERROR_LIMIT, 5);
VALUE(CRT_ERROR_CANCELLED, 6);
VALUE(CRT_ERROR_OUT_OF_MEMORY, 7);
VALUE(CRT_ERROR_INTERNAL, 8);

VALUE(CRT_PATTERN_CHECKER, 0);
VALUE(CRT_PATTERN_STRIPES, 1);
VALUE(CRT_PATTERN_GRADIENT, 2);
VALUE(CRT_PATTERN_NOISE, 3);
VALUE(CRT_PATTERN_MARBLE, 4);
VALUE(CRT_PATTERN_WOOD, 5);
VALUE(CRT_PATTERN_IMAGE, 6);

VALUE(CRT_LIGHT_POINT, 0);
VALUE(CRT_LIGHT_PARALLEL, 1);
VALUE(CRT_LIGHT_SPOT, 2);
VALUE(CRT_LIGHT_CYLINDER, 3);

VALUE(CRT_PROJECTION_PINHOLE, 0);
VALUE(CRT_PROJECTION_SPHERICAL, 1);
VALUE(CRT_PROJECTION_CYLINDRICAL, 2);
VALUE(CRT_PROJECTION_ORTHOGRAPHIC, 3);

VALUE(CRT_APERTURE_CIRCLE, 0);
VALUE(CRT_APERTURE_UNIFORM, 1);
VALUE(CRT_APERTURE_GAUSSIAN, 2);
VALUE(CRT_APERTURE_TRIANGLE, 3);
VALUE(CRT_APERTURE_SQUARE, 4);
VALUE(CRT_APERTURE_PENTAGON, 5);
VALUE(CRT_APERTURE_HEXAGON, 6);
VALUE(CRT_APERTURE_OCTAGON, 7);
VALUE(CRT_APERTURE_LINE, 8);

VALUE(CRT_BACKGROUND_SOLID, 0);
VALUE(CRT_BACKGROUND_GRADIENT, 1);
VALUE(CRT_BACKGROUND_SPHERICAL, 2);
VALUE(CRT_BACKGROUND_CYLINDRICAL, 3);
VALUE(CRT_BACKGROUND_EQUAL_AREA, 4);
VALUE(CRT_BACKGROUND_SKY, 5);

VALUE(CRT_FALLOFF_PATH, 0);
VALUE(CRT_FALLOFF_LIGHT, 1);

VALUE(CRT_FILE_GIVEN, 0);
VALUE(CRT_FILE_NOT_GIVEN, 1);

VALUE(CRT_SEVERITY_WARNING, 0);
VALUE(CRT_SEVERITY_ERROR, 1);

VALUE(CRT_LOG_INFO, 0);
VALUE(CRT_LOG_WARNING, 1);

VALUE(CRT_AOV_DEPTH, 1);
VALUE(CRT_AOV_NORMAL, 2);
VALUE(CRT_AOV_ID, 4);
VALUE(CRT_AOV_ALBEDO, 8);
VALUE(CRT_AOV_SAMPLES, 16);
VALUE(CRT_AOV_ERROR, 32);
VALUE(CRT_AOV_PART, 64);

VALUE(CRT_HIT_ENTERING, 1);
VALUE(CRT_HIT_BACKFACE, 2);

// The library must agree on where its defaults end, in bytes.
static int failures = 0;

static void expect_double(const char* what, const void* bytes, size_t place, double expected) {
  double found = 0;
  memcpy(&found, (const char*)bytes + place, sizeof found);
  if (found == expected) return;
  printf("%s: the library writes %g where %g should be\n", what, found, expected);
  ++failures;
}

int main(void) {
  _Alignas(8) unsigned char bytes[256] = {0};
  if (crt_pattern_init((crt_pattern*)(void*)bytes, 168) != CRT_OK) return 1;
  expect_double("crt_pattern.repeat_v", bytes, 160, 1);
  if (crt_material_init((crt_material*)(void*)bytes, 136) != CRT_OK) return 1;
  expect_double("crt_material.bump_height", bytes, 128, 0.1);
  if (crt_light_init((crt_light*)(void*)bytes, 120) != CRT_OK) return 1;
  expect_double("crt_light.radius", bytes, 96, 1);
  if (crt_camera_init((crt_camera*)(void*)bytes, 96) != CRT_OK) return 1;
  expect_double("crt_camera.focal_distance", bytes, 80, 1);
  if (crt_background_init((crt_background*)(void*)bytes, 120) != CRT_OK) return 1;
  expect_double("crt_background.alpha", bytes, 32, 1);
  if (crt_settings_init((crt_settings*)(void*)bytes, 88) != CRT_OK) return 1;
  expect_double("crt_settings.min_weight", bytes, 32, 1.0 / 1024);
  expect_double("crt_settings.gamma", bytes, 24,
                1);  // as in version 1.0, whose struct had 88 bytes
  if (crt_settings_init((crt_settings*)(void*)bytes, 152) != CRT_OK) return 1;
  expect_double("crt_settings.gamma", bytes, 24, 2.2);
  return failures == 0 ? 0 : 1;
}
