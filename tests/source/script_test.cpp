// Scenes become scripts, which must make the same scene again.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <crt/crt.hpp>
#include <crt/implicit_shapes.hpp>
#include <crt/script.hpp>
#include <crt/source_code.hpp>
#include <filesystem>
#include <limits>
#include <string>

#include "core/entity/entity_node.hpp"
#include "core/geometry/mesh/facet_attributes.hpp"
#include "core/geometry/mesh/triangles.hpp"
#include "support/temporary_directory.hpp"

using namespace crt;
using crt::test::TemporaryDirectory;

namespace {

const SourceOptions as_script{.language = SourceLanguage::script};

/// Saves a scene and runs its script.
Scene again(const Scene& scene, std::vector<std::string>* warnings = nullptr) {
  const TemporaryDirectory folder;
  const std::filesystem::path path = folder / "a scene.crt";
  const std::vector<std::string> list = save_script(scene, path);
  if (warnings != nullptr) *warnings = list;
  const ScriptResult result = run_script_file(path);
  for (const Diagnostic& diagnostic : result.diagnostics) MESSAGE(format_diagnostic(diagnostic));
  REQUIRE(result.scene);
  return *result.scene;
}

Scene scene_of(const Entity& entity) {
  Scene scene;
  scene.entities = {entity};
  return scene;
}

/// Renders few pixels.
std::vector<float> picture_of(Scene scene) {
  scene.settings.width = 48;
  scene.settings.height = 36;
  const Image image = render(prepare(scene));
  return {image.pixels().begin(), image.pixels().end()};
}

void check_same_picture(const Scene& scene) {
  const std::vector<float> wanted = picture_of(scene);
  CHECK(std::any_of(wanted.begin(), wanted.end(), [&](float f) { return f != wanted[0]; }));
  CHECK(picture_of(again(scene)) == wanted);
}

const MeshTriangles& triangles_of(const Scene& scene) {
  const EntityNode& node = scene.entities.at(0).node();
  return *std::get<Mesh>(std::get<Primitive>(node.content)).triangles;
}

}  // namespace

TEST_CASE("numbers of all kinds are read back as they were") {
  constexpr double smallest = std::numeric_limits<double>::denorm_min();
  Scene scene;
  for (const double x :
       {0.1, -1.0 / 3, 1e100, -1e-100, 1e-300, smallest, 123456789012345678.0, 5.0})
    scene.entities.emplace_back(Sphere{.center = {x, -x, 0}, .radius = 1});
  scene.entities.emplace_back(Sphere{.center = {-0.0, 0.0, 0}, .radius = 1});
  const Scene read = again(scene);
  REQUIRE(read.entities.size() == scene.entities.size());
  for (std::size_t i = 0; i < read.entities.size(); ++i) {
    const auto center = [i](const Scene& one) {
      return std::get<Sphere>(std::get<Primitive>(one.entities[i].node().content)).center;
    };
    CHECK(center(read) == center(scene));
    CHECK(std::signbit(center(read).x) == std::signbit(center(scene).x));
  }
}

TEST_CASE("settings, cameras and lights are read back as they were") {
  Scene scene = scene_of(Sphere{});
  scene.settings.title = "tab\there, \"quoted\" \\ and \x01\x7f, é";
  scene.settings.seed = std::numeric_limits<std::int64_t>::max();
  scene.settings.head_light = false;
  scene.camera = {.position = {0, 0, -3}, .projection = Projection::orthographic};
  scene.lights = {PointLight{}, ParallelLight{.from = {0, 1, 0}, .pointing = {0, 0, 0}},
                  SpotLight{}, CylinderLight{}};
  scene.background = GradientBackground{.horizon = {1, 1, 1}, .sky = {0, 0, 1, 0.5}};
  const Scene read = again(scene);
  CHECK(read.settings.title == scene.settings.title);
  CHECK(read.settings.seed == scene.settings.seed);
  CHECK(read.settings.head_light == false);
  CHECK(read.camera.position == scene.camera.position);
  CHECK(read.camera.pointing == scene.camera.pointing);
  CHECK(read.camera.fov == scene.camera.fov);
  CHECK(read.camera.projection == Projection::orthographic);
  CHECK(read.lights.size() == 4);
  CHECK(picture_of(read) == picture_of(scene));
}

