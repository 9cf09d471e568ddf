// These tests use scripts of 2015 and their settings through C: see docs/compat.md.
#include <cmath>
#include <cstring>
#include <string>

#include "support.hpp"

using namespace crt::test;

namespace {

crt_settings settings_of(std::int32_t width, std::int32_t height, std::int32_t compat) {
  crt_settings settings;
  REQUIRE(crt_settings_init(&settings, sizeof settings) == CRT_OK);
  CHECK(settings.compat == 0);
  settings.width = width;
  settings.height = height;
  settings.gamma = 1;
  settings.compat = compat;
  return settings;
}

crt_script_options options_of(std::int32_t compat) {
  crt_script_options options;
  REQUIRE(crt_script_options_init(&options, sizeof options) == CRT_OK);
  CHECK(options.compat == 0);
  options.compat = compat;
  return options;
}

crt_status run(const std::string& text, const crt_script_options& options, SceneHandle& scene) {
  crt_scene* out = nullptr;
  const crt_status status =
      crt_scene_from_script(text.data(), text.size(), "test.crt", &options, nullptr, &out);
  scene.reset(out);
  return status;
}

/// Returns the red of the one pixel of an orthographic camera that looks in this direction.
double red_towards(crt_scene* scene, const Numbers& towards) {
  crt_camera camera;
  REQUIRE(crt_camera_init(&camera, sizeof camera) == CRT_OK);
  camera.projection = CRT_PROJECTION_ORTHOGRAPHIC;
  for (int axis = 0; axis < 3; ++axis) {
    camera.position[axis] = 0;
    camera.pointing[axis] = towards[static_cast<std::size_t>(axis)];
  }
  REQUIRE(crt_scene_set_camera(scene, &camera) == CRT_OK);
  const PreparedHandle prepared = prepare(scene);
  return static_cast<double>(crt_image_pixels(render(prepared.get()).get(), nullptr)[0]);
}

}  // namespace

TEST_CASE("a sky is one more type of background, and comes back") {
  crt_background given;
  REQUIRE(crt_background_init(&given, sizeof given) == CRT_OK);
  CHECK(given.turbidity == 3);
  CHECK(given.shines == 1);
  given.type = CRT_BACKGROUND_SKY;
  given.sun[1] = 0.25;
  given.turbidity = 5;
  given.ground[2] = 0.75;
  given.shines = 0;
  const SceneHandle scene = new_scene();
  CHECK(crt_scene_set_background(scene.get(), &given) == CRT_OK);
  crt_background back;
  back.struct_size = sizeof back;
  REQUIRE(crt_scene_get_background(scene.get(), &back) == CRT_OK);
  CHECK(back.type == CRT_BACKGROUND_SKY);
  CHECK(back.sun[1] == 0.25);
  CHECK(back.turbidity == 5);
  CHECK(back.ground[2] == 0.75);
  CHECK(back.shines == 0);
  CHECK(back.scale == 1);
  given.turbidity = 11;
  CHECK(crt_scene_set_background(scene.get(), &given) == CRT_ERROR_INVALID_ARGUMENT);
}

TEST_CASE("an equal-area panorama is one more type of background, and comes back") {
  const SceneHandle scene = new_scene();
  const float pixels[] = {0.125, 0, 0, 1, 0.25, 0, 0, 1,
                          0.5,   0, 0, 1, 1,    0, 0, 1};  // four rows of one pixel
  const ImageHandle image =
      made<ImageHandle>([&](crt_image** out) { return crt_image_create(1, 4, pixels, 0, out); });
  crt_background background;
  REQUIRE(crt_background_init(&background, sizeof background) == CRT_OK);
  background.type = CRT_BACKGROUND_EQUAL_AREA;
  background.image = image.get();
  REQUIRE(crt_scene_set_background(scene.get(), &background) == CRT_OK);
  crt_background back;
  back.struct_size = sizeof back;
  REQUIRE(crt_scene_get_background(scene.get(), &back) == CRT_OK);
  CHECK(back.type == CRT_BACKGROUND_EQUAL_AREA);
  const crt_settings settings = settings_of(1, 1, 0);
  REQUIRE(crt_scene_set_settings(scene.get(), &settings) == CRT_OK);
  // The middles of the rows are at the heights 3/4, 1/4, -1/4 and -3/4.
  for (int row = 0; row < 4; ++row) {
    const double y = 0.75 - 0.5 * row;
    CHECK(red_towards(scene.get(), {std::sqrt(1 - y * y), y, 0}) ==
          doctest::Approx(std::exp2(row - 3)));
  }
  // In 2015 all panoramas were spherical.
  background.type = CRT_BACKGROUND_SPHERICAL;
  REQUIRE(crt_scene_set_background(scene.get(), &background) == CRT_OK);
  const double y = 0.75;
  const Numbers up = {std::sqrt(1 - y * y), y, 0};
  CHECK(red_towards(scene.get(), up) > 0.13);
  const crt_settings in_2015 = settings_of(1, 1, 2015);
  REQUIRE(crt_scene_set_settings(scene.get(), &in_2015) == CRT_OK);
  CHECK(red_towards(scene.get(), up) == doctest::Approx(0.125));
}

