#include <doctest/doctest.h>

#include <cmath>
#include <crt/crt.hpp>
#include <crt/source_code.hpp>
#include <string>
#include <vector>

#include "core/geometry/mesh/facet_attributes.hpp"
#include "core/geometry/mesh/triangles.hpp"

using namespace crt;

namespace {

constexpr SourceLanguage languages[] = {SourceLanguage::cpp, SourceLanguage::python,
                                        SourceLanguage::c, SourceLanguage::script};

int count(const std::string& text, const std::string& piece) {
  int found = 0;
  for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1))
    ++found;
  return found;
}

std::string code(const Entity& entity, SourceLanguage language = SourceLanguage::cpp) {
  return source_code(entity, {.language = language}).text;
}

ErrorCode refusal(const Scene& scene, const SourceOptions& options = {}) {
  try {
    source_code(scene, options);
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::internal;
}

/// A Ball is a solid that only this program knows.
class Ball : public CustomShape {
 public:
  BoundingBox bounds() const override { return {{-1, -1, -1}, {1, 1, 1}}; }
  void crossings(const Ray&, std::vector<CustomCrossing>&) const override {}
  CustomPoint point(const Vec3&, std::uint32_t) const override { return {}; }
  std::string name() const override { return "a ball of its own"; }
};

}  // namespace

TEST_CASE("a primitive is written as it would be by hand") {
  const Entity ball = Sphere{.center = {0, 0.5, 0}, .radius = 0.25};
  CHECK(count(code(ball), "  return Sphere{.center = {0, 0.5, 0}, .radius = 0.25};\n") == 1);
  CHECK(count(code(ball, SourceLanguage::python),
              "    return crt.Sphere(center=(0, 0.5, 0), radius=0.25)\n") == 1);
  CHECK(count(code(ball, SourceLanguage::c),
              "check(crt_sphere_create((const double[]){0, 0.5, 0}, 0.25, &entity_1));") == 1);
  CHECK(code(ball, SourceLanguage::script) ==
        "make_entity = Macro () {\n"
        "    return Sphere { center -> vec3(0, 0.5, 0) radius -> 0.25 }\n"
        "}\n");
}

TEST_CASE("what occurs twice is written once") {
  const SharedMaterial red = Material{.color = Color{1, 0, 0}};
  const SharedMaterial equal = Material{.color = Color{1, 0, 0}};
  const Entity ball = Sphere{.radius = 0.25, .material = red};
  const Entity part = ball - Box{.corner_a = {0, 0, 0}, .material = equal};
  const Entity both = part + part.transformed(translate({2, 0, 0}));
  for (const SourceLanguage language : languages) {
    const std::string text = code(both, language);
    CAPTURE(text);
    CHECK(count(text, language == SourceLanguage::c ? "crt_sphere_create" : "Sphere") == 1);
    CHECK(count(text, language == SourceLanguage::c ? "crt_material_init" : "Material(") +
              count(text, "= Material{") + count(text, "= Material {") ==
          1);
  }
}

TEST_CASE("principled materials are written in all languages, patterns in the place of numbers") {
  const SharedMaterial brushed = PrincipledMaterial{
      .metallic = 1, .roughness = Pattern(Noise{.scale = 0.25}), .coat_roughness = 0.5};
  const Entity ball = Sphere{.material = brushed};
  CHECK(count(code(ball), "PrincipledMaterial{.metallic = 1,") == 1);
  CHECK(count(code(ball), ".roughness = Pattern{Noise{.scale = 0.25}}") == 1);
  const std::string python = code(ball, SourceLanguage::python);
  CHECK(count(python, "crt.PrincipledMaterial(metallic=1,") == 1);
  CHECK(count(python, "roughness_map=crt.Pattern.noise(scale=0.25)") == 1);
  CHECK(count(python, "coat_roughness=0.5)") == 1);
  const std::string c = code(ball, SourceLanguage::c);
  CHECK(count(c, "crt_principled_init") == 1);
  CHECK(count(c, ".roughness_map = &pattern_1") + count(c, ".roughness_map = &") >= 1);
  CHECK(count(c, "crt_entity_with_principled(") == 1);
  const std::string script = code(ball, SourceLanguage::script);
  CHECK(count(script, "PrincipledMaterial { metallic -> 1 roughness -> Noise { ") == 1);
}