TEST_CASE("a sky is read back as it was, with the lights that are there beside it") {
  Scene scene = scene_of(Sphere{});
  scene.lights = {PointLight{.origin = {1, 2, -3}}};
  const SkyBackground sky{
      .sun = {1, 0.25, 0.5}, .turbidity = 5, .scale = 2, .ground = {0.1, 0.2, 0}, .shines = false};
  for (const SkyBackground& background : {sky, SkyBackground{}}) {
    scene.background = background;
    const Scene read = again(scene);
    const auto& found = std::get<SkyBackground>(read.background);
    CHECK(found.sun == background.sun);
    CHECK(found.turbidity == background.turbidity);
    CHECK(found.scale == background.scale);
    CHECK(found.ground == background.ground);
    CHECK(found.shines == background.shines);
    CHECK(read.lights.size() == 1);
    CHECK(picture_of(read) == picture_of(scene));
  }
}

TEST_CASE("principled materials are read back as they were, and light that materials give off") {
  const PrincipledMaterial rich = {.color = Pattern(Marble{.scale = 0.3}),
                                   .metallic = Pattern(Checker{.scale = 0.5}),
                                   .roughness = Pattern(Noise{.scale = 0.2}),
                                   .refractive_index = 1.7,
                                   .transmission = 0.25,
                                   .absorption = {0.1, 0.2, 0.3},
                                   .coat = 0.5,
                                   .coat_roughness = 0.125,
                                   .sheen = 0.75,
                                   .emission = Pattern(Stripes{.scale = 0.1}),
                                   .normal_map = Pattern(Wood{}),
                                   .bump = Pattern(Gradient{}),
                                   .bump_height = 0.01};
  Scene scene = scene_of(Sphere{.material = rich});
  scene.entities.emplace_back(Box{.material = PrincipledMaterial{.metallic = 1.0}});
  scene.entities.emplace_back(Box{.material = Material{.emission = {1, 2, 3}}});
  const Scene read = again(scene);
  const auto material_of = [&](std::size_t i) {
    return std::visit([](const auto& shape) { return *shape.material; },
                      std::get<Primitive>(read.entities.at(i).node().content));
  };
  REQUIRE(material_of(0).principled() != nullptr);
  const PrincipledMaterial& found = *material_of(0).principled();
  CHECK(std::holds_alternative<Marble>(std::get<Pattern>(found.color)));
  CHECK(std::holds_alternative<Checker>(std::get<Pattern>(found.metallic)));
  CHECK(std::get<Noise>(std::get<Pattern>(found.roughness)).scale == 0.2);
  CHECK(found.refractive_index == 1.7);
  CHECK(found.transmission == 0.25);
  CHECK(found.absorption == rich.absorption);
  CHECK(found.coat == 0.5);
  CHECK(found.coat_roughness == 0.125);
  CHECK(found.sheen == 0.75);
  CHECK(std::holds_alternative<Stripes>(std::get<Pattern>(found.emission)));
  CHECK(std::holds_alternative<Wood>(*found.normal_map));
  CHECK(std::holds_alternative<Gradient>(*found.bump));
  CHECK(found.bump_height == 0.01);
  CHECK(std::get<double>(material_of(1).principled()->metallic) == 1);
  CHECK(material_of(2).principled() == nullptr);
  CHECK(material_of(2)->emission == Color{1, 2, 3});
}

TEST_CASE("angles that are no degrees are rounded with a warning") {
  const double in_degrees = 40 * (std::acos(-1.0) / 180);
  int warned = 0;
  for (int i = 0; i < 100; ++i) {
    Scene scene = scene_of(Sphere{});
    scene.camera.fov = i == 0 ? in_degrees : 0.9 + 0.01 * i;
    std::vector<std::string> warnings;
    const double fov = again(scene, &warnings).camera.fov;
    CHECK(std::abs(fov - scene.camera.fov) <= 1e-15);
    CHECK(warnings.empty() == (fov == scene.camera.fov));
    if (i == 0) CHECK(warnings.empty());
    warned += warnings.empty() ? 0 : 1;
  }
  CHECK(warned > 0);
}

