// These tests check principled materials of C, and the light that materials give off.
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "support.hpp"

using namespace crt::test;

namespace {

crt_principled principled() {
  crt_principled material;
  REQUIRE(crt_principled_init(&material, sizeof material) == CRT_OK);
  return material;
}

crt_status status_of(const crt_principled* material) {
  const EntityHandle ball = sphere({0, 0, 0}, 1);
  crt_entity* out = nullptr;
  const crt_status status = crt_entity_with_principled(ball.get(), material, &out);
  crt_entity_release(out);
  return status;
}

std::vector<float> pixels_of(crt_scene* scene) {
  crt_settings settings;
  REQUIRE(crt_settings_init(&settings, sizeof settings) == CRT_OK);
  settings.width = 24;
  settings.height = 18;
  REQUIRE(crt_scene_set_settings(scene, &settings) == CRT_OK);
  const PreparedHandle prepared = prepare(scene);
  const ImageHandle image = render(prepared.get());
  const float* const pixels = crt_image_pixels(image.get(), nullptr);
  return {pixels, pixels + std::size_t{24} * 18 * 4};
}

std::vector<float> pixels_of(const crt_principled& material) {
  const EntityHandle ball = sphere({0, 0, 1}, 1);
  const EntityHandle worn = made<EntityHandle>(
      [&](crt_entity** out) { return crt_entity_with_principled(ball.get(), &material, out); });
  const SceneHandle scene = new_scene();
  REQUIRE(crt_scene_add_entity(scene.get(), worn.get()) == CRT_OK);
  return pixels_of(scene.get());
}

std::vector<float> pixels_of_script(const std::string& attributes) {
  const std::string text =
      "Scene { Sphere { center -> vec3(0, 0, 1) radius -> 1 "
      "material -> PrincipledMaterial { " +
      attributes + " } } }";
  const SceneHandle scene = made<SceneHandle>([&](crt_scene** out) {
    return crt_scene_from_script(text.data(), text.size(), "test", nullptr, nullptr, out);
  });
  return pixels_of(scene.get());
}

}  // namespace

TEST_CASE("a principled material has its defaults, and looks as that of a script") {
  crt_principled material = principled();
  CHECK(material.color[1] == 0.8);
  CHECK(material.metallic == 0);
  CHECK(material.roughness == 0.5);
  CHECK(material.refractive_index == 1.5);
  CHECK(material.bump_height == 0.1);
  CHECK(material.normal_map == nullptr);
  CHECK(pixels_of(material) == pixels_of_script(""));
  material.metallic = 1;
  material.roughness = 0.25;
  material.color[0] = 0.5;
  CHECK(pixels_of(material) ==
        pixels_of_script("color -> rgb(0.5, 0.8, 0.8) metallic -> 1 roughness -> 0.25"));
  CHECK(pixels_of(material) != pixels_of_script(""));
}

TEST_CASE("patterns of a principled material take the place of its numbers") {
  crt_pattern pattern;
  REQUIRE(crt_pattern_init_type(&pattern, sizeof pattern, CRT_PATTERN_CHECKER) == CRT_OK);
  pattern.scale = 0.3;
  crt_principled material = principled();
  material.pattern = &pattern;
  CHECK(pixels_of(material) == pixels_of_script("color -> Checker { scale -> 0.3 }"));
  for (const crt_pattern* crt_principled::*map :
       {&crt_principled::metallic_map, &crt_principled::roughness_map,
        &crt_principled::emission_map, &crt_principled::bump, &crt_principled::normal_map}) {
    crt_principled mapped = principled();
    mapped.*map = &pattern;
    CHECK(status_of(&mapped) == CRT_OK);
    crt_pattern wrong = pattern;
    wrong.scale = -1;
    mapped.*map = &wrong;
    CHECK(status_of(&mapped) == CRT_ERROR_INVALID_ARGUMENT);
    CHECK(says("scale"));
  }
}

TEST_CASE("wrong numbers of a principled material are errors that name the field") {
  CHECK(status_of(nullptr) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("material"));
  const auto refused = [](double crt_principled::*field, double value, const char* name) {
    crt_principled material = principled();
    material.*field = value;
    CHECK(status_of(&material) == CRT_ERROR_INVALID_ARGUMENT);
    CHECK(says(name));
  };
  refused(&crt_principled::metallic, 1.5, "metallic");
  refused(&crt_principled::roughness, -0.1, "roughness");
  refused(&crt_principled::refractive_index, 0, "refractive_index");
  refused(&crt_principled::transmission, 2, "transmission");
  refused(&crt_principled::coat, -1, "coat");
  refused(&crt_principled::coat_roughness, 2, "coat_roughness");
  refused(&crt_principled::sheen, std::numeric_limits<double>::quiet_NaN(), "sheen");
  crt_principled material = principled();
  material.emission[2] = -1;
  CHECK(status_of(&material) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("emission"));
}

