// Structs may be longer or shorter than the library's, as from other versions of the header.
#include <cstddef>
#include <cstring>
#include <vector>

#include "support.hpp"

using namespace crt::test;

namespace {

/// Guarded is a struct's bytes with a guard behind them.
template <class Struct>
struct Guarded {
  explicit Guarded(std::size_t new_size) : size(new_size), bytes(new_size + guard, 0x5a) {}

  Struct* get() { return reinterpret_cast<Struct*>(bytes.data()); }

  bool untouched_behind() const {
    for (std::size_t i = size; i < bytes.size(); ++i) {
      if (bytes[i] != 0x5a) return false;
    }
    return true;
  }

  std::uint32_t struct_size() const {
    std::uint32_t result = 0;
    std::memcpy(&result, bytes.data(), sizeof result);
    return result;
  }

  static constexpr std::size_t guard = 64;
  std::size_t size;
  std::vector<unsigned char> bytes;
};

/// Initialises structs of every length. Nothing may be written behind them, and what fits has its
/// default.
template <class Struct, class Init>
void check_init(const Init& init, std::size_t size_of_other_defaults = 0) {
  Struct whole;
  REQUIRE(init(&whole, sizeof whole) == CRT_OK);
  for (std::size_t size = 4; size <= sizeof whole + 40; ++size) {
    if (size == size_of_other_defaults) continue;
    Guarded<Struct> given(size);
    REQUIRE(init(given.get(), size) == CRT_OK);
    CHECK(given.untouched_behind());
    CHECK(given.struct_size() == size);
    // Every byte is the default's, or 0 where a field is cut in two or the library has none.
    for (std::size_t i = 4; i < size; ++i) {
      const unsigned char expected =
          i < sizeof whole ? reinterpret_cast<const unsigned char*>(&whole)[i] : 0;
      REQUIRE((given.bytes[i] == expected || given.bytes[i] == 0));
    }
  }
  Guarded<Struct> none(0);
  for (const std::size_t bad :
       {std::size_t{0}, std::size_t{3}, std::numeric_limits<std::size_t>::max()}) {
    CHECK(init(none.get(), bad) == CRT_ERROR_INVALID_ARGUMENT);
    CHECK(says("struct_size"));
    CHECK(none.untouched_behind());
  }
  CHECK(init(nullptr, sizeof whole) == CRT_ERROR_INVALID_ARGUMENT);
}

crt_settings small_settings() {
  crt_settings settings;
  REQUIRE(crt_settings_init(&settings, sizeof settings) == CRT_OK);
  settings.width = 8;
  settings.height = 6;
  return settings;
}

}  // namespace

TEST_CASE("initialising writes the defaults and nothing behind the size that was given") {
  check_init<crt_pattern>(crt_pattern_init);
  check_init<crt_material>(crt_material_init);
  check_init<crt_principled>(crt_principled_init);
  check_init<crt_light>(crt_light_init, offsetof(crt_light, edge_a));  // of 1.0
  check_init<crt_camera>(crt_camera_init);
  check_init<crt_background>(crt_background_init);
  check_init<crt_settings>(crt_settings_init, offsetof(crt_settings, precision));  // of 1.0
  check_init<crt_custom>(crt_custom_init);
  check_init<crt_mass>(crt_mass_init);
  check_init<crt_measure_options>(crt_measure_options_init);
  check_init<crt_script_options>(crt_script_options_init);
  check_init<crt_render_options>(crt_render_options_init);
  check_init<crt_write_options>(crt_write_options_init);
  check_init<crt_farm_options>(crt_farm_options_init);
  check_init<crt_farm_work_options>(crt_farm_work_options_init);
  check_init<crt_farm_merge_options>(crt_farm_merge_options_init);
}

TEST_CASE("a struct without a size is an error that says so") {
  const SceneHandle scene = new_scene();
  const crt_light light = {};
  CHECK(crt_scene_add_light(scene.get(), &light) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("light has a struct_size of 0"));
  const crt_settings settings = {};
  CHECK(crt_scene_set_settings(scene.get(), &settings) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("struct_size of 0"));
  crt_camera camera = {};
  CHECK(crt_scene_get_camera(scene.get(), &camera) == CRT_ERROR_INVALID_ARGUMENT);
  const PreparedHandle prepared = prepare(scene.get());
  const crt_render_options options = {};
  crt_image* image = nullptr;
  CHECK(crt_render(prepared.get(), &options, &image) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("options has a struct_size of 0"));
  CHECK(image == nullptr);
}