TEST_CASE("what has more than two parts is combined in its order") {
  std::vector<Entity> parts;
  for (int i = 0; i < 12; ++i) {
    parts.push_back(Sphere{.center = {0.3 * i - 1.5, 0.1 * i, 3},
                           .radius = 0.5,
                           .material = Material{.color = Color{0.08 * i, 0.5, 1 - 0.08 * i}}});
  }
  const Entity slab = Box{.corner_a = {-2, -1, 3}, .corner_b = {2, 1, 4}};
  Scene scene = scene_of(csg_union(parts));
  scene.lights = {PointLight{.origin = {1, 4, -5}, .color = {1, 1, 1}}};
  check_same_picture(scene);
  scene.entities = {csg_difference(slab, parts)};
  check_same_picture(scene);
  scene.entities = {csg_intersection(std::vector<Entity>{slab, parts[5], parts[6]})};
  check_same_picture(scene);
}

TEST_CASE("an extrusion lies where it is") {
  const auto profile =
      make_profile(std::vector<Contour>{Contour{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}}});
  for (const auto& [from, to] : {std::pair{0.0, 2.0}, {0.0, -1.5}, {1.0, 3.0}, {-0.1, 0.7}}) {
    const Entity solid = Extrusion{.profile = profile, .from = from, .to = to};
    const BoundingBox box = bounding_box(again(scene_of(solid)).entities[0]);
    CHECK(box.lower.z == doctest::Approx(std::min(from, to)));
    CHECK(box.upper.z == doctest::Approx(std::max(from, to)));
    CHECK(source_code(solid, as_script).warnings.empty() == (from == 0));
  }
}

TEST_CASE("fields are written with whole constants, and however deep they are") {
  Field field = Field(2) / Field(3) - 2;
  for (int i = 0; i < 200; ++i) field = field + pow(Field::x() - 0.01 * i, 2) / 200;
  Scene scene = scene_of(Implicit{.field = field + pow(Field::y(), 2) + pow(Field::z() - 3, 2),
                                  .lower = {-2, -2, 1},
                                  .upper = {3, 2, 5}});
  check_same_picture(scene);
  Field doubled = Field::x();
  for (int i = 0; i < 100; ++i) doubled = doubled + doubled;
  CHECK_NOTHROW(again(scene_of(Implicit{.field = doubled - 1})));
}

TEST_CASE("heights go into a file if there are many, and read back as they were") {
  for (const double step : {0.125, 0.1}) {
    std::vector<double> heights;
    for (int i = 0; i < 100 * 80; ++i) heights.push_back(step * (i % 7));
    Scene scene = scene_of(HeightField{.heights = make_height_grid(heights, 100, 80),
                                       .corner_a = {-1, -1, 1},
                                       .corner_b = {1, 0, 3}});
    CHECK(source_code(scene, as_script).files.size() == (step == 0.125 ? 1 : 0));
    check_same_picture(scene);
  }
}

TEST_CASE("meshes are read back with their normals, (u, v) and materials") {
  const std::vector<Vec3> positions = {{0.1, 0, 1}, {1, 0, 1}, {0, 1.0 / 3, 1}, {1, 1, 2}};
  const std::vector<TriangleIndices> triangles = {{0, 1, 2}, {1, 3, 2}, {0, 3, 1}};
  MeshAttributes attributes;
  attributes.normals = {{0.1, 0.2, -1}, {0, 1, -1}};
  attributes.normal_indices = {{0, 1, 0}, {no_index, 1, 0}, {1, 1, 1}};
  attributes.uv = {{0.1, 0.7}, {1, 0}, {0.3, -2}};
  attributes.uv_indices = {{0, 1, 2}, {2, 1, 0}, {no_index, 0, 1}};
  auto image = std::make_shared<Image>(2, 2);
  image->set(1, 0, {0.25, 0.5, 1, 1});
  attributes.materials = {Material{.color = Color{1, 0.1, 0}, .specular = 0.3, .shininess = 12},
                          Material{.color = Pattern(ImageMap{.image = image, .repeat_u = 3}),
                                   .transparency = 0.2,
                                   .refractive_index = 1.1}};
  attributes.material_of_triangle = {1, no_index, 0};
  const Scene scene = scene_of(triangle_mesh(positions, triangles, attributes));
  const Scene read = again(scene);
  const MeshTriangles& wanted = triangles_of(scene);
  const MeshTriangles& made = triangles_of(read);
  REQUIRE(made.size() == 3);
  for (std::uint32_t i = 0; i < 3; ++i) {
    CHECK(made.triangle(i).a == wanted.triangle(i).a);
    CHECK(made.triangle(i).b == wanted.triangle(i).b);
    CHECK(made.triangle(i).c == wanted.triangle(i).c);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto same = [&](const auto& one, const auto& other) {
        const auto* const a = one.at(i, corner);
        const auto* const b = other.at(i, corner);
        return (a == nullptr) == (b == nullptr) && (a == nullptr || *a == *b);
      };
      CHECK(same(made.attributes()->normals(), wanted.attributes()->normals()));
      CHECK(same(made.attributes()->uv(), wanted.attributes()->uv()));
    }
  }
  check_same_picture(scene);
}