TEST_CASE("facets of a mesh have materials of either kind in all programs") {
  const SharedMaterial plain = Material{.reflectivity = 0.25};
  const SharedMaterial brass = PrincipledMaterial{.metallic = 1};
  const auto mesh_of = [](const std::vector<SharedMaterial>& materials) {
    return triangle_mesh(std::vector<Vec3>{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
                         std::vector<TriangleIndices>{{0, 1, 2}}, {.materials = materials});
  };
  const Entity both = mesh_of({plain, brass});
  CHECK(count(code(both), "PrincipledMaterial{") == 1);
  const std::string python = code(both, SourceLanguage::python);
  CHECK(count(python, "material_1 = crt.Material(reflectivity=0.25") == 1);
  CHECK(count(python, "material_2 = crt.PrincipledMaterial(metallic=1") == 1);
  CHECK(count(python, "materials=[material_1,") == 1);
  const std::string c = code(both, SourceLanguage::c);
  CHECK(count(c, "const crt_material* materials_1[] = {&material_1, NULL};") == 1);
  CHECK(count(c, "const crt_principled* principled_2[] = {NULL, &principled_1};") == 1);
  CHECK(count(c, ".material_count = 2;") == 1);
  CHECK(count(code(mesh_of({brass}), SourceLanguage::c), "const crt_material*") == 0);
  CHECK(count(code(mesh_of({plain}), SourceLanguage::c), "crt_principled") == 0);
}

TEST_CASE("principled materials are described by their own numbers") {
  Scene scene;
  scene.entities = {Sphere{
      .material = PrincipledMaterial{.metallic = 1, .roughness = Pattern(Noise{}), .coat = 0.5}}};
  const auto list = describe_entities(scene, 10);
  REQUIRE(list.size() == 1);
  const auto value_of = [&](const std::string& name) -> std::string {
    for (const auto& [known, value] : list[0].values)
      if (known == name) return value;
    return "none";
  };
  CHECK(value_of("metallic") == "1");
  CHECK(value_of("roughness") == "a pattern");
  CHECK(value_of("coat") == "0.5");
  CHECK(value_of("reflectivity") == "none");
}

TEST_CASE("everything that C makes is released, but for what is returned") {
  const Entity solid = (Sphere{} - Box{.corner_a = {0, 0, 0}}).transformed(scale(2));
  const std::string text = code(solid, SourceLanguage::c);
  CHECK(count(text, "crt_entity* entity_") == 4);
  CHECK(count(text, "crt_entity_release(entity_") == 3);
  CHECK(count(text, "return entity_4;") == 1);
  CHECK(count(text, "crt_entity_release(entity_4)") == 0);
}

TEST_CASE("the empty entity and entities under numbers are written") {
  for (const SourceLanguage language : languages) {
    const bool is_script = language == SourceLanguage::script;
    CHECK(count(code(empty_entity(), language), is_script ? "radius -> 0 }" : "mpty") >= 1);
    CHECK(code(Entity(Sphere{}).with_id(77), language).find("77") != std::string::npos);
  }
}

TEST_CASE("entities that light passes or the camera does not see are written as such") {
  const Entity hidden = Entity(Sphere{}).with_shadow(false).with_visible(false);
  const auto holds = [&](SourceLanguage language, const char* part) {
    return code(hidden, language).find(part) != std::string::npos;
  };
  CHECK(holds(SourceLanguage::cpp, ".with_shadow(false).with_visible(false)"));
  CHECK(holds(SourceLanguage::python, ".with_shadow(False).with_visible(False)"));
  CHECK(holds(SourceLanguage::c, "crt_entity_with_shadow("));
  CHECK(holds(SourceLanguage::c, "crt_entity_with_visible("));
  CHECK(holds(SourceLanguage::script, "<shadow false> <visible false>"));
}

TEST_CASE("trees of any depth are written without recursion") {
  constexpr int depth = 20000;
  Entity deep = Sphere{};
  for (int i = 1; i <= depth; ++i) {
    const Entity next = Sphere{.center = {0.5 * i, 0, 0}};
    deep = i % 2 == 0 ? deep + next : deep - next;
  }
  for (const SourceLanguage language : languages) {
    const std::string text = code(deep, language);
    CHECK(count(text, language == SourceLanguage::c ? "sphere_create(" : "Sphere") == depth + 1);
  }
  Scene scene;
  scene.entities = {deep};
  CHECK(describe_entities(scene, 1000000).size() == 2 * depth + 1);
}

TEST_CASE("what no code can be written of is an error that says so") {
  Scene scene;
  scene.entities = {Custom{.shape = std::make_shared<const Ball>()}};
  CHECK_THROWS_WITH_AS(
      source_code(scene),
      "a ball of its own is computed by a program, which cannot be written as source code", Error);
  CHECK(refusal(scene) == ErrorCode::unsupported);

  auto deep_colors = std::make_shared<Image>(1, 1);
  deep_colors->set(0, 0, {1.0 / 1000, 0, 0, 1});
  deep_colors->set_display_encoded(true);
  scene.entities = {Sphere{.material = Material{.color = Pattern(ImageMap{.image = deep_colors})}}};
  CHECK(refusal(scene) == ErrorCode::unsupported);
}

TEST_CASE("too much text is refused as soon as it is too much") {
  Scene scene;
  for (int i = 0; i < 1000; ++i) scene.entities.emplace_back(Sphere{.center = {0.1 * i, 0, 0}});
  for (const SourceLanguage language : languages) {
    CHECK(refusal(scene, {.language = language, .most_bytes = 10000}) == ErrorCode::limit);
    CHECK(refusal(scene, {.language = language, .most_bytes = 1000000}) == ErrorCode::internal);
  }
}

TEST_CASE("lists that would be too long are refused before they are written") {
  Scene scene;
  scene.entities = {
      HeightField{.heights = make_height_grid(std::vector<double>(4000000, 0.1), 2000, 2000)}};
  for (const SourceLanguage language : languages) {
    CHECK(refusal(scene, {.language = language, .most_bytes = 1000000}) == ErrorCode::limit);
  }
}

TEST_CASE("a field that would be longer than it is as a graph is refused") {
  Field field = Field::x();
  for (int i = 0; i < 100; ++i) field = field + field;
  Scene scene;
  scene.entities = {Implicit{.field = field - 1}};
  CHECK(refusal(scene) == ErrorCode::limit);
}

TEST_CASE("a mesh that needs its triangles without area is refused") {
  // A tetrahedron with a corner on an edge, which a flat triangle closes.
  const std::vector<Vec3> positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 0, 0}};
  const std::vector<TriangleIndices> triangles = {{0, 2, 1}, {0, 4, 3}, {4, 1, 3},
                                                  {0, 3, 2}, {1, 2, 3}, {0, 1, 4}};
  const Entity closed = triangle_mesh(positions, triangles);
  REQUIRE(closed.is_solid());
  CHECK_THROWS_AS(source_code(closed), Error);
  const Entity plain = triangle_mesh(
      positions, std::vector<TriangleIndices>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
  CHECK_NOTHROW(source_code(plain));
}

