// A wrong argument is refused with a message that names it, and nothing is written.
#include <functional>
#include <utility>
#include <vector>

#include "wrong_arguments.hpp"

using namespace crt::test;

TEST_CASE("every pointer that is needed is refused if it is NULL, with its name") {
  const SceneHandle scene = small_scene();
  const PreparedHandle prepared = prepare(scene.get());
  const EntityHandle ball = sphere(zero, 1);
  const ImageHandle image = render(prepared.get());
  crt_entity* entity = nullptr;
  crt_entity* const nothing[] = {nullptr};
  crt_scene* made_scene = nullptr;
  crt_image* made_image = nullptr;
  crt_job* job = nullptr;
  crt_buffer* buffer = nullptr;
  double number = 7;
  const double* const z = zero.data();
  const double* const o = one.data();
  crt_material material;
  crt_material_init(&material, sizeof material);
  const crt_ray ray = {{0, 0, 0}, {0, 0, 1}, 0, infinity};
  crt_hit hit = {};
  std::uint8_t byte = 9;
  std::size_t count = 9;
  double corner[3];
  std::int8_t side = 0;
  crt_surface_mesh* surface = nullptr;
  crt_section* section = nullptr;
  crt_measure_options how;
  crt_measure_options_init(&how, sizeof how);
  const crt_measure_options unset = {};
  crt_mass mass;
  crt_mass_init(&mass, sizeof mass);
  crt_light light;
  crt_light_init(&light, sizeof light);
  const ProfileHandle square = square_profile();
  crt_mesh mesh;
  crt_mesh_init(&mesh, sizeof mesh);
  mesh.vertex_count = 1;
  crt_custom custom;
  crt_custom_init(&custom, sizeof custom);
  const double heights[4] = {0.5, 1, 0, 0.25};
  const crt_blob_part blob_part = {{0, 0, 0}, {0, 0, 0}, 1, 1};
  crt_farm_job planned;
  planned.struct_size = sizeof planned;
  crt_farm_merge_options merge;
  crt_farm_merge_options_init(&merge, sizeof merge);
  merge.skip_count = 1;
  const std::vector<crt_blob_part> many_parts(1025, blob_part);

  check_all({
      {"out", [&] { return crt_sphere_create(z, 1, nullptr); }},
      {"center", [&] { return crt_sphere_create(nullptr, 1, &entity); }},
      {"corner_a", [&] { return crt_box_create(nullptr, o, &entity); }},
      {"corner_b", [&] { return crt_box_create(z, nullptr, &entity); }},
      {"corner_a", [&] { return crt_rounded_box_create(nullptr, o, 0.1, &entity); }},
      {"corner_b", [&] { return crt_rounded_box_create(z, nullptr, 0.1, &entity); }},
      {"radius", [&] { return crt_rounded_box_create(z, o, 0.6, &entity); }},
      {"normal", [&] { return crt_plane_create(nullptr, z, &entity); }},
      {"position", [&] { return crt_plane_create(o, nullptr, &entity); }},
      {"direction", [&] { return crt_half_plane_create(o, z, nullptr, &entity); }},
      {"from", [&] { return crt_cylinder_create(nullptr, o, 1, &entity); }},
      {"to", [&] { return crt_cone_create(z, nullptr, 1, 0, &entity); }},
      {"to", [&] { return crt_capsule_create(z, nullptr, 1, &entity); }},
      {"radii", [&] { return crt_ellipsoid_create(z, nullptr, &entity); }},
      {"profile", [&] { return crt_extrusion_create(nullptr, z, o, &entity); }},
      {"from", [&] { return crt_extrusion_create(square.get(), nullptr, o, &entity); }},
      {"to", [&] { return crt_extrusion_create(square.get(), z, nullptr, &entity); }},
      {"out", [&] { return crt_extrusion_create(square.get(), z, o, nullptr); }},
      {"profile", [&] { return crt_revolution_create(nullptr, z, o, 1, &entity); }},
      {"from", [&] { return crt_revolution_create(square.get(), nullptr, o, 1, &entity); }},
      {"to", [&] { return crt_revolution_create(square.get(), z, nullptr, 1, &entity); }},
      {"out", [&] { return crt_revolution_create(square.get(), z, o, 1, nullptr); }},
      {"out", [&] { return crt_profile_create(nullptr); }},
      {"profile", [&] { return crt_profile_move_to(nullptr, 0, 0); }},
      {"profile", [&] { return crt_profile_line_to(nullptr, 0, 0); }},
      {"profile", [&] { return crt_profile_arc_to(nullptr, 0, 0, 1); }},
      {"heights", [&] { return crt_height_field_create(nullptr, 2, 2, z, o, &entity); }},
      {"columns", [&] { return crt_height_field_create(heights, 1, 2, z, o, &entity); }},
      {"rows", [&] { return crt_height_field_create(heights, 2, 1, z, o, &entity); }},
      {"heights", [&] { return crt_height_field_create(heights, ~0u, ~0u, z, o, &entity); }},
      {"corner_a", [&] { return crt_height_field_create(heights, 2, 2, nullptr, o, &entity); }},
      {"corner_b", [&] { return crt_height_field_create(heights, 2, 2, z, nullptr, &entity); }},
      {"out", [&] { return crt_height_field_create(heights, 2, 2, z, o, nullptr); }},
      {"squares", [&] { return crt_quadric_create(nullptr, z, z, -1, &entity); }},
      {"products", [&] { return crt_quadric_create(o, nullptr, z, -1, &entity); }},
      {"linear", [&] { return crt_quadric_create(o, z, nullptr, -1, &entity); }},
      {"squares", [&] { return crt_quadric_create(z, z, z, -1, &entity); }},
      {"constant", [&] { return crt_quadric_create(o, z, z, 1, &entity); }},
      {"out", [&] { return crt_quadric_create(o, z, z, -1, nullptr); }},
      {"field", [&] { return crt_implicit_create(nullptr, 1, z, o, &entity); }},
      {"lower", [&] { return crt_implicit_create("x", 1, nullptr, o, &entity); }},
      {"upper", [&] { return crt_implicit_create("x", 1, z, nullptr, &entity); }},
      {"upper", [&] { return crt_implicit_create("x", 1, o, z, &entity); }},
      {"out", [&] { return crt_implicit_create("x", 1, z, o, nullptr); }},
      {"parts", [&] { return crt_blob_create(nullptr, 1, 0.5, &entity); }},
      {"parts", [&] { return crt_blob_create(nullptr, 0, 0.5, &entity); }},
      {"parts", [&] { return crt_blob_create(many_parts.data(), many_parts.size(), 1, &entity); }},
      {"threshold", [&] { return crt_blob_create(&blob_part, 1, 0, &entity); }},
      {"out", [&] { return crt_blob_create(&blob_part, 1, 0.5, nullptr); }},
      {"east_west", [&] { return crt_superellipsoid_create(0, 1, &entity); }},
      {"north_south", [&] { return crt_superellipsoid_create(1, 11, &entity); }},
      {"out", [&] { return crt_superellipsoid_create(1, 1, nullptr); }},
      {"custom", [&] { return crt_custom_create(nullptr, &entity); }},
      {"crossings", [&] { return crt_custom_create(&custom, &entity); }},
      {"out", [&] { return crt_custom_create(&custom, nullptr); }},
      {"axis", [&] { return crt_torus_create(z, nullptr, 1, 0.1, &entity); }},
      {"center", [&] { return crt_disc_create(nullptr, o, 1, &entity); }},
      {"c", [&] { return crt_triangle_create(z, o, nullptr, &entity); }},
      {"positions", [&] { return crt_mesh_create(nullptr, 3, triangle_indices(), 1, &entity); }},
      {"indices", [&] { return crt_mesh_create(z, 1, nullptr, 1, &entity); }},
      {"mesh", [&] { return crt_mesh_create_with(nullptr, &entity); }},
      {"out", [&] { return crt_mesh_create_with(&mesh, nullptr); }},
      {"positions", [&] { return crt_mesh_create_with(&mesh, &entity); }},
      {"path", [&] { return crt_mesh_load(nullptr, nullptr, &entity); }},
      {"path", [&] { return crt_mesh_load_smooth(nullptr, nullptr, 1, &entity); }},
      {"smooth", [&] { return crt_mesh_load_smooth("a.obj", nullptr, 4, &entity); }},
      {"path", [&] { return crt_mesh_load_with(nullptr, nullptr, 1, nullptr, &entity); }},
      {"out", [&] { return crt_mesh_load_with("a.obj", nullptr, 1, nullptr, nullptr); }},
      {"positions",
       [&] { return crt_mesh_from_triangles_rule(nullptr, 3, triangle_indices(), 1, 0, &entity); }},
      {"rule",
       [&] { return crt_mesh_from_triangles_rule(z, 1, triangle_indices(), 1, 2, &entity); }},
      {"mesh", [&] { return crt_mesh_create_with_options(nullptr, nullptr, &entity); }},
      {"entity", [&] { return crt_entity_mesh_report(nullptr, nullptr); }},
      {"entity", [&] { return crt_entity_mesh_report(ball.get(), nullptr); }},
      {"entity", [&] { return crt_entity_mesh_warnings(nullptr, nullptr, 0, &count); }},
      {"entity", [&] { return crt_entity_solid_fault(nullptr, nullptr, 0, &count); }},
      {"entity", [&] { return crt_entity_describe(nullptr, nullptr, 0, &count); }},
      {"json", [&] { return crt_entity_describe(ball.get(), nullptr, 1, &count); }},
      {"length", [&] { return crt_entity_describe(ball.get(), nullptr, 0, nullptr); }},
      {"entity", [&] { return crt_entity_bounds(nullptr, corner, corner); }},
      {"lower", [&] { return crt_entity_bounds(ball.get(), nullptr, corner); }},
      {"upper", [&] { return crt_entity_bounds(ball.get(), corner, nullptr); }},
      {"the struct", [&] { return crt_mass_init(nullptr, sizeof(crt_mass)); }},
      {"entity", [&] { return crt_entity_mass(nullptr, 1, 0, &mass); }},
      {"out", [&] { return crt_entity_mass(ball.get(), 1, 0, nullptr); }},
      {"entity", [&] { return crt_entity_volume(nullptr, 1, 0, &mass.volume); }},
      {"out", [&] { return crt_entity_volume(ball.get(), 1, 0, nullptr); }},
      {"entity", [&] { return crt_entity_area(nullptr, 1, 0, &mass.area); }},
      {"out", [&] { return crt_entity_area(ball.get(), 1, 0, nullptr); }},
      {"entity", [&] { return crt_entity_contains(nullptr, z, 0, 1, &side); }},
      {"points", [&] { return crt_entity_contains(ball.get(), nullptr, 0, 1, &side); }},
      {"side", [&] { return crt_entity_contains(ball.get(), z, 0, 1, nullptr); }},
      {"entity", [&] { return crt_entity_distance(nullptr, z, 0, 1, corner, nullptr, 0); }},
      {"points",
       [&] { return crt_entity_distance(ball.get(), nullptr, 0, 1, corner, nullptr, 0); }},
      {"signed_distance",
       [&] { return crt_entity_distance(ball.get(), z, 0, 1, nullptr, nullptr, 0); }},
      {"nearest", [&] { return crt_entity_distance(ball.get(), z, 0, 1, corner, corner, 8); }},
      {"a",
       [&] { return crt_entity_clearance(nullptr, ball.get(), 1, &mass.volume, corner, corner); }},
      {"b",
       [&] { return crt_entity_clearance(ball.get(), nullptr, 1, &mass.volume, corner, corner); }},
      {"distance",
       [&] { return crt_entity_clearance(ball.get(), ball.get(), 1, nullptr, corner, corner); }},
      {"on_a",
       [&] {
         return crt_entity_clearance(ball.get(), ball.get(), 1, &mass.volume, nullptr, corner);
       }},
      {"on_b",
       [&] {
         return crt_entity_clearance(ball.get(), ball.get(), 1, &mass.volume, corner, nullptr);
       }},
      {"entity", [&] { return crt_entity_thickness(nullptr, 1, &mass.volume, corner, corner); }},
      {"least", [&] { return crt_entity_thickness(ball.get(), 1, nullptr, corner, corner); }},
      {"from", [&] { return crt_entity_thickness(ball.get(), 1, &mass.volume, nullptr, corner); }},
      {"to", [&] { return crt_entity_thickness(ball.get(), 1, &mass.volume, corner, nullptr); }},
      {"the struct", [&] { return crt_measure_options_init(nullptr, sizeof how); }},
      {"entity", [&] { return crt_entity_density(nullptr, corner); }},
      {"out", [&] { return crt_entity_density(ball.get(), nullptr); }},
      {"entity", [&] { return crt_entity_centroid(nullptr, 1, 0, mass.centroid); }},
      {"out", [&] { return crt_entity_centroid(ball.get(), 1, 0, nullptr); }},
      {"entity",
       [&] { return crt_entity_distance_with(nullptr, &how, z, 0, 1, corner, nullptr, 0); }},
      {"options",
       [&] { return crt_entity_distance_with(ball.get(), &unset, z, 0, 1, corner, nullptr, 0); }},
      {"a",
       [&] {
         return crt_entity_clearance_with(nullptr, ball.get(), &how, &mass.volume, corner, corner);
       }},
      {"options",
       [&] {
         return crt_entity_clearance_with(ball.get(), ball.get(), &unset, &mass.volume, corner,
                                          corner);
       }},
      {"least",
       [&] { return crt_entity_thickness_with(ball.get(), &how, nullptr, corner, corner); }},
      {"options",
       [&] { return crt_entity_thickness_with(ball.get(), &unset, &mass.volume, corner, corner); }},
      {"entity", [&] { return crt_entity_tessellate_with(nullptr, 1, &how, &surface); }},
      {"out", [&] { return crt_entity_tessellate_with(ball.get(), 1, &how, nullptr); }},
      {"options", [&] { return crt_entity_tessellate_with(ball.get(), 1, &unset, &surface); }},
      {"entity", [&] { return crt_section_create_with(nullptr, o, 0, 1, &how, &section); }},
      {"normal",
       [&] { return crt_section_create_with(ball.get(), nullptr, 0, 1, &how, &section); }},
      {"out", [&] { return crt_section_create_with(ball.get(), o, 0, 1, &how, nullptr); }},
      {"options", [&] { return crt_section_create_with(ball.get(), o, 0, 1, &unset, &section); }},
      {"entities", [&] { return crt_interference(nullptr, 1, 1, 0, nullptr, 0, &count); }},
      {"entities[0]", [&] { return crt_interference(nothing, 1, 1, 0, nullptr, 0, &count); }},
      {"overlaps", [&] { return crt_interference(nullptr, 0, 1, 0, nullptr, 1, &count); }},
      {"count", [&] { return crt_interference(nullptr, 0, 1, 0, nullptr, 0, nullptr); }},
      {"entity", [&] { return crt_entity_tessellate(nullptr, 1, &surface); }},
      {"out", [&] { return crt_entity_tessellate(ball.get(), 1, nullptr); }},
      {"mesh", [&] { return crt_surface_mesh_write(nullptr, "a.stl"); }},
      {"meshes",
       [&] { return crt_surface_meshes_write(nullptr, 1, nullptr, nullptr, 0, "a.stl"); }},
      {"path", [&] { return crt_surface_meshes_write(nullptr, 0, nullptr, nullptr, 0, nullptr); }},
      {"prepared", [&] { return crt_hit_parts(nullptr, nullptr, 0, 0, nullptr, 0); }},
      {"rays", [&] { return crt_hit_parts(prepared.get(), nullptr, 0, 1, nullptr, 0); }},
      {"parts", [&] { return crt_hit_parts(prepared.get(), &ray, 0, 1, nullptr, 0); }},
      {"prepared", [&] { return crt_trace(nullptr, nullptr, 0, nullptr, 0, 0, nullptr, 0); }},
      {"rays", [&] { return crt_trace(prepared.get(), nullptr, 0, nullptr, 0, 1, nullptr, 0); }},
      {"hits", [&] { return crt_trace(prepared.get(), &ray, 0, nullptr, 0, 1, nullptr, 0); }},
      {"prepared",
       [&] { return crt_blocked(nullptr, nullptr, 0, nullptr, nullptr, 0, 0, nullptr); }},
      {"rays",
       [&] { return crt_blocked(prepared.get(), nullptr, 0, nullptr, nullptr, 0, 1, nullptr); }},
      {"blocked",
       [&] { return crt_blocked(prepared.get(), &ray, 0, nullptr, nullptr, 0, 1, nullptr); }},
      {"prepared",
       [&] { return crt_trace_all(nullptr, nullptr, 0, nullptr, 0, 0, nullptr, 0, nullptr); }},
      {"rays",
       [&] {
         return crt_trace_all(prepared.get(), nullptr, 0, nullptr, 0, 1, nullptr, 0, nullptr);
       }},
      {"hits",
       [&] { return crt_trace_all(prepared.get(), &ray, 0, nullptr, 0, 1, nullptr, 1, nullptr); }},
      {"first",
       [&] { return crt_trace_all(prepared.get(), &ray, 0, nullptr, 0, 1, nullptr, 0, nullptr); }},
      {"prepared", [&] { return crt_locate(nullptr, z, 0, 1, nullptr, nullptr, nullptr); }},
      {"points",
       [&] { return crt_locate(prepared.get(), nullptr, 0, 1, nullptr, nullptr, nullptr); }},
      {"entity_ids",
       [&] { return crt_locate(prepared.get(), z, 0, 1, nullptr, nullptr, nullptr); }},
      {"entity", [&] { return crt_entity_with_shadow(nullptr, 1, &entity); }},
      {"out", [&] { return crt_entity_with_shadow(ball.get(), 1, nullptr); }},
      {"entity", [&] { return crt_entity_with_visible(nullptr, 1, &entity); }},
      {"out", [&] { return crt_entity_with_visible(ball.get(), 1, nullptr); }},
      {"entity", [&] { return crt_entity_with_user(nullptr, 1, &entity); }},
      {"out", [&] { return crt_entity_with_user(ball.get(), 1, nullptr); }},
      {"prepared", [&] { return crt_camera_rays(nullptr, nullptr, 0, nullptr, 0); }},
      {"xy", [&] { return crt_camera_rays(prepared.get(), nullptr, 1, nullptr, 0); }},
      {"rays", [&] { return crt_camera_rays(prepared.get(), z, 1, nullptr, 0); }},
      {"out", [&] { return crt_mesh_load("a.obj", nullptr, nullptr); }},
      {"parts", [&] { return crt_union_create(nullptr, 1, &entity); }},
      {"parts", [&] { return crt_union_create(nothing, 1, &entity); }},
      {"parts", [&] { return crt_intersection_create(nothing, 1, &entity); }},
      {"from", [&] { return crt_difference_create(nullptr, nullptr, 0, &entity); }},
      {"cutters", [&] { return crt_difference_create(ball.get(), nothing, 1, &entity); }},
      {"entity", [&] { return crt_entity_with_transform(nullptr, z, &entity); }},
      {"affine", [&] { return crt_entity_with_transform(ball.get(), nullptr, &entity); }},
      {"entity", [&] { return crt_entity_with_material(nullptr, &material, &entity); }},
      {"material", [&] { return crt_entity_with_material(ball.get(), nullptr, &entity); }},
      {"entity", [&] { return crt_entity_with_id(nullptr, 1, &entity); }},
      {"out", [&] { return crt_entity_with_id(ball.get(), 1, nullptr); }},
      {"out", [&] { return crt_scene_create(nullptr); }},
      {"scene", [&] { return crt_scene_copy(nullptr, &made_scene); }},
      {"out", [&] { return crt_scene_copy(scene.get(), nullptr); }},
      {"scene", [&] { return crt_scene_add_entity(nullptr, ball.get()); }},
      {"entity", [&] { return crt_scene_add_entity(scene.get(), nullptr); }},
      {"scene", [&] { return crt_scene_add_light(nullptr, &light); }},
      {"light", [&] { return crt_scene_add_light(scene.get(), nullptr); }},
      {"camera", [&] { return crt_scene_set_camera(scene.get(), nullptr); }},
      {"background", [&] { return crt_scene_set_background(scene.get(), nullptr); }},
      {"settings", [&] { return crt_scene_set_settings(scene.get(), nullptr); }},
      {"scene", [&] { return crt_scene_clear_entities(nullptr); }},
      {"scene", [&] { return crt_scene_clear_lights(nullptr); }},
      {"scene", [&] { return crt_scene_get_entity(nullptr, 0, &entity); }},
      {"out", [&] { return crt_scene_get_entity(scene.get(), 0, nullptr); }},
      {"scene", [&] { return crt_scene_replace_entity(nullptr, 0, ball.get()); }},
      {"entity", [&] { return crt_scene_replace_entity(scene.get(), 0, nullptr); }},
      {"scene", [&] { return crt_scene_remove_entity(nullptr, 0); }},
      {"scene", [&] { return crt_scene_save_script(nullptr, "a.crt"); }},
      {"path", [&] { return crt_scene_save_script(scene.get(), nullptr); }},
      {"light", [&] { return crt_scene_get_light(scene.get(), 0, nullptr); }},
      {"camera", [&] { return crt_scene_get_camera(scene.get(), nullptr); }},
      {"background", [&] { return crt_scene_get_background(scene.get(), nullptr); }},
      {"settings", [&] { return crt_scene_get_settings(scene.get(), nullptr); }},
      {"scene", [&] { return crt_scene_prepare(nullptr, nullptr); }},
      {"out", [&] { return crt_scene_prepare(scene.get(), nullptr); }},
      {"scene", [&] { return crt_scene_prepare_from(nullptr, nullptr, nullptr); }},
      {"out", [&] { return crt_scene_prepare_from(scene.get(), nullptr, nullptr); }},
      {"text",
       [&] { return crt_scene_from_script(nullptr, 1, "x", nullptr, nullptr, &made_scene); }},
      {"name",
       [&] { return crt_scene_from_script("", 0, nullptr, nullptr, nullptr, &made_scene); }},
      {"out", [&] { return crt_scene_from_script("", 0, "x", nullptr, nullptr, nullptr); }},
      {"path", [&] { return crt_scene_from_script_file(nullptr, nullptr, nullptr, &made_scene); }},
      {"content", [&] { return crt_file_content_append(nullptr, "x", 1); }},
      {"diagnostics", [&] { return crt_diagnostics_get(nullptr, 0, nullptr); }},
      {"diagnostics", [&] { return crt_diagnostics_get_call(nullptr, 0, 0, nullptr); }},
      {"prepared", [&] { return crt_render(nullptr, nullptr, &made_image); }},
      {"out", [&] { return crt_render(prepared.get(), nullptr, nullptr); }},
      {"prepared", [&] { return crt_render_start(nullptr, nullptr, &job); }},
      {"out", [&] { return crt_render_start(prepared.get(), nullptr, nullptr); }},
      {"job", [&] { return crt_job_progress(nullptr, &number); }},
      {"job", [&] { return crt_job_snapshot(nullptr, &made_image); }},
      {"job", [&] { return crt_job_cancel(nullptr); }},
      {"job", [&] { return crt_job_wait(nullptr, &made_image); }},
      {"pixels", [&] { return crt_image_create(1, 1, nullptr, 0, &made_image); }},
      {"out", [&] { return crt_image_from_rgba8(1, 1, &byte, 0, nullptr); }},
      {"path", [&] { return crt_image_read(nullptr, &made_image); }},
      {"bytes", [&] { return crt_image_decode(nullptr, 1, nullptr, &made_image); }},
      {"image", [&] { return crt_image_to_rgba8(nullptr, &byte, 0); }},
      {"pixels", [&] { return crt_image_to_rgba8(image.get(), nullptr, 0); }},
      {"image", [&] { return crt_image_write(nullptr, "x.png"); }},
      {"path", [&] { return crt_image_write(image.get(), nullptr); }},
      {"path", [&] { return crt_image_write(image.get(), ""); }},
      {"format", [&] { return crt_image_encode(image.get(), nullptr, nullptr, &buffer); }},
      {"out", [&] { return crt_image_encode(image.get(), "png", nullptr, nullptr); }},
      {"stats", [&] { return crt_image_stats(image.get(), nullptr); }},
      {"settings", [&] { return crt_image_settings(image.get(), nullptr); }},
      {"settings", [&] { return crt_image_with_settings(image.get(), nullptr, &made_image); }},
      {"prepared", [&] { return crt_intersect(nullptr, &ray, 0, 1, &hit, 0); }},
      {"rays", [&] { return crt_intersect(prepared.get(), nullptr, 0, 1, &hit, 0); }},
      {"hits", [&] { return crt_intersect(prepared.get(), &ray, 0, 1, nullptr, 0); }},
      {"prepared", [&] { return crt_distances(nullptr, &ray, 0, 1, &number, nullptr); }},
      {"rays", [&] { return crt_distances(prepared.get(), nullptr, 0, 1, &number, nullptr); }},
      {"distances", [&] { return crt_distances(prepared.get(), &ray, 0, 1, nullptr, nullptr); }},
      {"rays", [&] { return crt_occluded(prepared.get(), nullptr, 0, 1, &byte); }},
      {"occluded", [&] { return crt_occluded(prepared.get(), &ray, 0, 1, nullptr); }},
      {"ray", [&] { return crt_crossings(prepared.get(), nullptr, &hit, 1, &count); }},
      {"hits", [&] { return crt_crossings(prepared.get(), &ray, nullptr, 1, &count); }},
      {"count", [&] { return crt_crossings(prepared.get(), &ray, &hit, 1, nullptr); }},
      {"script", [&] { return crt_farm_plan(nullptr, "j", nullptr, &planned); }},
      {"job", [&] { return crt_farm_plan("s", nullptr, nullptr, &planned); }},
      {"plan", [&] { return crt_farm_plan("s", "j", nullptr, nullptr); }},
      {"job", [&] { return crt_farm_read_plan(nullptr, &planned); }},
      {"job", [&] { return crt_farm_work(nullptr, 0, nullptr, nullptr); }},
      {"job", [&] { return crt_farm_merge(nullptr, nullptr, nullptr); }},
      {"skip", [&] { return crt_farm_merge("j", &merge, nullptr); }},
      {"job", [&] { return crt_farm_status(nullptr, nullptr); }},
      {"progress", [&] { return crt_farm_status("j", nullptr); }},
      {"job", [&] { return crt_farm_tasks(nullptr, nullptr, 0, &count); }},
      {"tasks", [&] { return crt_farm_tasks("j", nullptr, 1, &count); }},
      {"count", [&] { return crt_farm_tasks("j", nullptr, 0, nullptr); }},
      {"job", [&] { return crt_farm_sheet(nullptr, 9, &made_image); }},
      {"out", [&] { return crt_farm_sheet("j", 9, nullptr); }},
      {"cell", [&] { return crt_farm_sheet("j", 0, &made_image); }},
  });
  CHECK(entity == nullptr);
  CHECK(made_scene == nullptr);
  CHECK(made_image == nullptr);
  CHECK(job == nullptr);
  CHECK(buffer == nullptr);
  CHECK(number == 7);
  CHECK(byte == 9);
  CHECK(count == 9);
}

