// This is a libFuzzer program. It makes random sequences of calls of the C interface, with random
// arguments, wrong ones among them. No call may crash, and each must keep to the rule: a result if
// and only if CRT_OK.
#include <crt/crt.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "fuzz_custom.hpp"
#include "fuzz_farm.hpp"
#include "fuzz_input.hpp"
#include "fuzz_measures.hpp"
#include "fuzz_slots.hpp"
#include "fuzz_traces.hpp"

namespace {

using crt::test::ask_farm;
using crt::test::Input;
using crt::test::measure_entity;
using crt::test::require;
using crt::test::scrambled;
using crt::test::Slots;

class Session {
 public:
  explicit Session(Input input) : input_(input) {}

  void run() {
    constexpr int max_calls = 200;
    for (int i = 0; i < max_calls && !input_.empty(); ++i) call(input_.below(33));
  }

 private:
  void call(std::uint32_t which);
  void make_primitive();
  void combine();
  void dress();
  void edit_scene();
  void edit_settings();
  void run_script();
  void use_prepared();
  void ask_rays();
  void use_image();

  Input input_;
  Slots<crt_entity, crt_entity_release> entities_;
  Slots<crt_scene, crt_scene_release> scenes_;
  Slots<crt_prepared, crt_prepared_release> prepared_;
  Slots<crt_image, crt_image_release> images_;
  Slots<crt_diagnostics, crt_diagnostics_release> diagnostics_;
};

void Session::make_primitive() {
  const auto a = input_.vector();
  const auto b = input_.vector();
  const auto c = input_.vector();
  const double r = input_.number();
  const double s = input_.number();
  const std::uint32_t kind = input_.below(20);
  entities_.make([&](crt_entity** out) {
    switch (kind) {
      case 0:
        return crt_sphere_create(a.data(), r, out);
      case 1:
        return crt_box_create(a.data(), b.data(), out);
      case 2:
        return crt_plane_create(a.data(), b.data(), out);
      case 3:
        return crt_half_plane_create(a.data(), b.data(), c.data(), out);
      case 4:
        return crt_cylinder_create(a.data(), b.data(), r, out);
      case 5:
        return crt_cone_create(a.data(), b.data(), r, s, out);
      case 6:
        return crt_torus_create(a.data(), b.data(), r, s, out);
      case 7:
        return crt_disc_create(a.data(), b.data(), r, out);
      case 8:
        return crt_triangle_create(a.data(), b.data(), c.data(), out);
      case 9:
        return crt_empty_create(out);
      case 10:
        return crt_capsule_create(a.data(), b.data(), r, out);
      case 11: {
        crt_profile* profile = nullptr;
        if (crt_profile_create(&profile) != CRT_OK) return CRT_ERROR_OUT_OF_MEMORY;
        if (input_.below(8) != 0) crt_profile_move_to(profile, a[0], a[1]);
        crt_profile_line_to(profile, b[0], b[1]);
        crt_profile_arc_to(profile, c[0], c[1], r);
        if (input_.below(4) == 0) crt_profile_cubic_to(profile, a[1], a[2], b[1], b[2], s, c[2], r);
        if (input_.below(4) == 0) crt_profile_quadratic_to(profile, a[2], b[0], c[1], r, s);
        if (input_.below(8) == 0) crt_profile_offset(profile, r);
        if (input_.below(8) == 0) crt_profile_svg_path(profile, "M1 0q1 1 2 0t1 1", 16, 0, r);
        if (input_.below(8) == 0) crt_profile_text(profile, "g", 1, nullptr, s, 0, r, 0, nullptr);
        if (input_.below(2) != 0) crt_profile_move_to(profile, b[2], s);
        crt_profile_arc_to(profile, c[2], a[0], s);
        crt_profile_line_to(profile, b[1], r);
        const double path[9] = {a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]};
        crt_status status = CRT_OK;
        switch (input_.below(5)) {
          case 4:
            status = crt_shaped_extrusion_create(profile, r, s, b[0], c[0], 0, out);
            break;
          case 0:
            status = crt_extrusion_create(profile, a.data(), c.data(), out);
            break;
          case 1:
            status = crt_revolution_create(profile, a.data(), c.data(), b[0], out);
            break;
          case 2:
            if (input_.below(4) == 0) {
              status = crt_hull_create(path, input_.below(4), out);
              break;
            }
            status = crt_sweep_create(profile, path, input_.below(4), r, b.data(),
                                      static_cast<std::int32_t>(input_.below(2)), out);
            break;
          default:
            status = crt_tube_create(path, path, input_.below(4),
                                     static_cast<std::int32_t>(input_.below(2)),
                                     static_cast<std::int32_t>(input_.below(2)), s, out);
            break;
        }
        crt_profile_release(profile);
        return status;
      }
      case 12: {
        const double heights[6] = {r, s, a[0], b[1], 0.5, 1};
        return crt_height_field_create(heights, input_.below(4), input_.below(3), b.data(),
                                       c.data(), out);
      }
      case 13:
        return crt_quadric_create(a.data(), b.data(), c.data(), r, out);
      case 14: {
        constexpr std::array<std::string_view, 5> fields = {
            "x * x + y * y + z * z - 1", "1 / x - log(y) + z", "sin(9 * x) * floor(y) + abs(z)",
            "x <", "atan2(y, x) ** z"};
        const std::string_view field = fields[input_.below(fields.size())];
        return crt_implicit_create(field.data(), field.size(), b.data(), c.data(), out);
      }
      case 15: {
        const crt_blob_part parts[2] = {
            {{a[0], a[1], a[2]}, {b[0], b[1], b[2]}, r, s},
            {{c[0], c[1], c[2]}, {c[0], c[1], c[2]}, s, r},
        };
        return crt_blob_create(parts, input_.below(3), 0.5, out);
      }
      case 16:
        return input_.below(2) != 0   ? crt_superellipsoid_create(r, s, out)
               : input_.below(2) != 0 ? crt_thread_create(a.data(), b.data(), r, s, 0, out)
                                      : crt_helix_create(a.data(), b.data(), r, s, c[0], 1, out);
      case 17: {
        auto custom = scrambled<crt_custom>(input_, crt_custom_init);
        crt::test::describe_any(input_, a, b, custom);
        return crt_custom_create(&custom, out);
      }
      case 18:
        return crt_rounded_box_create(a.data(), b.data(), r, out);
      default: {
        const double positions[9] = {a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]};
        const std::uint32_t indices[6] = {0, 1, 2, 2, input_.below(4), 0};
        if (input_.below(2) == 0) return crt_mesh_create(positions, 3, indices, 2, out);
        crt_mesh mesh;
        crt_mesh_init(&mesh, sizeof mesh);
        mesh.positions = mesh.normals = mesh.uv = positions;
        mesh.indices = indices;
        mesh.vertex_count = 3;
        mesh.triangle_count = 2;
        mesh.normal_count = mesh.uv_count = input_.below(4);
        if (input_.below(2) != 0) mesh.normal_indices = mesh.uv_indices = indices;
        if (input_.below(2) != 0) mesh.material_of_triangle = indices;
        mesh.smooth = r;
        crt_mesh_options options;
        crt_mesh_options_init(&options, sizeof options);
        options.fill = static_cast<std::int32_t>(input_.below(4)) - 1;
        options.weld = input_.below(2) == 0 ? 0 : r;
        options.stitch = input_.below(2) == 0 ? 0 : a[0];
        return crt_mesh_create_with_options(&mesh, &options, out);
      }
    }
  });
}