TEST_CASE(
    "the settings' compat comes back, cuts 8-bit values, and is refused if there is no such year") {
  const SceneHandle scene = new_scene();
  crt_background background;
  REQUIRE(crt_background_init(&background, sizeof background) == CRT_OK);
  background.color[0] = 0.999;
  background.color[1] = 0.5;
  REQUIRE(crt_scene_set_background(scene.get(), &background) == CRT_OK);
  for (const std::int32_t compat : {0, 2015}) {
    const crt_settings settings = settings_of(1, 1, compat);
    REQUIRE(crt_scene_set_settings(scene.get(), &settings) == CRT_OK);
    crt_settings back;
    back.struct_size = sizeof back;
    REQUIRE(crt_scene_get_settings(scene.get(), &back) == CRT_OK);
    CHECK(back.compat == compat);
    const PreparedHandle prepared = prepare(scene.get());
    std::uint8_t bytes[4] = {};
    REQUIRE(crt_image_to_rgba8(render(prepared.get()).get(), bytes, 0) == CRT_OK);
    CHECK(bytes[0] == (compat == 0 ? 255 : 254));
    CHECK(bytes[1] == (compat == 0 ? 128 : 127));
    CHECK(bytes[2] == 255);
  }
  const crt_settings wrong = settings_of(1, 1, 2014);
  CHECK(crt_scene_set_settings(scene.get(), &wrong) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("compat"));
}

TEST_CASE("a script of 2015 is run as one by the options' compat") {
  const std::string script =
      "in = 2\nScene { Sphere { center -> vec3(0, 0, 0) radius -> rand(in, 1) } }";
  SceneHandle scene;
  CHECK(run(script, options_of(0), scene) == CRT_ERROR_SCRIPT);
  REQUIRE(run(script, options_of(2015), scene) == CRT_OK);
  crt_settings settings;
  settings.struct_size = sizeof settings;
  REQUIRE(crt_scene_get_settings(scene.get(), &settings) == CRT_OK);
  CHECK(settings.compat == 2015);
  CHECK(settings.gamma == 1);
  CHECK(settings.falloff_model == CRT_FALLOFF_PATH);
  CHECK(settings.ambient_model == CRT_AMBIENT_LIGHT);
  crt_camera camera;
  camera.struct_size = sizeof camera;
  REQUIRE(crt_scene_get_camera(scene.get(), &camera) == CRT_OK);
  CHECK(camera.aperture == 3);
  CHECK(camera.focal_distance == 0.5);
  // This is the first number of java.util.Random(1337).
  const PreparedHandle prepared = prepare(scene.get());
  const crt_ray ray = {{0, 0, 0}, {0, 0, 1}, 0, infinity};
  crt_hit hit;
  REQUIRE(crt_intersect(prepared.get(), &ray, 0, 1, &hit, 0) == CRT_OK);
  CHECK(hit.t == doctest::Approx(2 - 0.6599297847448217));
  CHECK(run(script, options_of(2014), scene) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("compat"));
}

TEST_CASE("the empty entity is combined, placed and added as any other, and met by no ray") {
  const EntityHandle nothing =
      made<EntityHandle>([](crt_entity** out) { return crt_empty_create(out); });
  CHECK(crt_entity_is_solid(nothing.get()) == 1);
  CHECK(crt_entity_primitive_count(nothing.get()) == 0);
  CHECK(crt_empty_create(nullptr) == CRT_ERROR_INVALID_ARGUMENT);
  const EntityHandle ball = sphere({0, 0, 5}, 1);
  const EntityHandle whole = difference(ball.get(), nothing.get());
  crt_entity* const both[] = {ball.get(), nothing.get()};
  const EntityHandle common =
      made<EntityHandle>([&](crt_entity** out) { return crt_intersection_create(both, 2, out); });
  CHECK(crt_entity_primitive_count(whole.get()) == 1);
  CHECK(crt_entity_primitive_count(common.get()) == 0);
  const EntityHandle named = made<EntityHandle>(
      [&](crt_entity** out) { return crt_entity_with_id(nothing.get(), 3, out); });
  CHECK(crt_entity_primitive_count(named.get()) == 0);
  const SceneHandle scene = new_scene();
  for (crt_entity* entity : {nothing.get(), whole.get(), common.get()}) {
    REQUIRE(crt_scene_add_entity(scene.get(), entity) == CRT_OK);
  }
  const PreparedHandle prepared = prepare(scene.get());
  const crt_ray ray = {{0, 0, 0}, {0, 0, 1}, 0, infinity};
  crt_hit hit;
  REQUIRE(crt_intersect(prepared.get(), &ray, 0, 1, &hit, 0) == CRT_OK);
  CHECK(hit.t == 4);
  CHECK(hit.entity_id == 1);
}

TEST_CASE("colours above 1 and a falloff below 0 are taken, negative colours are not") {
  const EntityHandle ball = sphere({0, 0, 5}, 1);
  crt_material material;
  REQUIRE(crt_material_init(&material, sizeof material) == CRT_OK);
  material.color[0] = 1.5;
  crt_entity* out = nullptr;
  REQUIRE(crt_entity_with_material(ball.get(), &material, &out) == CRT_OK);
  const EntityHandle painted(out);
  material.color[0] = -0.5;
  CHECK(crt_entity_with_material(ball.get(), &material, &out) == CRT_ERROR_INVALID_ARGUMENT);
  const SceneHandle scene = new_scene();
  REQUIRE(crt_scene_add_entity(scene.get(), painted.get()) == CRT_OK);
  crt_light light;
  REQUIRE(crt_light_init(&light, sizeof light) == CRT_OK);
  light.falloff = -1;
  REQUIRE(crt_scene_add_light(scene.get(), &light) == CRT_OK);
  const crt_settings settings = settings_of(1, 1, 0);
  REQUIRE(crt_scene_set_settings(scene.get(), &settings) == CRT_OK);
  CHECK(red_towards(scene.get(), {0, 0, 1}) == doctest::Approx(1.5));
}
