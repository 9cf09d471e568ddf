// Handles are counted, released in any order, and shared by any thread.
#include <algorithm>
#include <thread>
#include <utility>
#include <vector>

#include "support.hpp"
#include "support/temporary_directory.hpp"

using namespace crt::test;

namespace {

/// Boxes are the triangles of a box from 0 to 4 and of one in it from 1 to 2, both turned outwards.
struct Boxes {
  std::vector<double> positions;
  std::vector<std::uint32_t> indices;
};

Boxes two_boxes() {
  Boxes boxes;
  constexpr std::uint32_t sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& [lower, upper] : {std::pair{0.0, 4.0}, std::pair{1.0, 2.0}}) {
    const auto first = static_cast<std::uint32_t>(boxes.positions.size() / 3);
    for (int i = 0; i < 8; ++i) {
      for (const int bit : {1, 2, 4}) boxes.positions.push_back((i & bit) != 0 ? upper : lower);
    }
    for (const auto& side : sides) {
      for (const int k : {0, 1, 2, 0, 2, 3}) boxes.indices.push_back(first + side[k]);
    }
  }
  return boxes;
}

}  // namespace

TEST_CASE("the version is the header's") {
  CHECK(crt_version() == (CRT_VERSION_MAJOR << 16 | CRT_VERSION_MINOR << 8 | CRT_VERSION_PATCH));
}

TEST_CASE("every status has a name of its own") {
  std::vector<std::string> names;
  for (int status = CRT_OK; status <= CRT_ERROR_INTERNAL; ++status) {
    names.emplace_back(crt_status_string(static_cast<crt_status>(status)));
  }
  CHECK(names[0] == "ok");
  CHECK(names[CRT_ERROR_OUT_OF_MEMORY] == "out of memory");
  std::sort(names.begin(), names.end());
  CHECK(std::adjacent_find(names.begin(), names.end()) == names.end());
  CHECK(std::find(names.begin(), names.end(), "unknown") == names.end());
}