TEST_CASE("each triangle of a mesh has a material of either kind") {
  const double corners[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
  const std::uint32_t indices[] = {0, 1, 2, 0, 2, 3};
  crt_material plain;
  REQUIRE(crt_material_init(&plain, sizeof plain) == CRT_OK);
  plain.color[1] = 0.25;
  crt_principled brass = principled();
  brass.metallic = 1;
  brass.roughness = 0.25;
  crt_mesh mesh;
  REQUIRE(crt_mesh_init(&mesh, sizeof mesh) == CRT_OK);
  CHECK(mesh.principled == nullptr);
  mesh.positions = corners;
  mesh.vertex_count = 4;
  mesh.indices = indices;
  mesh.triangle_count = 2;
  const crt_material* const materials[] = {&plain, nullptr};
  const crt_principled* const principled[] = {nullptr, &brass};
  const std::uint32_t of_triangles[] = {0, 1};
  mesh.materials = materials;
  mesh.principled = principled;
  mesh.material_count = 2;
  mesh.material_of_triangle = of_triangles;
  const auto shown = [](const std::vector<crt_entity*>& entities) {
    const SceneHandle scene = new_scene();
    for (crt_entity* entity : entities)
      REQUIRE(crt_scene_add_entity(scene.get(), entity) == CRT_OK);
    return pixels_of(scene.get());
  };
  const EntityHandle made_of_both =
      made<EntityHandle>([&](crt_entity** out) { return crt_mesh_create_with(&mesh, out); });
  // The same triangles by themselves, each as an entity that has its material.
  const EntityHandle first = made<EntityHandle>(
      [&](crt_entity** out) { return crt_mesh_create(corners, 4, indices, 1, out); });
  const EntityHandle second = made<EntityHandle>(
      [&](crt_entity** out) { return crt_mesh_create(corners, 4, indices + 3, 1, out); });
  const EntityHandle first_worn = made<EntityHandle>(
      [&](crt_entity** out) { return crt_entity_with_material(first.get(), &plain, out); });
  const EntityHandle second_worn = made<EntityHandle>(
      [&](crt_entity** out) { return crt_entity_with_principled(second.get(), &brass, out); });
  const std::vector<float> wanted = shown({first_worn.get(), second_worn.get()});
  CHECK(shown({made_of_both.get()}) == wanted);
  const EntityHandle one_kind = made<EntityHandle>(
      [&](crt_entity** out) { return crt_entity_with_principled(first.get(), &brass, out); });
  CHECK(shown({one_kind.get(), second_worn.get()}) != wanted);

  mesh.materials = nullptr;
  const crt_principled* const all_principled[] = {&brass, &brass};
  mesh.principled = all_principled;
  const EntityHandle made_of_one =
      made<EntityHandle>([&](crt_entity** out) { return crt_mesh_create_with(&mesh, out); });
  CHECK(shown({made_of_one.get()}) == shown({one_kind.get(), second_worn.get()}));

  crt_entity* out = nullptr;
  mesh.principled = principled;
  CHECK(crt_mesh_create_with(&mesh, &out) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("materials must not be NULL"));
  mesh.materials = materials;
  mesh.principled = all_principled;
  CHECK(crt_mesh_create_with(&mesh, &out) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("principled[0] must be NULL, as materials has that number"));
  mesh.principled = principled;
  brass.metallic = 2;
  CHECK(crt_mesh_create_with(&mesh, &out) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("metallic"));
  CHECK(out == nullptr);
}

TEST_CASE("a struct that ends before the principled materials of a mesh has none") {
  const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::uint32_t indices[] = {0, 1, 2};
  const crt_principled brass = principled();
  const crt_principled* const beyond[] = {&brass};
  crt_material plain;
  REQUIRE(crt_material_init(&plain, sizeof plain) == CRT_OK);
  const crt_material* const materials[] = {&plain};
  crt_mesh mesh;
  REQUIRE(crt_mesh_init(&mesh, offsetof(crt_mesh, principled)) == CRT_OK);
  mesh.positions = corners;
  mesh.vertex_count = 3;
  mesh.indices = indices;
  mesh.triangle_count = 1;
  mesh.material_count = 1;
  mesh.materials = materials;
  mesh.principled = beyond;
  CHECK(made<EntityHandle>([&](crt_entity** out) { return crt_mesh_create_with(&mesh, out); }));
  mesh.struct_size = sizeof mesh;
  crt_entity* out = nullptr;
  CHECK(crt_mesh_create_with(&mesh, &out) == CRT_ERROR_INVALID_ARGUMENT);
}

TEST_CASE("a material of a program of 1.0 gives off no light") {
  crt_material material;
  REQUIRE(crt_material_init(&material, offsetof(crt_material, emission)) == CRT_OK);
  material.emission[0] = -1;  // is not read
  const EntityHandle ball = sphere({0, 0, 0}, 1);
  crt_entity* out = nullptr;
  CHECK(crt_entity_with_material(ball.get(), &material, &out) == CRT_OK);
  crt_entity_release(out);
  REQUIRE(crt_material_init(&material, sizeof material) == CRT_OK);
  CHECK(material.emission[0] == 0);
  material.emission[0] = -1;
  CHECK(crt_entity_with_material(ball.get(), &material, &out) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("emission"));
}