TEST_CASE("what has no status answers NULL with nothing") {
  CHECK(crt_entity_is_solid(nullptr) == 0);
  CHECK(crt_entity_primitive_count(nullptr) == 0);
  CHECK(crt_scene_entity_count(nullptr) == 0);
  CHECK(crt_scene_light_count(nullptr) == 0);
  CHECK(crt_image_width(nullptr) == 0);
  CHECK(crt_image_height(nullptr) == 0);
  CHECK(crt_image_pixels(nullptr, nullptr) == nullptr);
  CHECK(crt_buffer_data(nullptr) == nullptr);
  CHECK(crt_buffer_size(nullptr) == 0);
  CHECK(crt_diagnostics_count(nullptr) == 0);
  CHECK(std::string(crt_diagnostics_text(nullptr)).empty());
  CHECK(std::string(crt_diagnostics_json(nullptr)) == "[]");
  CHECK(crt_entity_retain(nullptr) == nullptr);
  CHECK(crt_image_retain(nullptr) == nullptr);
  crt_entity_release(nullptr);
  crt_scene_release(nullptr);
  crt_prepared_release(nullptr);
  crt_job_release(nullptr);
  crt_image_release(nullptr);
  crt_buffer_release(nullptr);
  crt_diagnostics_release(nullptr);
  CHECK(crt_profile_retain(nullptr) == nullptr);
  crt_profile_release(nullptr);
}