TEST_CASE("handles may be released in every order") {
  // This tries all orders of releasing what a picture is made of. Each is still whole when it is
  // used.
  std::vector<int> order = {0, 1, 2, 3, 4};
  do {
    EntityHandle ball = sphere({0, 0, 2}, 0.5);
    EntityHandle cut = sphere({0, 0, 1.5}, 0.3);
    EntityHandle part = difference(ball.get(), cut.get());
    SceneHandle scene = new_scene();
    REQUIRE(crt_scene_add_entity(scene.get(), part.get()) == CRT_OK);
    PreparedHandle prepared = prepare(scene.get());
    for (const int which : order) {
      if (which == 0) ball.reset();
      if (which == 1) cut.reset();
      if (which == 2) part.reset();
      if (which == 3) scene.reset();
      if (which == 4) {
        const crt_ray ray = {{0, 0, 0}, {0, 0, 1}, 0, infinity};
        crt_hit hit;
        REQUIRE(crt_intersect(prepared.get(), &ray, 0, 1, &hit, 0) == CRT_OK);
        CHECK(hit.t == doctest::Approx(1.8));
        prepared.reset();
      }
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST_CASE("a retained handle lives until its last release") {
  EntityHandle ball = sphere({0, 0, 2}, 0.5);
  const EntityHandle second(crt_entity_retain(ball.get()));
  CHECK(second.get() == ball.get());
  ball.reset();
  CHECK(crt_entity_primitive_count(second.get()) == 1);
}

TEST_CASE("threads may retain and release the same handle at once") {
  const EntityHandle ball = sphere({0, 0, 2}, 0.5);
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&] {
      for (int k = 0; k < 1000; ++k) {
        crt_entity* const mine = crt_entity_retain(ball.get());
        crt_entity* moved = nullptr;
        if (crt_entity_with_id(mine, 7, &moved) == CRT_OK) crt_entity_release(moved);
        crt_entity_release(mine);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(crt_entity_is_solid(ball.get()) == 1);
}

TEST_CASE("entities say what they are") {
  const EntityHandle ball = sphere({0, 0, 2}, 0.5);
  const EntityHandle block = box({0, 0, 0}, {1, 1, 1});
  const EntityHandle part = difference(block.get(), ball.get());
  CHECK(crt_entity_is_solid(part.get()) == 1);
  CHECK(crt_entity_primitive_count(part.get()) == 2);
  const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  const std::uint32_t indices[] = {0, 1, 2, 1, 3, 2, 0, 0, 1};  // the last has no area
  const EntityHandle mesh = made<EntityHandle>(
      [&](crt_entity** out) { return crt_mesh_create(corners, 4, indices, 3, out); });
  CHECK(crt_entity_is_solid(mesh.get()) == 0);
  std::size_t length = 0;
  CHECK(crt_entity_solid_fault(mesh.get(), nullptr, 0, &length) == CRT_OK);
  std::string fault(length + 1, 'x');
  CHECK(crt_entity_solid_fault(mesh.get(), fault.data(), fault.size(), &length) == CRT_OK);
  CHECK(fault.starts_with("a mesh is open: 4 of its 5 edges "));
  CHECK(fault.back() == 0);
  CHECK(crt_entity_solid_fault(mesh.get(), fault.data(), 7, &length) == CRT_OK);
  CHECK(std::string(fault.c_str()) == "a mesh");
  CHECK(crt_entity_solid_fault(ball.get(), fault.data(), 1, &length) == CRT_OK);
  CHECK(length == 0);
  CHECK(crt_entity_primitive_count(mesh.get()) == 2);
  crt_entity* out = nullptr;
  crt_entity* const cutters[] = {mesh.get()};
  CHECK(crt_difference_create(block.get(), cutters, 1, &out) == CRT_ERROR_INVALID_ARGUMENT);
  const std::uint32_t beyond[] = {0, 1, 4};
  CHECK(crt_mesh_create(corners, 4, beyond, 1, &out) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("index 4"));
  CHECK(out == nullptr);
}

TEST_CASE("a mesh has normals, texture coordinates and materials") {
  const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  const std::uint32_t indices[] = {0, 1, 2, 1, 3, 2};
  const double normals[] = {0, 0, -1};
  const std::uint32_t normal_indices[] = {0, 0, 0, 0, UINT32_MAX, 0};
  const double uv[] = {0, 0, 10, 0, 0, 10, 10, 10};
  crt_material materials[2];
  for (crt_material& material : materials) crt_material_init(&material, sizeof material);
  const crt_material* const places[] = {&materials[0], &materials[1]};
  const std::uint32_t material_of_triangle[] = {1, UINT32_MAX};
  crt_mesh mesh;
  REQUIRE(crt_mesh_init(&mesh, sizeof mesh) == CRT_OK);
  CHECK(mesh.smooth == -1);
  mesh.positions = corners;
  mesh.vertex_count = 4;
  mesh.indices = indices;
  mesh.triangle_count = 2;
  mesh.normals = normals;
  mesh.normal_count = 1;
  mesh.normal_indices = normal_indices;
  mesh.uv = uv;
  mesh.uv_count = 4;
  mesh.materials = places;
  mesh.material_count = 2;
  mesh.material_of_triangle = material_of_triangle;
  const EntityHandle entity =
      made<EntityHandle>([&](crt_entity** out) { return crt_mesh_create_with(&mesh, out); });
  const SceneHandle scene = made<SceneHandle>(crt_scene_create);
  REQUIRE(crt_scene_add_entity(scene.get(), entity.get()) == CRT_OK);
  const PreparedHandle prepared =
      made<PreparedHandle>([&](crt_prepared** out) { return crt_scene_prepare(scene.get(), out); });
  const crt_ray ray = {{0.25, 0.5, -1}, {0, 0, 1}, 0, 10};
  crt_hit hit;
  REQUIRE(crt_intersect(prepared.get(), &ray, 0, 1, &hit, 0) == CRT_OK);
  CHECK(hit.u == 2.5);
  CHECK(hit.v == 5);

  crt_entity* out = nullptr;
  mesh.normal_count = 0;
  CHECK(crt_mesh_create_with(&mesh, &out) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("normal_indices[0] has the index 0, but there are 0 normals"));
  mesh.normal_count = 1;
  mesh.smooth = 4;
  CHECK(crt_mesh_create_with(&mesh, &out) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("smooth"));
  CHECK(out == nullptr);
}

TEST_CASE("a mesh has a rule of what is inside, options and a report") {
  const Boxes boxes = two_boxes();
  const auto report_of = [](crt_entity* entity) {
    crt_mesh_report report;
    REQUIRE(crt_mesh_report_init(&report, sizeof report) == CRT_OK);
    REQUIRE(crt_entity_mesh_report(entity, &report) == CRT_OK);
    return report;
  };
  const auto crossings_of = [](crt_entity* entity) {
    const SceneHandle scene = made<SceneHandle>(crt_scene_create);
    REQUIRE(crt_scene_add_entity(scene.get(), entity) == CRT_OK);
    const PreparedHandle prepared = made<PreparedHandle>(
        [&](crt_prepared** out) { return crt_scene_prepare(scene.get(), out); });
    const crt_ray ray = {{1.5, 1.25, -1}, {0, 0, 1}, 0, 100};
    std::size_t count = 0;
    REQUIRE(crt_crossings(prepared.get(), &ray, nullptr, 0, &count) == CRT_OK);
    return count;
  };
  for (const std::int32_t rule : {CRT_FILL_EVEN_ODD, CRT_FILL_NONZERO}) {
    const EntityHandle mesh = made<EntityHandle>([&](crt_entity** out) {
      return crt_mesh_from_triangles_rule(boxes.positions.data(), boxes.positions.size() / 3,
                                          boxes.indices.data(), boxes.indices.size() / 3, rule,
                                          out);
    });
    CHECK(crossings_of(mesh.get()) == (rule == CRT_FILL_NONZERO ? 2 : 4));
    const crt_mesh_report report = report_of(mesh.get());
    CHECK(report.fill == rule);
    CHECK(report.shells == 2);
    CHECK(report.overlapping_shells == 1);
    CHECK(report.first_overlap[0] >= 1);
    std::size_t length = 0;
    REQUIRE(crt_entity_mesh_warnings(mesh.get(), nullptr, 0, &length) == CRT_OK);
    std::string text(length + 1, '?');
    REQUIRE(crt_entity_mesh_warnings(mesh.get(), text.data(), text.size(), &length) == CRT_OK);
    CHECK(text.starts_with("1 of its 2 shells lie in others or overlap"));
  }
  crt_mesh mesh;
  crt_mesh_options options;
  REQUIRE(crt_mesh_init(&mesh, sizeof mesh) == CRT_OK);
  REQUIRE(crt_mesh_options_init(&options, sizeof options) == CRT_OK);
  CHECK(options.fill == -1);
  mesh.positions = boxes.positions.data();
  mesh.vertex_count = boxes.positions.size() / 3;
  mesh.indices = boxes.indices.data();
  mesh.triangle_count = boxes.indices.size() / 3;
  options.weld = 1.5;  // makes a point of each side of the smaller box
  const EntityHandle welded = made<EntityHandle>(
      [&](crt_entity** out) { return crt_mesh_create_with_options(&mesh, &options, out); });
  CHECK(report_of(welded.get()).fill == CRT_FILL_EVEN_ODD);
  CHECK(report_of(welded.get()).welded_vertices > 0);
  CHECK(report_of(welded.get()).welded_triangles > 0);

  crt_entity* out = nullptr;
  options.weld = -1;
  CHECK(crt_mesh_create_with_options(&mesh, &options, &out) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("weld must be from 0 to 1e100"));
  options.fill = 2;
  CHECK(crt_mesh_create_with_options(&mesh, &options, &out) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("crt_fill_rule"));
  crt_mesh_report report;
  REQUIRE(crt_mesh_report_init(&report, sizeof report) == CRT_OK);
  const EntityHandle ball = sphere({0, 0, 0}, 0.5);
  CHECK(crt_entity_mesh_report(ball.get(), &report) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("entity must be one mesh"));
}

TEST_CASE("each thread has its own last message") {
  crt_entity* out = nullptr;
  const double zero[3] = {0, 0, 0};
  CHECK(crt_sphere_create(zero, -1, &out) == CRT_ERROR_INVALID_ARGUMENT);
  std::string others;
  std::thread([&others] { others = crt_error_message(); }).join();
  CHECK(others.empty());
  CHECK(says("radius"));
}

TEST_CASE("an entity is described as JSON, as much of it as fits") {
  const EntityHandle ball = sphere({0, 0, 0}, 0.5);
  std::size_t length = 0;
  REQUIRE(crt_entity_describe(ball.get(), nullptr, 0, &length) == CRT_OK);
  std::string text(length + 1, '?');
  REQUIRE(crt_entity_describe(ball.get(), text.data(), text.size(), &length) == CRT_OK);
  CHECK(text.substr(0, length) ==
        R"([{"kind":"Sphere","parent":null,"values":{"center":[0, 0, 0],"radius":0.5}}])");
  CHECK(text.back() == '\0');
  REQUIRE(crt_entity_describe(ball.get(), text.data(), 4, &length) == CRT_OK);
  CHECK(std::string(text.c_str()) == "[{\"");
  const double affine[12] = {1, 0, 0, 2, 0, 1, 0, 0, 0, 0, 1, 0};
  const EntityHandle moved = made<EntityHandle>(
      [&](crt_entity** out) { return crt_entity_with_transform(ball.get(), affine, out); });
  text.assign(400, '?');
  REQUIRE(crt_entity_describe(moved.get(), text.data(), text.size(), &length) == CRT_OK);
  CHECK(text.find(R"("translation":[2, 0, 0]}},{"kind":"Sphere","parent":0,)") !=
        std::string::npos);
}

TEST_CASE("entities are replaced and taken out at their places, and nowhere else") {
  const SceneHandle scene = small_scene();
  REQUIRE(crt_scene_entity_count(scene.get()) == 2);
  const EntityHandle ball = sphere({0, 0, 0}, 0.125);
  CHECK(crt_scene_replace_entity(scene.get(), 2, ball.get()) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("index"));
  CHECK(crt_scene_remove_entity(scene.get(), 2) == CRT_ERROR_INVALID_ARGUMENT);
  REQUIRE(crt_scene_replace_entity(scene.get(), 1, ball.get()) == CRT_OK);
  REQUIRE(crt_scene_remove_entity(scene.get(), 0) == CRT_OK);
  REQUIRE(crt_scene_entity_count(scene.get()) == 1);
  const EntityHandle left = made<EntityHandle>(
      [&](crt_entity** out) { return crt_scene_get_entity(scene.get(), 0, out); });
  CHECK(crt_entity_primitive_count(left.get()) == 1);
}

TEST_CASE("a scene is saved as a script that renders the same picture") {
  const TemporaryDirectory folder;
  const std::string path = folder / "scene.crt";
  const SceneHandle scene = small_scene();
  REQUIRE(crt_scene_save_script(scene.get(), path.c_str()) == CRT_OK);
  const SceneHandle read = made<SceneHandle>([&](crt_scene** out) {
    return crt_scene_from_script_file(path.c_str(), nullptr, nullptr, out);
  });
  const auto pixels_of = [](crt_scene* of) {
    const ImageHandle image = render(prepare(of).get());
    std::size_t stride = 0;
    const float* const pixels = crt_image_pixels(image.get(), &stride);
    const std::size_t count = crt_image_height(image.get()) * stride / sizeof(float);
    return std::vector<float>(pixels, pixels + count);
  };
  CHECK(pixels_of(read.get()) == pixels_of(scene.get()));
  CHECK(crt_scene_save_script(scene.get(), (folder / "none/scene.crt").c_str()) == CRT_ERROR_IO);
  CHECK(folder.entries() == 1);
}

TEST_CASE("a scene is edited without touching what was prepared or copied from it") {
  const SceneHandle scene = small_scene();
  const PreparedHandle prepared = prepare(scene.get());
  const SceneHandle copy =
      made<SceneHandle>([&](crt_scene** out) { return crt_scene_copy(scene.get(), out); });
  REQUIRE(crt_scene_clear_entities(scene.get()) == CRT_OK);
  REQUIRE(crt_scene_clear_lights(scene.get()) == CRT_OK);
  CHECK(crt_scene_entity_count(scene.get()) == 0);
  CHECK(crt_scene_entity_count(copy.get()) == 2);
  CHECK(crt_scene_light_count(copy.get()) == 1);
  const EntityHandle again = made<EntityHandle>(
      [&](crt_entity** out) { return crt_scene_get_entity(copy.get(), 1, out); });
  CHECK(crt_entity_primitive_count(again.get()) == 2);
  const crt_ray ray = {{-0.4, 0, 0}, {0, 0, 1}, 0, infinity};
  crt_hit hit;
  REQUIRE(crt_intersect(prepared.get(), &ray, 0, 1, &hit, 0) == CRT_OK);
  CHECK(hit.t == doctest::Approx(1.5));
}