TEST_CASE("what a struct from an older header does not have keeps its default") {
  const SceneHandle scene = new_scene();
  crt_settings settings = small_settings();
  settings.gamma = 3;
  settings.seed = 77;
  // An older header's struct ended before gamma. The library must not read the bytes behind it.
  settings.struct_size = offsetof(crt_settings, gamma);
  REQUIRE(crt_scene_set_settings(scene.get(), &settings) == CRT_OK);
  crt_settings back = small_settings();
  REQUIRE(crt_scene_get_settings(scene.get(), &back) == CRT_OK);
  CHECK(back.width == 8);
  CHECK(back.gamma == 2.2);
  CHECK(back.seed == 0);
  CHECK(std::string(back.title).empty());
  // A struct whose end cuts a field in two does not have that field.
  settings.struct_size = offsetof(crt_settings, gamma) + 7;
  REQUIRE(crt_scene_set_settings(scene.get(), &settings) == CRT_OK);
  REQUIRE(crt_scene_get_settings(scene.get(), &back) == CRT_OK);
  CHECK(back.gamma == 2.2);
}

TEST_CASE("settings that end as those of version 1.0 have the defaults of that version") {
  constexpr std::size_t size_in_1_0 = offsetof(crt_settings, precision);
  Guarded<crt_settings> settings(size_in_1_0);
  REQUIRE(crt_settings_init(settings.get(), size_in_1_0) == CRT_OK);
  CHECK(settings.untouched_behind());
  CHECK(settings.get()->gamma == 1);
  CHECK(settings.get()->falloff_model == CRT_FALLOFF_PATH);
  CHECK(settings.get()->width == 640);
  const SceneHandle scene = new_scene();
  REQUIRE(crt_scene_set_settings(scene.get(), settings.get()) == CRT_OK);
  crt_settings back;
  back.struct_size = sizeof back;
  REQUIRE(crt_scene_get_settings(scene.get(), &back) == CRT_OK);
  CHECK(back.gamma == 1);
  CHECK(back.falloff_model == CRT_FALLOFF_PATH);
  CHECK(back.ambient_model == CRT_AMBIENT_LIGHT);
  CHECK(back.compat == 0);
}

TEST_CASE("a camera has one radius of the lens, and a struct of version 1.0 has no other") {
  const SceneHandle scene = new_scene();
  crt_camera camera;
  REQUIRE(crt_camera_init(&camera, sizeof camera) == CRT_OK);
  CHECK(camera.lens_radius == 0);
  camera.lens_radius = 0.25;
  REQUIRE(crt_scene_set_camera(scene.get(), &camera) == CRT_OK);
  crt_camera back;
  back.struct_size = sizeof back;
  REQUIRE(crt_scene_get_camera(scene.get(), &back) == CRT_OK);
  CHECK(back.lens_radius == 0.25);
  camera.aperture = 250;
  CHECK(crt_scene_set_camera(scene.get(), &camera) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("lens_radius must be 0 where there is an aperture"));
  camera.struct_size = offsetof(crt_camera, lens_radius);
  REQUIRE(crt_scene_set_camera(scene.get(), &camera) == CRT_OK);
  REQUIRE(crt_scene_get_camera(scene.get(), &back) == CRT_OK);
  CHECK(back.aperture == 250);
  CHECK(back.lens_radius == 0);
}

TEST_CASE("a struct from a newer header is taken as far as this library knows it") {
  struct NewerLight {
    crt_light light;
    double brilliance[4];
  } newer;
  REQUIRE(crt_light_init(&newer.light, sizeof newer) == CRT_OK);
  CHECK(newer.light.struct_size == sizeof newer);
  CHECK(newer.brilliance[3] == 0);
  newer.light.origin[1] = 5;
  const SceneHandle scene = new_scene();
  REQUIRE(crt_scene_add_light(scene.get(), &newer.light) == CRT_OK);
  newer.light.origin[1] = 6;
  newer.brilliance[0] = 3;
  REQUIRE(crt_scene_get_light(scene.get(), 0, &newer.light) == CRT_OK);
  CHECK(newer.light.origin[1] == 5);
  CHECK(newer.brilliance[0] == 3);
}

TEST_CASE("what is asked for is written as far as the caller's struct goes") {
  const SceneHandle scene = small_scene();
  const PreparedHandle prepared = prepare(scene.get());
  const ImageHandle image = render(prepared.get());
  constexpr std::size_t size = offsetof(crt_render_stats, shadow_rays);
  Guarded<crt_render_stats> stats(size);
  const std::uint32_t given = size;
  std::memcpy(stats.bytes.data(), &given, sizeof given);
  REQUIRE(crt_image_stats(image.get(), stats.get()) == CRT_OK);
  CHECK(stats.untouched_behind());
  CHECK(stats.struct_size() == size);
  CHECK(stats.get()->pixels == 40 * 30);
  CHECK(stats.get()->camera_rays == 40 * 30);
}

