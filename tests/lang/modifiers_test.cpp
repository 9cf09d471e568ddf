// These tests check what the modifiers of an entity do to the scene.
#include <doctest/doctest.h>

#include <set>
#include <string>

#include "crt/query.hpp"
#include "crt/render.hpp"
#include "run.hpp"

namespace {

crt::Scene scene_of(const std::string& text) {
  crt::test::Run result = crt::test::run(text);
  for (const crt::Diagnostic& diagnostic : result.result.diagnostics)
    MESSAGE(crt::format_diagnostic(diagnostic));
  REQUIRE(result.ok());
  return std::move(*result.result.scene);
}

/// Returns the pixels of a small picture of what stands at the origin.
std::vector<float> pixels_of(const std::string& entities) {
  const crt::Scene scene = scene_of(R"(
    Settings {
      width -> 16 height -> 12
      camera -> Camera { position -> vec3(0, 1, -4) pointing -> vec3(0, 0, 0) }
      lights -> [PointLight { origin -> vec3(3, 5, -4) color -> rgb(1, 1, 1) ambient -> 0.2 }]
    }
    red = Material { color -> rgb(0.9, 0.1, 0.1) }
    blue = Material { color -> rgb(0.1, 0.1, 0.9) specular -> 0.5 }
    print(red == blue)
    Scene { )" + entities + " }");
  const crt::Image image = crt::render(crt::prepare(scene));
  const std::span<const float> pixels = image.pixels();
  return {pixels.begin(), pixels.end()};
}

std::optional<std::uint32_t> id_seen_from_the_camera(const crt::Scene& scene) {
  const auto hit = crt::intersect(crt::prepare(scene), {.origin = {0, 0, -9}});
  return hit ? std::optional(hit->entity_id) : std::nullopt;
}

}  // namespace

TEST_CASE("a material as a modifier is that of the attribute") {
  const auto given = pixels_of("Sphere { center -> vec3(0,0,0) radius -> 1 material -> red }");
  CHECK(pixels_of("Sphere { center -> vec3(0,0,0) radius -> 1 } <material red>") == given);
  CHECK(pixels_of("Sphere { center -> vec3(0,0,0) radius -> 1 } <material blue>") != given);
}

TEST_CASE("a material as a modifier is for the parts that have none") {
  const std::string half = "Sphere { center -> vec3(0,0,0) radius -> 1 ";
  const std::string box = "Box { cornerA -> vec3(0,0,-2) cornerB -> vec3(2,2,2) material -> blue }";
  const auto given = pixels_of(half + "material -> red } - " + box);
  CHECK(pixels_of("(" + half + "} - " + box + ") <material red>") == given);
  CHECK(pixels_of(half + "material -> red } <material blue> - " + box) == given);
}

TEST_CASE("light and the camera pass an entity, by modifiers and by attributes") {
  const std::string floor = "Box { cornerA -> vec3(-5,-2,-5) cornerB -> vec3(5,-1,5) } ";
  const std::string ball = "Sphere { center -> vec3(0,0,0) radius -> 1 ";
  const auto usual = pixels_of(floor + ball + "}");
  const auto unseen = pixels_of(floor + ball + "} <visible false>");
  const auto shadowless = pixels_of(floor + ball + "shadow -> false }");
  CHECK(unseen != usual);
  CHECK(shadowless != usual);
  CHECK(pixels_of(floor + ball + "visible -> false }") == unseen);
  CHECK(pixels_of(floor + ball + "} <shadow false>") == shadowless);
  CHECK(pixels_of(floor + ball + "} <visible false, shadow false>") == pixels_of(floor));
  CHECK(pixels_of(floor + ball + "visible -> false shadow -> false }") == pixels_of(floor));
  CHECK(pixels_of(floor + ball + "visible -> false shadow -> true } <visible (1 < 2)>") == usual);
  // A whole combination may be passed, and groups may.
  const std::string cut =
      "\n(" + ball + "} - Box { cornerA -> vec3(0,0,-2) cornerB -> vec3(2,2,2) })";
  CHECK(pixels_of(floor + cut + " <visible false, shadow false>") == pixels_of(floor));
  CHECK(pixels_of("two = Macro () { " + ball + "} " + cut + " } " + floor +
                  "two() <visible false, shadow false>") == pixels_of(floor));
  // As the other words they are names where they begin no modifier.
  CHECK(pixels_of("visible = 1 shadow = visible < 2 " + floor + ball + "} <shadow shadow>") ==
        usual);
}