void Session::combine() {
  crt_entity* const parts[3] = {entities_.any(input_), entities_.any(input_),
                                entities_.any(input_)};
  // The depth is limited, so that trees do not grow without bound.
  for (const crt_entity* part : parts) {
    constexpr std::uint64_t enough = 64;
    if (crt_entity_primitive_count(part) > enough) return;
  }
  const std::size_t count = input_.below(4);
  const std::uint32_t kind = input_.below(3);
  entities_.make([&](crt_entity** out) {
    if (kind == 0) return crt_union_create(parts, count, out);
    if (kind == 1) return crt_intersection_create(parts, count, out);
    return crt_difference_create(entities_.any(input_), parts, count, out);
  });
}

void Session::dress() {
  crt_entity* const entity = entities_.any(input_);
  switch (input_.below(4)) {
    case 0: {
      double affine[12];
      for (double& number : affine) number = input_.number();
      entities_.make(
          [&](crt_entity** out) { return crt_entity_with_transform(entity, affine, out); });
      break;
    }
    case 1:
      entities_.make([&](crt_entity** out) {
        return crt_entity_with_id(entity, input_.raw<std::uint32_t>(), out);
      });
      break;
    case 2:
      entities_.make([&](crt_entity** out) {
        const auto yes = static_cast<std::int32_t>(input_.below(2));
        return input_.below(2) == 0 ? crt_entity_with_shadow(entity, yes, out)
                                    : crt_entity_with_visible(entity, yes, out);
      });
      break;
    default: {
      auto material = scrambled<crt_material>(input_, crt_material_init);
      auto pattern = scrambled<crt_pattern>(input_, crt_pattern_init);
      crt_pattern_init_type(&pattern, sizeof pattern,
                            static_cast<std::int32_t>(input_.below(9)) - 1);
      pattern.scale = input_.number();
      pattern.octaves = input_.byte();
      pattern.image = images_.any(input_);
      auto inner = pattern;
      if (input_.below(4) == 0) pattern.pattern_a = &inner;
      if (input_.below(8) == 0) inner.pattern_b = &pattern;  // a circle
      const crt_color_stop stops[] = {{input_.number(), {1, 0, 0}, 1}, {1, {0, 0, 1}, 1}};
      if (input_.below(4) == 0) pattern.colors = stops;
      pattern.color_count = input_.below(3);
      pattern.mapping = static_cast<std::int32_t>(input_.below(6)) - 1;
      material.color[1] = input_.number();
      material.transparency = input_.number();
      material.reflectivity = input_.number();
      material.refractive_index = input_.number();
      if (input_.below(2) == 0) material.pattern = &pattern;
      if (input_.below(2) == 0) material.bump = &pattern;
      entities_.make(
          [&](crt_entity** out) { return crt_entity_with_material(entity, &material, out); });
      auto principled = scrambled<crt_principled>(input_, crt_principled_init);
      principled.roughness = input_.number();
      if (input_.below(2) == 0) principled.roughness_map = &pattern;
      entities_.make(
          [&](crt_entity** out) { return crt_entity_with_principled(entity, &principled, out); });
    }
  }
}