TEST_CASE("what a scene was given it gives back") {
  const SceneHandle scene = new_scene();
  for (const std::int32_t type :
       {CRT_LIGHT_POINT, CRT_LIGHT_PARALLEL, CRT_LIGHT_SPOT, CRT_LIGHT_CYLINDER, CRT_LIGHT_SPHERE,
        CRT_LIGHT_DISC, CRT_LIGHT_RECTANGLE, CRT_LIGHT_ENVIRONMENT}) {
    crt_light light;
    REQUIRE(crt_light_init_type(&light, sizeof light, type) == CRT_OK);
    CHECK(light.type == type);
    if (type != CRT_LIGHT_ENVIRONMENT) {
      light.origin[2] = -4;
      light.color[0] = 2.5;
    }
    if (type <= CRT_LIGHT_CYLINDER) light.ambient = 0.25;
    if (type == CRT_LIGHT_POINT) light.radius = 0.5;
    if (type == CRT_LIGHT_PARALLEL) light.angle = 0.5;
    if (type == CRT_LIGHT_RECTANGLE) light.edge_a[0] = 3;
    if (type == CRT_LIGHT_DISC) light.two_sided = 1;
    if (type == CRT_LIGHT_SPHERE) light.visible = 0;
    REQUIRE(crt_scene_add_light(scene.get(), &light) == CRT_OK);
    crt_light back;
    back.struct_size = sizeof back;
    REQUIRE(crt_scene_get_light(scene.get(), crt_scene_light_count(scene.get()) - 1, &back) ==
            CRT_OK);
    CHECK(std::memcmp(&back, &light, sizeof back) == 0);
  }

  crt_camera camera;
  REQUIRE(crt_camera_init(&camera, sizeof camera) == CRT_OK);
  camera.projection = CRT_PROJECTION_ORTHOGRAPHIC;
  camera.position[0] = 3;
  camera.aperture = 12;
  camera.aperture_shape = CRT_APERTURE_HEXAGON;
  REQUIRE(crt_scene_set_camera(scene.get(), &camera) == CRT_OK);
  crt_camera camera_back;
  camera_back.struct_size = sizeof camera_back;
  REQUIRE(crt_scene_get_camera(scene.get(), &camera_back) == CRT_OK);
  CHECK(std::memcmp(&camera_back, &camera, sizeof camera) == 0);

  crt_settings settings = small_settings();
  settings.title = "A title";
  settings.notes = "caf\xc3\xa9";
  settings.seed = 0xfedcba9876543210;
  settings.show_clip = 1;
  settings.target_error = 0.125;
  settings.time_budget = 2.5;
  settings.filter_width = 4;
  settings.min_samples = 8;
  settings.max_samples = 32;
  settings.filter = CRT_FILTER_BLACKMAN_HARRIS;
  settings.frames = 48;
  REQUIRE(crt_scene_set_settings(scene.get(), &settings) == CRT_OK);
  crt_settings settings_back;
  settings_back.struct_size = sizeof settings_back;
  REQUIRE(crt_scene_get_settings(scene.get(), &settings_back) == CRT_OK);
  CHECK(std::string(settings_back.title) == "A title");
  CHECK(std::string(settings_back.notes) == "caf\xc3\xa9");
  CHECK(std::string(settings_back.author).empty());
  CHECK(settings_back.seed == settings.seed);
  CHECK(settings_back.show_clip == 1);
  CHECK(settings_back.width == 8);
  CHECK(settings_back.target_error == 0.125);
  CHECK(settings_back.time_budget == 2.5);
  CHECK(settings_back.filter_width == 4);
  CHECK(settings_back.min_samples == 8);
  CHECK(settings_back.max_samples == 32);
  CHECK(settings_back.filter == CRT_FILTER_BLACKMAN_HARRIS);
  CHECK(settings_back.frames == 48);
}

TEST_CASE("a background's image goes in and comes out, and outlives its handle") {
  const SceneHandle scene = new_scene();
  const float pixels[8] = {1, 0, 0, 1, 0, 0, 1, 1};
  ImageHandle image =
      made<ImageHandle>([&](crt_image** out) { return crt_image_create(2, 1, pixels, 0, out); });
  crt_background background;
  REQUIRE(crt_background_init(&background, sizeof background) == CRT_OK);
  background.type = CRT_BACKGROUND_SPHERICAL;
  CHECK(crt_scene_set_background(scene.get(), &background) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("background.image"));
  background.image = image.get();
  background.angle = 1;
  REQUIRE(crt_scene_set_background(scene.get(), &background) == CRT_OK);
  image.reset();
  crt_background back;
  back.struct_size = sizeof back;
  REQUIRE(crt_scene_get_background(scene.get(), &back) == CRT_OK);
  CHECK(back.type == CRT_BACKGROUND_SPHERICAL);
  CHECK(back.angle == 1);
  CHECK(crt_image_width(back.image) == 2);
  const float* const kept = crt_image_pixels(back.image, nullptr);
  CHECK(kept[6] == 1);
  const PreparedHandle prepared = prepare(scene.get());
  REQUIRE(crt_background_init(&background, sizeof background) == CRT_OK);
  REQUIRE(crt_scene_set_background(scene.get(), &background) == CRT_OK);
  REQUIRE(crt_scene_get_background(scene.get(), &back) == CRT_OK);
  CHECK(back.image == nullptr);
  CHECK(back.color[0] == 1);
  CHECK(render(prepared.get()) != nullptr);
}