TEST_CASE("transforms that doubles cannot say are rounded with a warning") {
  const Entity turned = Entity(Sphere{}).transformed(rotate_degrees({10, 20, 30}));
  CHECK(source_code(turned).warnings.empty());
  const Entity twice = turned.transformed(scale(0.3));
  REQUIRE(source_code(twice).warnings.size() == 1);
  CHECK(source_code(twice).warnings[0].find("rounded") != std::string::npos);
}

TEST_CASE("entities are described with their parts behind them") {
  Scene scene;
  scene.entities = {
      Sphere{.radius = 2, .material = Material{.color = Color{1, 0, 0}}},
      (Box{} - Sphere{}).transformed(translate({1, 0, 0})),
  };
  const std::vector<EntityDescription> list = describe_entities(scene);
  REQUIRE(list.size() == 5);
  CHECK(list[0].kind == "Sphere");
  CHECK(list[0].values == std::vector<std::pair<std::string, std::string>>{
                              {"center", "(0, 0, 0)"}, {"radius", "2"}, {"color", "(1, 0, 0)"}});
  CHECK(list[1].kind == "Placed");
  CHECK(list[1].parent == EntityDescription::no_parent);
  CHECK(list[2].kind == "Difference");
  CHECK(list[2].parent == 1);
  CHECK(list[3].kind == "Box");
  CHECK(list[3].parent == 2);
  CHECK(list[4].parent == 2);
  CHECK(describe_entities(scene, 2).size() == 2);
}