void Session::edit_settings() {
  crt_scene* const scene = scenes_.any(input_);
  auto settings = scrambled<crt_settings>(input_, crt_settings_init);
  settings.width = static_cast<std::int32_t>(input_.below(12)) - 1;
  settings.height = static_cast<std::int32_t>(input_.below(12)) - 1;
  settings.supersampling = static_cast<std::int32_t>(input_.below(3));
  settings.recursion_depth = static_cast<std::int32_t>(input_.below(6));
  settings.gamma = input_.number();
  settings.falloff_model = static_cast<std::int32_t>(input_.below(4)) - 1;
  settings.compat = static_cast<std::int32_t>(2013 + input_.below(3)) *
                    static_cast<std::int32_t>(input_.below(2));
  const std::string title = input_.text();
  settings.title = title.c_str();
  crt_scene_set_settings(scene, &settings);
  settings.struct_size = input_.raw<std::uint16_t>() % (sizeof settings + 1);
  crt_scene_get_settings(scene, &settings);
}

void Session::edit_scene() {
  crt_scene* const scene = scenes_.any(input_);
  switch (input_.below(8)) {
    case 0:
    case 1:
      if (crt_scene_entity_count(scene) < 8) crt_scene_add_entity(scene, entities_.any(input_));
      break;
    case 2: {
      auto light = scrambled<crt_light>(input_, crt_light_init);
      crt_light_init_type(&light, sizeof light, static_cast<std::int32_t>(input_.below(6)) - 1);
      light.origin[0] = input_.number();
      light.falloff = input_.number();
      light.angle = input_.number();
      if (crt_scene_light_count(scene) < 4) crt_scene_add_light(scene, &light);
      light.struct_size = sizeof light;
      crt_scene_get_light(scene, input_.below(5), &light);
      break;
    }
    case 3: {
      auto camera = scrambled<crt_camera>(input_, crt_camera_init);
      camera.projection = static_cast<std::int32_t>(input_.below(6)) - 1;
      camera.position[2] = input_.number();
      camera.fov = input_.number();
      (input_.below(2) == 0 ? camera.aperture : camera.lens_radius) = input_.number();
      camera.aperture_shape = static_cast<std::int32_t>(input_.below(11)) - 1;
      crt_scene_set_camera(scene, &camera);
      break;
    }
    case 4: {
      auto background = scrambled<crt_background>(input_, crt_background_init);
      background.type = static_cast<std::int32_t>(input_.below(7)) - 1;
      background.color[0] = input_.number();
      background.image = images_.any(input_);
      background.angle = input_.number();
      crt_scene_set_background(scene, &background);
      background.struct_size = sizeof background;
      crt_scene_get_background(scene, &background);
      break;
    }
    case 5:
      if (input_.below(4) == 0) crt_scene_clear_entities(scene);
      if (input_.below(4) == 0) crt_scene_clear_lights(scene);
      break;
    case 6:
      crt_scene_replace_entity(scene, input_.below(5), entities_.any(input_));
      if (input_.below(2) == 0) crt_scene_remove_entity(scene, input_.below(5));
      break;
    default:
      edit_settings();
  }
}

