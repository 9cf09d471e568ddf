// A number that means nothing is refused with a message that names the argument or the field.
#include <functional>
#include <utility>
#include <vector>

#include "wrong_arguments.hpp"

using namespace crt::test;

TEST_CASE("a number that is not finite is refused in every place, with its name") {
  const EntityHandle ball = sphere(zero, 1);
  const SceneHandle scene = new_scene();
  const double heights[4] = {0.5, 1, 0, 0.25};
  const double line[9] = {0, 0, 0, 0, 0, 1, 0, 1, 1};
  const crt_blob_part blob_part = {{0, 0, 0}, {0, 0, 0}, 1, 1};
  const ProfileHandle square = square_profile();
  crt_mass mass;
  CHECK(crt_mass_init(&mass, sizeof mass) == CRT_OK);
  crt_measure_options how;
  crt_measure_options_init(&how, sizeof how);
  crt_surface_mesh* surface = nullptr;
  std::size_t count = 0;
  double place[3];
  for (const double bad : {not_a_number, infinity, -infinity}) {
    for (int axis = 0; axis < 3; ++axis) {
      Numbers v = {1, 2, 3};
      v[static_cast<std::size_t>(axis)] = bad;
      const crt_blob_part wrong_part = {{v[0], v[1], v[2]}, {0, 0, 0}, 1, 1};
      crt_entity* out = nullptr;
      const double* const p = v.data();
      const double* const z = zero.data();
      const double* const u = up.data();
      std::array<double, 9> corners = {0, 0, 0, 1, 0, 0, 0, 1, 0};
      corners[static_cast<std::size_t>(axis) + 3] = bad;
      check_all({
          {"center", [&] { return crt_sphere_create(p, 1, &out); }},
          {"corner_a", [&] { return crt_box_create(p, z, &out); }},
          {"corner_b", [&] { return crt_box_create(z, p, &out); }},
          {"corner_a", [&] { return crt_rounded_box_create(p, z, 0.1, &out); }},
          {"corner_b", [&] { return crt_rounded_box_create(z, p, 0.1, &out); }},
          {"radius", [&] { return crt_rounded_box_create(z, one.data(), bad, &out); }},
          {"normal", [&] { return crt_plane_create(p, z, &out); }},
          {"position", [&] { return crt_plane_create(u, p, &out); }},
          {"direction", [&] { return crt_half_plane_create(u, z, p, &out); }},
          {"from", [&] { return crt_cylinder_create(p, z, 1, &out); }},
          {"to", [&] { return crt_cone_create(z, p, 1, 0, &out); }},
          {"from", [&] { return crt_capsule_create(p, z, 1, &out); }},
          {"from", [&] { return crt_extrusion_create(square.get(), p, z, &out); }},
          {"to", [&] { return crt_extrusion_create(square.get(), z, p, &out); }},
          {"path", [&] { return crt_sweep_create(square.get(), p, 1, 0, u, 0, &out); }},
          {"bend", [&] { return crt_sweep_create(square.get(), line, 2, bad, u, 0, &out); }},
          {"up", [&] { return crt_sweep_create(square.get(), line, 2, 0, p, 0, &out); }},
          {"path", [&] { return crt_tube_create(p, u, 1, 0, 0, 0, &out); }},
          {"radii", [&] { return crt_tube_create(line, p, 3, 0, 0, 0, &out); }},
          {"deviation", [&] { return crt_tube_create(line, u, 2, 1, 0, bad, &out); }},
          {"points", [&] { return crt_hull_create(corners.data(), 3, &out); }},
          {"from", [&] { return crt_helix_create(p, z, 8, 1, 3, 0, &out); }},
          {"radius", [&] { return crt_helix_create(z, u, bad, 1, 3, 0, &out); }},
          {"thickness", [&] { return crt_helix_create(z, u, 8, bad, 3, 0, &out); }},
          {"pitch", [&] { return crt_helix_create(z, u, 8, 1, bad, 0, &out); }},
          {"from", [&] { return crt_thread_create(p, z, 8, 1, 0, &out); }},
          {"diameter", [&] { return crt_thread_create(z, u, bad, 1, 0, &out); }},
          {"pitch", [&] { return crt_thread_create(z, u, 8, bad, 0, &out); }},
          {"from", [&] { return crt_revolution_create(square.get(), p, z, 1, &out); }},
          {"to", [&] { return crt_revolution_create(square.get(), z, p, 1, &out); }},
          {"corner_a", [&] { return crt_height_field_create(heights, 2, 2, p, z, &out); }},
          {"corner_b", [&] { return crt_height_field_create(heights, 2, 2, z, p, &out); }},
          {"heights", [&] { return crt_height_field_create(corners.data(), 3, 2, z, u, &out); }},
          {"squares", [&] { return crt_quadric_create(p, z, u, -1, &out); }},
          {"products", [&] { return crt_quadric_create(u, p, z, -1, &out); }},
          {"linear", [&] { return crt_quadric_create(u, z, p, -1, &out); }},
          {"constant", [&] { return crt_quadric_create(u, z, z, p[0], &out); }},
          {"lower", [&] { return crt_implicit_create("x", 1, p, z, &out); }},
          {"upper", [&] { return crt_implicit_create("x", 1, z, p, &out); }},
          {"parts", [&] { return crt_blob_create(&wrong_part, 1, 0.5, &out); }},
          {"threshold", [&] { return crt_blob_create(&blob_part, 1, bad, &out); }},
          {"east_west", [&] { return crt_superellipsoid_create(bad, 1, &out); }},
          {"axis", [&] { return crt_torus_create(z, p, 1, 0.1, &out); }},
          {"normal", [&] { return crt_disc_create(z, p, 1, &out); }},
          {"b", [&] { return crt_triangle_create(z, p, u, &out); }},
          {"positions",
           [&] { return crt_mesh_create(corners.data(), 3, triangle_indices(), 1, &out); }},
      });
      CHECK(out == nullptr);
    }
    crt_entity* out = nullptr;
    std::array<double, 12> affine = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, bad};
    crt_light light;
    crt_light_init(&light, sizeof light);
    light.falloff = bad;
    crt_camera camera;
    crt_camera_init(&camera, sizeof camera);
    camera.roll = bad;
    crt_settings settings;
    crt_settings_init(&settings, sizeof settings);
    settings.gamma = bad;
    crt_settings exposed;
    crt_settings_init(&exposed, sizeof exposed);
    exposed.exposure = bad;
    crt_background background;
    crt_background_init(&background, sizeof background);
    background.color[1] = bad;
    crt_material material;
    crt_material_init(&material, sizeof material);
    material.absorption[2] = bad;
    crt_script_options options;
    crt_script_options_init(&options, sizeof options);
    options.t = bad;
    crt_scene* made_scene = nullptr;
    check_all({
        {"radius", [&] { return crt_sphere_create(zero.data(), bad, &out); }},
        {"radius", [&] { return crt_cylinder_create(zero.data(), up.data(), bad, &out); }},
        {"radius2", [&] { return crt_cone_create(zero.data(), up.data(), 1, bad, &out); }},
        {"thickness", [&] { return crt_torus_create(zero.data(), up.data(), 1, bad, &out); }},
        {"affine", [&] { return crt_entity_with_transform(ball.get(), affine.data(), &out); }},
        {"falloff", [&] { return crt_scene_add_light(scene.get(), &light); }},
        {"roll", [&] { return crt_scene_set_camera(scene.get(), &camera); }},
        {"exposure", [&] { return crt_scene_set_settings(scene.get(), &exposed); }},
        {"gamma", [&] { return crt_scene_set_settings(scene.get(), &settings); }},
        {"color", [&] { return crt_scene_set_background(scene.get(), &background); }},
        {"absorption", [&] { return crt_entity_with_material(ball.get(), &material, &out); }},
        {"t", [&] { return crt_scene_from_script("", 0, "x", &options, nullptr, &made_scene); }},
        {"relative_width", [&] { return crt_entity_volume(ball.get(), bad, 0, &mass.volume); }},
        {"relative_width", [&] { return crt_entity_area(ball.get(), bad, 0, &mass.area); }},
        {"relative_width", [&] { return crt_entity_mass(ball.get(), bad, 0, &mass); }},
        {"relative_width", [&] { return crt_entity_centroid(ball.get(), bad, 0, mass.centroid); }},
        {"relative_width",
         [&] { return crt_interference(nullptr, 0, bad, 0, nullptr, 0, &count); }},
        {"relative_width",
         [&] {
           return crt_entity_clearance(ball.get(), ball.get(), bad, &mass.volume, place, place);
         }},
    });
    CHECK(out == nullptr);
  }
  for (const double bad : {0.0, -1e-6, 1.5}) {
    check_all(
        {{"relative_width", [&] { return crt_entity_volume(ball.get(), bad, 0, &mass.volume); }}});
  }
  for (const double bad : {-1.0, -infinity, not_a_number}) {
    check_all({
        {"seconds", [&] { return crt_entity_volume(ball.get(), 0.1, bad, &mass.volume); }},
        {"seconds", [&] { return crt_entity_area(ball.get(), 0.1, bad, &mass.area); }},
        {"seconds", [&] { return crt_entity_mass(ball.get(), 0.1, bad, &mass); }},
        {"seconds", [&] { return crt_interference(nullptr, 0, 0.1, bad, nullptr, 0, &count); }},
        {"seconds",
         [&] {
           how.relative_width = 0;
           how.seconds = bad;
           return crt_entity_tessellate_with(ball.get(), 0.1, &how, &surface);
         }},
        {"relative_width",
         [&] {
           how.seconds = 0;
           how.relative_width = bad;
           return crt_entity_tessellate_with(ball.get(), 0.1, &how, &surface);
         }},
    });
  }
  CHECK(crt_scene_light_count(scene.get()) == 0);
}