TEST_CASE("meshes keep their rule of what is inside, in scripts and in programs") {
  // A tetrahedron, and a smaller one in it.
  std::vector<Vec3> positions;
  std::vector<TriangleIndices> triangles;
  for (const double size : {1.0, 0.25}) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const Vec3& corner : {Vec3{1, 1, 1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1}, Vec3{-1, -1, 1}})
      positions.push_back(size * corner);
    for (const auto& [a, b, c] : {TriangleIndices{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}})
      triangles.push_back({first + a, first + b, first + c});
  }
  for (const FillRule rule : {FillRule::even_odd, FillRule::nonzero}) {
    const Entity entity = triangle_mesh(positions, triangles, {}, {.fill = rule});
    const Scene read = again(scene_of(entity));
    CHECK(mesh_report(triangles_of(read)).fill == rule);
    const bool is_nonzero = rule == FillRule::nonzero;
    const auto has = [&](SourceLanguage language, const char* text) {
      return source_code(entity, {.language = language}).text.find(text) != std::string::npos;
    };
    CHECK(has(SourceLanguage::cpp, "MeshOptions{.fill = FillRule::nonzero}") == is_nonzero);
    CHECK(has(SourceLanguage::c, ".fill = CRT_FILL_NONZERO;") == is_nonzero);
    CHECK(has(SourceLanguage::python, "fill=\"nonzero\"") == is_nonzero);
    // The default of files is nonzero here.
    CHECK(has(SourceLanguage::script, "fill -> \"evenodd\"") == !is_nonzero);
  }
}

TEST_CASE("materials that no MTL file can say are refused for facets, and not for a whole mesh") {
  const std::vector<Vec3> positions = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  const std::vector<TriangleIndices> triangles = {{0, 1, 2}};
  for (const SharedMaterial& material : std::initializer_list<SharedMaterial>{
           PrincipledMaterial{}, Material{.emission = {1, 1, 1}}, Material{.reflectivity = 0.1},
           Material{.diffuse = 1}, Material{.absorption = {1, 0, 0}},
           Material{.bump = Pattern(Noise{})}, Material{.color = Color{1, 1, 1, 0.5}},
           Material{.color = Pattern(Noise{})}, Material{.specular = 1, .shininess = 0}}) {
    const Entity own = triangle_mesh(positions, triangles, {.materials = {material}});
    CHECK_THROWS_WITH_AS(source_code(own, as_script),
                         doctest::Contains("a mesh has materials of its own with"), Error);
    CHECK_NOTHROW(again(scene_of(triangle_mesh(positions, triangles).with_material(material))));
  }
}

TEST_CASE("a file has its content in its name, so that an older script keeps its files") {
  const TemporaryDirectory folder;
  const auto mesh = [](double x) {
    return scene_of(triangle_mesh(std::vector<Vec3>{{x, 0, 1}, {1, 0, 1}, {0, 1, 1}},
                                  std::vector<TriangleIndices>{{0, 1, 2}}));
  };
  save_script(mesh(0), folder / "one.crt");
  std::filesystem::copy(folder / "one.crt", folder / "kept.crt");
  save_script(mesh(0.5), folder / "one.crt");
  for (const auto& [name, x] : {std::pair{"kept.crt", 0.0}, {"one.crt", 0.5}}) {
    const ScriptResult result = run_script_file(folder / name);
    REQUIRE(result.scene);
    CHECK(triangles_of(*result.scene).triangle(0).a.x == x);
  }
}