void Session::run_script() {
  const std::string text = input_.text();
  auto options = scrambled<crt_script_options>(input_, crt_script_options_init);
  options.max_steps = 1000;
  options.max_entities = 100;
  options.open_file = [](const char*, crt_file_content* content, void*) -> int {
    return crt_file_content_append(content, "x = 1", 5) == CRT_OK ? CRT_FILE_GIVEN
                                                                  : CRT_FILE_NOT_GIVEN;
  };
  options.print = [](const char*, std::size_t length, void*) { return length > 20 ? 1 : 0; };
  crt_diagnostics* diagnostics = nullptr;
  scenes_.make([&](crt_scene** out) {
    return crt_scene_from_script(text.data(), text.size(), "fuzz.crt", &options, &diagnostics, out);
  });
  if (diagnostics != nullptr) diagnostics_.keep(diagnostics);
  crt_diagnostic diagnostic;
  diagnostic.struct_size = sizeof diagnostic;
  const crt_diagnostics* const some = diagnostics_.any(input_);
  for (std::size_t i = 0; i <= crt_diagnostics_count(some); ++i) {
    require((crt_diagnostics_get(some, i, &diagnostic) == CRT_OK) ==
            (i < crt_diagnostics_count(some)));
  }
  require(crt_diagnostics_text(some) != nullptr && crt_diagnostics_json(some) != nullptr);
}