TEST_CASE("what light or the camera pass is a whole entity") {
  const auto message = [](const std::string& entities) {
    const crt::test::Run run = crt::test::run("Scene { " + entities + " }");
    return run.result.diagnostics.empty() ? std::string() : run.result.diagnostics.front().message;
  };
  const std::string ball = "Sphere { center -> vec3(0,0,0) radius -> 1 ";
  CHECK(message(ball + "} - " + ball + "visible -> false }").find("'visible'") !=
        std::string::npos);
  CHECK(message(ball + "shadow -> false } + " + ball + "}").find("give it to the combination") !=
        std::string::npos);
  CHECK(message("two = Macro () { " + ball + "} " + ball + "visible -> false } } two() <scale 2>")
            .find("give it to the combination") != std::string::npos);
  CHECK(message(ball + "} <shadow 1>") == "'shadow' takes a Boolean, not an Integer");
  CHECK(message(ball + "visible -> 1 }").find("must be a Boolean") != std::string::npos);
}

TEST_CASE("an id is what hits report, and the outermost holds") {
  const std::string ball = "Scene { Sphere { center -> vec3(0,0,0) radius -> 1 } ";
  CHECK(id_seen_from_the_camera(scene_of(ball + "}")) == 0);
  CHECK(id_seen_from_the_camera(scene_of(ball + "<id 7> }")) == 7);
  CHECK(id_seen_from_the_camera(scene_of(ball + "<id 7> <id 4294967295> }")) == 4294967295);
  CHECK(id_seen_from_the_camera(scene_of(ball + "<id 7, scale 2, id 8> }")) == 8);
}

TEST_CASE("a matrix moves as its rows say") {
  const std::string ball = "Scene { Sphere { center -> vec3(0, 0, 0) radius -> 1 } ";
  // x and y change places, all is twice as large along z, and moved along z by 5.
  const std::string numbers = "<matrix [0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 2, 5]>";
  const std::string rows = "<matrix [[0, 1, 0, 0], [1, 0, 0, 0], [0, 0, 2, 5]]>";
  for (const std::string& matrix : {numbers, rows}) {
    const crt::PreparedScene prepared = crt::prepare(scene_of(ball + matrix + " }"));
    const auto hit = crt::intersect(prepared, {.origin = {0, 0, -5}});
    REQUIRE(hit);
    CHECK(hit->t == doctest::Approx(8));
  }
  const std::string moved = "<translate vec3(0.5, 0, 0)> ";
  const crt::PreparedScene prepared = crt::prepare(scene_of(ball + moved + rows + " }"));
  CHECK(crt::intersect(prepared, {.origin = {0, 1.4, -5}}));
  CHECK_FALSE(crt::intersect(prepared, {.origin = {1.4, 0, -5}}));
}

TEST_CASE("rotating about an axis and a point, and mirroring, are the maps that they name") {
  const std::string box = "Box { cornerA -> vec3(0.1,0,0.2) cornerB -> vec3(0.5,0.8,0.3) } ";
  const auto same = [&box](const std::string& modifiers, const std::string& others) {
    CAPTURE(modifiers);
    CHECK(pixels_of(box + "<" + modifiers + ">") == pixels_of(box + "<" + others + ">"));
    CHECK(pixels_of(box + "<" + modifiers + ">") != pixels_of(box));
  };
  same("rotate 90 axis vec3(0, 5, 0)", "rotate vec3(0, 90, 0)");
  same("rotate 180 axis vec3(-0.1, 0, 0)", "rotate vec3(180, 0, 0)");
  same("mirror vec3(0, 3, 0)", "scale vec3(1, -1, 1)");
  same("rotate 90 axis vec3(0, 0, 1) about vec3(0.5, 0.5, 0)",
       "translate vec3(-0.5, -0.5, 0), rotate vec3(0, 0, 90), translate vec3(0.5, 0.5, 0)");
  same("scale 0.5 about vec3(0.25, 0, 0)", "scale 0.5, translate vec3(0.125, 0, 0)");
  same("matrix [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0] about vec3(0.5, 0, 0)",
       "mirror vec3(1, 0, 0) about vec3(0.5, 0, 0)");
}

TEST_CASE("words of modifiers stay names elsewhere") {
  CHECK(crt::test::run("mirror = 1 axis = 2 about = 3 print(axis < mirror, mirror < about) "
                       "Scene { Sphere { center -> vec3(0,0,0) radius -> 1 }"
                       "<rotate about * axis axis vec3(0, axis, 0) about vec3(0, about, 0)> }")
            .ok());
}