TEST_CASE("the defaults are those of the C++ interface") {
  crt_camera camera;
  crt_camera_init(&camera, sizeof camera);
  CHECK(camera.position[2] == -1);
  CHECK(camera.fov == doctest::Approx(std::acos(-1) / 3));
  crt_settings settings;
  crt_settings_init(&settings, sizeof settings);
  CHECK(settings.width == 640);
  CHECK(settings.height == 480);
  CHECK(settings.recursion_depth == 3);
  CHECK(settings.gamma == 2.2);
  CHECK(settings.falloff_model == CRT_FALLOFF_LIGHT);
  CHECK(settings.ambient_model == CRT_AMBIENT_SURFACE);
  CHECK(settings.min_weight == 1.0 / 1024);
  CHECK(settings.target_error == 0);
  CHECK(settings.time_budget == 0);
  CHECK(settings.min_samples == 16);
  CHECK(settings.max_samples == 1024);
  CHECK(settings.filter == CRT_FILTER_BOX);
  CHECK(settings.filter_width == 3);
  CHECK(settings.title == nullptr);
  CHECK(settings.indirect == 0);
  CHECK(settings.light_samples == 1);
  CHECK(settings.tone_map == CRT_TONE_MAP_NONE);
  CHECK(settings.exposure == 0);
  CHECK(settings.clamp == 0);
  crt_material material;
  crt_material_init(&material, sizeof material);
  CHECK(material.color[1] == 0.5);
  CHECK(material.diffuse == -1);
  CHECK(material.shininess == 3);
  crt_pattern wood;
  crt_pattern_init_type(&wood, sizeof wood, CRT_PATTERN_WOOD);
  CHECK(wood.color_a[0] == 0.6);
  CHECK(wood.octaves == 3);
  CHECK(wood.turbulence == 0.1);
}

TEST_CASE("a light whose type is set later has that type's radius and angle") {
  const SceneHandle scene = new_scene();
  crt_light light;
  REQUIRE(crt_light_init(&light, sizeof light) == CRT_OK);
  crt_light back;
  back.struct_size = sizeof back;
  const auto kept = [&](std::int32_t type) {
    light.type = type;
    light.origin[1] = 2;
    REQUIRE(crt_scene_clear_lights(scene.get()) == CRT_OK);
    REQUIRE(crt_scene_add_light(scene.get(), &light) == CRT_OK);
    REQUIRE(crt_scene_get_light(scene.get(), 0, &back) == CRT_OK);
  };
  kept(CRT_LIGHT_CYLINDER);
  CHECK(back.radius == 1);
  kept(CRT_LIGHT_SPHERE);
  CHECK(back.radius == 1);
  kept(CRT_LIGHT_SPOT);
  CHECK(back.angle == doctest::Approx(1.0471975511965976));
  kept(CRT_LIGHT_POINT);
  CHECK(back.radius == 0);
  kept(CRT_LIGHT_PARALLEL);
  CHECK(back.angle == 0);
}

TEST_CASE("points and suns of a program of 1.0 stay as sharp as they were") {
  constexpr std::uint32_t size_in_1_0 = 120;
  const SceneHandle scene = new_scene();
  crt_light light;
  REQUIRE(crt_light_init(&light, size_in_1_0) == CRT_OK);
  CHECK(light.struct_size == size_in_1_0);
  CHECK(light.radius == 1);
  CHECK(light.angle > 1);
  crt_light back;
  back.struct_size = sizeof back;
  for (const std::int32_t type : {CRT_LIGHT_POINT, CRT_LIGHT_PARALLEL}) {
    light.type = type;
    light.origin[1] = 2;
    REQUIRE(crt_scene_clear_lights(scene.get()) == CRT_OK);
    REQUIRE(crt_scene_add_light(scene.get(), &light) == CRT_OK);
    REQUIRE(crt_scene_get_light(scene.get(), 0, &back) == CRT_OK);
    CHECK(back.radius == 0);
    CHECK(back.angle == 0);
  }
}
