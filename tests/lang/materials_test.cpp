// These tests check principled materials of scripts, and materials derived from others.
#include <doctest/doctest.h>

#include <string>

#include "crt/render.hpp"
#include "run.hpp"

namespace {

/// Returns the pixels of a small picture of a ball of a material.
std::vector<float> pixels_of(const std::string& material) {
  const crt::test::Run run = crt::test::run(R"(
    Settings {
      width -> 12 height -> 9
      camera -> Camera { position -> vec3(0, 1, -4) pointing -> vec3(0, 0, 0) }
      lights -> [PointLight { origin -> vec3(3, 5, -4) color -> rgb(1, 1, 1) }]
    }
    brass = PrincipledMaterial { color -> rgb(0.9, 0.8, 0.4) metallic -> 1 roughness -> 0.2 }
    plain = Material { color -> rgb(0.9, 0.1, 0.1) reflectivity -> 0.25 }
    print(brass == plain)
    Scene { Sphere { center -> vec3(0, 0, 0) radius -> 1 material -> )" +
                                            material + " } }");
  for (const crt::Diagnostic& diagnostic : run.result.diagnostics)
    MESSAGE(crt::format_diagnostic(diagnostic));
  REQUIRE(run.ok());
  const crt::Image image = crt::render(crt::prepare(*run.result.scene));
  return {image.pixels().begin(), image.pixels().end()};
}

std::string error_of(const std::string& text) {
  const crt::test::Run run = crt::test::run_statements(text);
  REQUIRE(run.errors().size() == 1);
  return run.errors()[0].message;
}

}  // namespace

TEST_CASE("a derived material has the given attributes, and all others of what it is from") {
  const auto given = pixels_of(
      "PrincipledMaterial { color -> rgb(0.9, 0.8, 0.4) metallic -> 1 roughness -> 0.5 }");
  CHECK(pixels_of("brass { roughness -> 0.5 }") == given);
  CHECK(pixels_of("brass") != given);
  CHECK(pixels_of("plain { reflectivity -> 0.5 }") ==
        pixels_of("Material { color -> rgb(0.9, 0.1, 0.1) reflectivity -> 0.5 }"));
}

TEST_CASE("deriving leaves the variable as it was, and may be done again") {
  CHECK(crt::test::run_statements("a = PrincipledMaterial { roughness -> 0.1 }\n"
                                  "b = a { metallic -> 1 }\n"
                                  "c = b { metallic -> 0 }\n"
                                  "print(a == a) print(a == b) print(b == c)")
            .printed == std::vector<std::string>{"true", "false", "false"});
}

TEST_CASE("numbers of a principled material may be patterns") {
  CHECK(crt::test::run_statements("m = PrincipledMaterial { metallic -> Checker { }\n"
                                  "  roughness -> Noise { } emission -> Stripes { } }\n"
                                  "print(m)")
            .printed == std::vector<std::string>{"<Material>"});
  CHECK(error_of("m = PrincipledMaterial { roughness -> \"rough\" } print(m)") ==
        "'roughness' must be a Float or Pattern, not a String");
  CHECK(error_of("m = PrincipledMaterial { roughness -> 2 } print(m)") ==
        "'roughness' must be between 0 and 1 (it is 2)");
  CHECK(error_of("m = PrincipledMaterial { coat -> Noise { } } print(m)") ==
        "'coat' must be a Float, not a Pattern");
}

TEST_CASE("what cannot be derived is an error that says why") {
  CHECK(error_of("a = 7 b = a { roughness -> 1 } print(b)") ==
        "a Material with other attributes needs a Material to begin with, not an Integer");
  CHECK(error_of("a = PrincipledMaterial { } b = a { roughnes -> 1 } print(b)") ==
        "PrincipledMaterial has no attribute 'roughnes'; did you mean 'roughness'?");
  CHECK(error_of("a = Material { } b = a { diffuse -> 1 diffuse -> 1 } print(b)") ==
        "the attribute 'diffuse' is given twice");
  CHECK(error_of("a = Material { } b = a { diffuse -> -1 } print(b)") ==
        "'diffuse' must be at least 0 (it is -1)");
}

TEST_CASE("a derived material counts as a use of its variable, and may be unused itself") {
  const crt::test::Run run = crt::test::run_statements(
      "steel = PrincipledMaterial { metallic -> 1 }\n"
      "satin = steel { roughness -> 0.4 }\n");
  CHECK(run.messages() == std::vector<std::string>{"the material 'satin' is never used"});
}

TEST_CASE("a brace behind a name derives a material only where an attribute follows") {
  CHECK(error_of("a = 3 { }").find("unexpected '{'") == 0);
  CHECK(error_of("a = Material { } b = a { 3 }").find("unexpected '{'") == 0);
  CHECK(error_of("a = Material { } b = 7 { diffuse -> 1 } print(b)").find("unexpected '{'") == 0);
}