TEST_CASE("settings are read as they were written, whatever the defaults of the script are") {
  for (const int compat : {0, compat_2015}) {
    for (const Settings& one : {Settings{}, settings_of_2015()}) {
      Scene scene;
      scene.settings = one;
      scene.settings.compat = compat;
      const Settings read = again(scene).settings;
      CHECK(read.gamma == one.gamma);
      CHECK(read.falloff_model == one.falloff_model);
      CHECK(read.ambient_model == one.ambient_model);
      CHECK(read.compat == compat);
      // Only what is not the default is written.
      const std::string text = source_code(scene, as_script).text;
      const bool is_default = (compat == compat_2015) == (one.compat == compat_2015);
      CHECK((text.find("gamma") == std::string::npos) == is_default);
      CHECK((text.find("falloffmodel") == std::string::npos) == is_default);
      CHECK((text.find("ambientmodel") == std::string::npos) == is_default);
    }
  }
}

TEST_CASE(
    "a lens is read as it was written, in units or in thousandths, in scripts of both kinds") {
  for (const int compat : {0, compat_2015}) {
    for (const Camera& camera : {Camera{.lens_radius = 0.3}, Camera{.aperture = 12}, Camera{}}) {
      Scene scene;
      scene.settings.compat = compat;
      scene.camera = camera;
      CHECK(again(scene).camera.aperture == camera.aperture);
      CHECK(again(scene).camera.lens_radius == camera.lens_radius);
    }
  }
}

TEST_CASE("what scripts of 2015 lack is refused in a scene of theirs") {
  Scene scene = scene_of(Entity(Sphere{}).transformed(translate({1, 2, 3})));
  scene.settings.compat = 2015;
  CHECK(again(scene).settings.compat == 2015);
  CHECK(again(scene).camera.aperture == scene.camera.aperture);
  scene.entities = {Entity(Sphere{}).with_id(7)};
  CHECK_THROWS_WITH_AS(source_code(scene, as_script), doctest::Contains("<id ...>"), Error);
}

TEST_CASE("entities with ids, materials and without a point keep their places") {
  Scene scene;
  scene.entities = {empty_entity(), Entity(Sphere{}).with_id(9).with_material(Material{}),
                    Entity(Box{}).transformed(rotate_degrees({10, 20, 30}))};
  const Scene read = again(scene);
  REQUIRE(read.entities.size() == 3);
  CHECK(read.entities[0].is_empty());
  const auto& wrapper = std::get<EntityWrapper>(read.entities[1].node().content);
  CHECK(wrapper.id == 9);
  CHECK(wrapper.material.has_value());
}

TEST_CASE("what light passes, and what the camera does not see, stays so") {
  Scene scene;
  const Entity cut = Sphere{} - Box{.corner_a = {0, 0, 0}};
  scene.entities = {cut, cut.with_shadow(false), Entity(Box{}).with_visible(false),
                    cut.with_visible(false).with_shadow(false).with_id(4)};
  const Scene read = again(scene);
  REQUIRE(read.entities.size() == scene.entities.size());
  const auto is = [&](std::size_t i, bool casts_shadow, bool visible) {
    const auto* wrapper = std::get_if<EntityWrapper>(&read.entities[i].node().content);
    return (wrapper == nullptr || wrapper->casts_shadow) == casts_shadow &&
           (wrapper == nullptr || wrapper->visible) == visible;
  };
  CHECK(is(0, true, true));
  CHECK(is(1, false, true));
  CHECK(is(2, true, false));
  CHECK(is(3, false, false));
}

TEST_CASE("text that is not UTF-8, and seeds that no Integer has, are refused") {
  Scene scene;
  scene.settings.title = "caf\xe9";
  CHECK_THROWS_WITH_AS(source_code(scene, as_script), doctest::Contains("not UTF-8"), Error);
  scene.settings.title = "";
  scene.settings.seed = std::numeric_limits<std::uint64_t>::max();
  CHECK_THROWS_WITH_AS(source_code(scene, as_script), doctest::Contains("a seed of 2^63"), Error);
}