TEST_CASE("a number that no enumeration has is refused, with the field's name") {
  const SceneHandle scene = new_scene();
  const EntityHandle ball = sphere(zero, 1);
  for (const std::int32_t bad : {-1, 1000, std::numeric_limits<std::int32_t>::min()}) {
    crt_light light;
    crt_light_init(&light, sizeof light);
    light.type = bad;
    crt_camera projection;
    crt_camera_init(&projection, sizeof projection);
    crt_camera aperture = projection;
    projection.projection = bad;
    aperture.aperture_shape = bad;
    crt_background background;
    crt_background_init(&background, sizeof background);
    background.type = bad;
    crt_settings settings;
    crt_settings_init(&settings, sizeof settings);
    settings.falloff_model = bad;
    crt_settings precise;
    crt_settings_init(&precise, sizeof precise);
    precise.precision = bad;
    crt_settings of_no_unit;
    crt_settings_init(&of_no_unit, sizeof of_no_unit);
    of_no_unit.unit = bad;
    crt_settings toned;
    crt_settings_init(&toned, sizeof toned);
    toned.tone_map = bad;
    crt_pattern pattern;
    crt_pattern_init(&pattern, sizeof pattern);
    pattern.type = bad;
    crt_material material;
    crt_material_init(&material, sizeof material);
    material.pattern = &pattern;
    crt_material bumpy = material;
    bumpy.pattern = nullptr;
    bumpy.bump = &pattern;
    crt_entity* out = nullptr;
    check_all({
        {"type", [&] { return crt_scene_add_light(scene.get(), &light); }},
        {"projection", [&] { return crt_scene_set_camera(scene.get(), &projection); }},
        {"aperture_shape", [&] { return crt_scene_set_camera(scene.get(), &aperture); }},
        {"type", [&] { return crt_scene_set_background(scene.get(), &background); }},
        {"tone_map", [&] { return crt_scene_set_settings(scene.get(), &toned); }},
        {"falloff_model", [&] { return crt_scene_set_settings(scene.get(), &settings); }},
        {"precision", [&] { return crt_scene_set_settings(scene.get(), &precise); }},
        {"unit", [&] { return crt_scene_set_settings(scene.get(), &of_no_unit); }},
        {"type", [&] { return crt_entity_with_material(ball.get(), &material, &out); }},
        {"type", [&] { return crt_entity_with_material(ball.get(), &bumpy, &out); }},
        {"type", [&] { return crt_light_init_type(&light, sizeof light, bad); }},
        {"type", [&] { return crt_pattern_init_type(&pattern, sizeof pattern, bad); }},
    });
    CHECK(std::string(crt_status_string(static_cast<crt_status>((bad & 0x3f) | 0x40))) ==
          "unknown");
  }
}
