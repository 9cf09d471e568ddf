// These tests check patterns of patterns and of several colours, and mappings of pictures.
#include <vector>

#include "support.hpp"

using namespace crt::test;

namespace {

crt_pattern pattern_of(std::int32_t type) {
  crt_pattern pattern;
  REQUIRE(crt_pattern_init_type(&pattern, sizeof pattern, type) == CRT_OK);
  return pattern;
}

/// Says whether a material of this pattern is accepted.
crt_status status_of(const crt_pattern& pattern) {
  const EntityHandle ball = sphere({0, 0, 0}, 1);
  crt_material material;
  REQUIRE(crt_material_init(&material, sizeof material) == CRT_OK);
  material.pattern = &pattern;
  crt_entity* out = nullptr;
  const crt_status status = crt_entity_with_material(ball.get(), &material, &out);
  crt_entity_release(out);
  return status;
}

/// Returns the pixels of a wall that wears the pattern, or those of a script.
std::vector<float> pixels_of(crt_scene* scene) {
  crt_settings settings;
  REQUIRE(crt_settings_init(&settings, sizeof settings) == CRT_OK);
  settings.width = 24;
  settings.height = 18;
  REQUIRE(crt_scene_set_settings(scene, &settings) == CRT_OK);
  crt_light light;
  REQUIRE(crt_light_init(&light, sizeof light) == CRT_OK);
  light.origin[2] = -4;
  light.ambient = 0.5;
  REQUIRE(crt_scene_add_light(scene, &light) == CRT_OK);
  const PreparedHandle prepared = prepare(scene);
  const ImageHandle image = render(prepared.get());
  const float* const pixels = crt_image_pixels(image.get(), nullptr);
  return {pixels, pixels + std::size_t{24} * 18 * 4};
}

std::vector<float> pixels_of(const crt_pattern& pattern) {
  const EntityHandle wall = box({-3, -3, 1}, {3, 3, 2});
  crt_material material;
  REQUIRE(crt_material_init(&material, sizeof material) == CRT_OK);
  material.pattern = &pattern;
  const EntityHandle worn = made<EntityHandle>(
      [&](crt_entity** out) { return crt_entity_with_material(wall.get(), &material, out); });
  const SceneHandle scene = new_scene();
  REQUIRE(crt_scene_add_entity(scene.get(), worn.get()) == CRT_OK);
  return pixels_of(scene.get());
}

std::vector<float> pixels_of_script(const std::string& pattern) {
  const std::string text =
      "Scene { Box { cornerA -> vec3(-3, -3, 1) cornerB -> vec3(3, 3, 2) material -> Material { "
      "color -> " +
      pattern + " } } }";
  const SceneHandle scene = made<SceneHandle>([&](crt_scene** out) {
    return crt_scene_from_script(text.data(), text.size(), "test", nullptr, nullptr, out);
  });
  return pixels_of(scene.get());
}

}  // namespace

TEST_CASE("a pattern within a pattern is that of scripts") {
  crt_pattern inner = pattern_of(CRT_PATTERN_STRIPES);
  inner.scale = 0.1;
  crt_pattern outer = pattern_of(CRT_PATTERN_CHECKER);
  const std::vector<float> plain = pixels_of(outer);
  outer.pattern_b = &inner;
  const std::vector<float> composed = pixels_of(outer);
  CHECK(composed != plain);
  CHECK(composed == pixels_of_script("Checker { colorB -> Stripes { scale -> 0.1 } }"));
}

TEST_CASE("several colours are those of scripts") {
  const crt_color_stop stops[] = {
      {0, {1, 0, 0}, 1}, {0.4, {0, 1, 0}, 1}, {0.4, {0, 0, 1}, 1}, {1, {1, 1, 1}, 1}};
  crt_pattern pattern = pattern_of(CRT_PATTERN_GRADIENT);
  pattern.colors = stops;
  pattern.color_count = std::size(stops);
  CHECK(pixels_of(pattern) ==
        pixels_of_script("Gradient { colors -> [[0, rgb(1, 0, 0)], [0.4, rgb(0, 1, 0)], "
                         "[0.4, rgb(0, 0, 1)], [1, rgb(1, 1, 1)]] }"));
}

TEST_CASE("a picture is laid over a wall by each mapping") {
  const std::vector<float> numbers = {1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1, 1, 1, 1, 1};
  const ImageHandle image = made<ImageHandle>(
      [&](crt_image** out) { return crt_image_create(2, 2, numbers.data(), 0, out); });
  std::vector<std::vector<float>> seen;
  for (std::int32_t mapping = CRT_MAPPING_UV; mapping <= CRT_MAPPING_CYLINDRICAL; ++mapping) {
    crt_pattern pattern = pattern_of(CRT_PATTERN_IMAGE);
    pattern.image = image.get();
    pattern.mapping = mapping;
    seen.push_back(pixels_of(pattern));
    for (std::size_t i = 0; i + 1 < seen.size(); ++i) CHECK(seen[i] != seen.back());
  }
  // The wall faces the camera, as a planar picture along z does.
  crt_pattern pattern = pattern_of(CRT_PATTERN_IMAGE);
  pattern.image = image.get();
  pattern.mapping = CRT_MAPPING_CUBIC;
  CHECK(pixels_of(pattern) == seen[CRT_MAPPING_PLANAR]);
}

TEST_CASE("patterns in a circle, wrong stops and unknown mappings are refused") {
  crt_pattern circle = pattern_of(CRT_PATTERN_WOOD);
  circle.pattern_a = &circle;
  CHECK(status_of(circle) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("more than 5 patterns"));
  const crt_color_stop stops[] = {{0.5, {1, 0, 0}, 1}, {0, {0, 1, 0}, 1}};
  crt_pattern map = pattern_of(CRT_PATTERN_NOISE);
  map.color_count = 2;
  CHECK(status_of(map) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("pattern.colors"));
  map.colors = stops;
  CHECK(status_of(map) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("ascending"));
  map.color_count = ~std::uint64_t{0};
  CHECK(status_of(map) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("pattern.color_count"));
  crt_pattern picture = pattern_of(CRT_PATTERN_IMAGE);
  const float pixel[] = {1, 1, 1, 1};
  const ImageHandle image =
      made<ImageHandle>([&](crt_image** out) { return crt_image_create(1, 1, pixel, 0, out); });
  picture.image = image.get();
  CHECK(status_of(picture) == CRT_OK);
  picture.mapping = 4;
  CHECK(status_of(picture) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("pattern.mapping"));
}

TEST_CASE("a program that knows no nested patterns gets none") {
  crt_pattern pattern = pattern_of(CRT_PATTERN_CHECKER);
  pattern.struct_size = 168;  // that of 1.0
  pattern.pattern_a = &pattern;
  pattern.color_count = 99;
  CHECK(status_of(pattern) == CRT_OK);
}