void Session::ask_rays() {
  crt_prepared* const prepared = prepared_.any(input_);
  std::array<crt_ray, 3> rays{};
  for (crt_ray& ray : rays) {
    for (double& number : ray.origin) number = input_.number();
    for (double& number : ray.direction) number = input_.number();
    ray.t_min = input_.number();
    ray.t_max = input_.number();
  }
  std::array<crt_hit, 3> hits{};
  std::array<std::uint8_t, 3> occluded{};
  const crt_status first = crt_intersect(prepared, rays.data(), 0, 3, hits.data(), 0);
  const crt_status second = crt_occluded(prepared, rays.data(), 0, 3, occluded.data());
  std::array<double, 3> distances{};
  std::array<std::uint32_t, 3> ids{};
  const crt_status third = crt_distances(prepared, rays.data(), 0, 3, distances.data(), ids.data());
  require(first == second && first == third);
  for (std::size_t i = 0; first == CRT_OK && i < 3; ++i) {
    const bool hit = hits[i].t < std::numeric_limits<double>::infinity();
    require(hit == (occluded[i] != 0));
    require(distances[i] == hits[i].t && ids[i] == hits[i].entity_id);
    require(!hit || (hits[i].t > rays[i].t_min && hits[i].t < rays[i].t_max));
    std::size_t count = 0;
    crt_hit crossing{};
    require(crt_crossings(prepared, &rays[i], &crossing, 1, &count) == CRT_OK);
    require(hit == (count > 0));
    require(!hit || crossing.t == hits[i].t);
  }
  if (first == CRT_OK) trace_rays(input_, prepared, rays, hits);
}

void Session::use_prepared() {
  crt_prepared* const prepared = prepared_.any(input_);
  auto options = scrambled<crt_render_options>(input_, crt_render_options_init);
  options.threads = 1;
  options.region_width = static_cast<std::int32_t>(input_.below(5));
  options.region_height = static_cast<std::int32_t>(input_.below(5));
  options.region_x = static_cast<std::int32_t>(input_.below(4));
  options.aovs = input_.below(70);
  int calls = static_cast<int>(input_.below(4));
  options.progress_user = &calls;
  // A struct that ends before progress_user has none.
  options.progress = [](double, void* user) {
    return user != nullptr && --*static_cast<int*>(user) == 0 ? 5 : 0;
  };
  images_.make([&](crt_image** out) { return crt_render(prepared, &options, out); });
  ask_rays();
}

void Session::use_image() {
  crt_image* const image = images_.any(input_);
  if (input_.below(3) == 0) {
    std::array<float, 64> pixels;
    for (float& value : pixels) value = static_cast<float>(input_.number());
    const std::uint32_t width = input_.below(5);
    const std::uint32_t height = input_.below(5);
    images_.make(
        [&](crt_image** out) { return crt_image_create(width, height, pixels.data(), 0, out); });
  }
  std::vector<std::uint8_t> bytes(
      std::size_t{4} * crt_image_width(image) * crt_image_height(image) + 1);
  require((crt_image_to_rgba8(image, bytes.data(), 0) == CRT_OK) == (image != nullptr));
  for (std::size_t i = 0; i < crt_image_channel_count(image); ++i) {
    const char* const name = crt_image_channel_name(image, i);
    require((crt_image_channel(image, name) == nullptr) !=
            (crt_image_channel_uint(image, name) == nullptr));
  }
  auto stats = crt_render_stats{};
  stats.struct_size = input_.raw<std::uint16_t>() % (sizeof stats + 1);
  crt_image_stats(image, &stats);
}

void Session::call(std::uint32_t which) {
  if (which < 8) return make_primitive();
  if (which < 13) return combine();
  if (which < 17) return dress();
  if (which < 18) return scenes_.make([](crt_scene** out) { return crt_scene_create(out); });
  const auto copy = [&](crt_scene** out) { return crt_scene_copy(scenes_.any(input_), out); };
  if (which < 19) return scenes_.make(copy);
  if (which < 25) return edit_scene();
  const auto make = [&](crt_prepared** out) {
    return crt_scene_prepare_from(scenes_.any(input_), prepared_.any(input_), out);
  };
  if (which < 27) return prepared_.make(make);
  if (which < 29) return use_prepared();
  if (which < 30) return use_image();
  if (which < 31) return images_.make([&](crt_image** out) { return ask_farm(input_, out); });
  if (which < 32) return measure_entity(input_, entities_.any(input_));
  run_script();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Session(Input(data, size)).run();
  return 0;
}