TEST_CASE("counts and strides that no memory has are refused before anything is touched") {
  const SceneHandle scene = small_scene();
  const PreparedHandle prepared = prepare(scene.get());
  const crt_ray ray = {{0, 0, 0}, {0, 0, 1}, 0, infinity};
  crt_hit hit = {};
  hit.t = 42;
  std::uint8_t byte = 9;
  double number = 42;
  float pixel[4] = {0, 0, 0, 1};
  crt_image* image = nullptr;
  constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
  const ImageHandle picture = render(prepared.get());
  check_all({
      {"rays", [&] { return crt_intersect(prepared.get(), &ray, 0, most, &hit, 0); }},
      {"rays", [&] { return crt_intersect(prepared.get(), &ray, most, 2, &hit, 0); }},
      {"rays", [&] { return crt_intersect(prepared.get(), &ray, 8, 1, &hit, 0); }},
      {"hits", [&] { return crt_intersect(prepared.get(), &ray, 0, 1, &hit, 55); }},
      {"rays", [&] { return crt_distances(prepared.get(), &ray, 63, 1, &number, nullptr); }},
      {"rays", [&] { return crt_distances(prepared.get(), &ray, 0, most, &number, nullptr); }},
      {"rays", [&] { return crt_occluded(prepared.get(), &ray, 63, 1, &byte); }},
      {"width", [&] { return crt_image_create(0, 1, pixel, 0, &image); }},
      {"height", [&] { return crt_image_create(1, 0, pixel, 0, &image); }},
      {"width", [&] { return crt_image_create(0xffffffffu, 1, pixel, 0, &image); }},
      {"picture", [&] { return crt_image_create(1u << 30, 1u << 30, pixel, 0, &image); }},
      {"picture", [&] { return crt_image_from_rgba8(1u << 20, 1u << 20, &byte, 0, &image); }},
      {"row_stride", [&] { return crt_image_create(1, 1, pixel, 15, &image); }},
      {"row_stride", [&] { return crt_image_to_rgba8(picture.get(), &byte, 3); }},
      {"row_stride", [&] { return crt_image_to_rgba8(picture.get(), &byte, most); }},
      {"index", [&] { return crt_scene_get_light(scene.get(), most, nullptr); }},
  });
  CHECK(hit.t == 42);
  CHECK(number == 42);
  CHECK(byte == 9);
  CHECK(image == nullptr);
}

TEST_CASE("no rays and no triangles are no trouble") {
  const SceneHandle scene = new_scene();
  const PreparedHandle prepared = prepare(scene.get());
  CHECK(crt_intersect(prepared.get(), nullptr, 0, 0, nullptr, 0) == CRT_OK);
  CHECK(crt_distances(prepared.get(), nullptr, 0, 0, nullptr, nullptr) == CRT_OK);
  CHECK(crt_occluded(prepared.get(), nullptr, 0, 0, nullptr) == CRT_OK);
  crt_entity* out = nullptr;
  const double corner = 0;
  const std::uint32_t index = 0;
  CHECK(crt_mesh_create(&corner, 0, &index, 0, &out) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(crt_union_create(nullptr, 0, &out) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(out == nullptr);
}

TEST_CASE("a failure leaves the result untouched, and success leaves the message") {
  const EntityHandle ball = sphere(zero, 1);
  crt_entity* const before = ball.get();
  crt_entity* out = before;
  CHECK(crt_sphere_create(zero.data(), -1, &out) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(out == before);
  const std::string complaint = message();
  CHECK(says("radius"));
  const EntityHandle other = sphere(one, 2);
  CHECK(message() == complaint);
}
