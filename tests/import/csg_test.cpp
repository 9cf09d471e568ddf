// OpenSCAD's trees become scripts of the same solids.
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <sstream>

#include "import/imported.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr double pi = std::numbers::pi;
const importing::ImportOptions with_facets{.facets = true};

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  REQUIRE(file.is_open());
  return {std::istreambuf_iterator<char>(file), {}};
}

bool is_near(double a, double b, double relative) {
  return std::abs(a - b) <= relative * std::abs(b);
}

}  // namespace

TEST_CASE("with facets a part has the volume and the bounds that OpenSCAD's mesh of it has") {
  // tests/bench/openscad/compare.py has written the numbers.
  const std::string folder = std::string(CRT_SOURCE_DIR) + "/tests/import/";
  std::istringstream lines(read_file(folder + "known.txt"));
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    std::istringstream words(line);
    std::string name;
    double volume = 0;
    Vec3 lower, upper;
    words >> name >> volume >> lower.x >> lower.y >> lower.z >> upper.x >> upper.y >> upper.z;
    REQUIRE(words);
    CAPTURE(name);
    const Imported part = csg(read_file(folder + "parts/" + name + ".csg"), with_facets);
    const Entity& entity = part.scene.entities.at(0);
    const Interval found = crt::volume(entity, {.relative_width = 1e-3});
    // OpenSCAD writes six digits of each corner, and of each number of a matrix.
    const double room = 6e-6 * volume;
    CHECK(found.lower - room <= volume);
    CHECK(found.upper + room >= volume);
    const BoundingBox box = tight_bounding_box(entity);
    const double size = std::max({upper.x - lower.x, upper.y - lower.y, upper.z - lower.z});
    // y and z are exchanged.
    for (int axis = 0; axis < 3; ++axis) {
      const int other = axis == 0 ? 0 : 3 - axis;
      CHECK(std::abs(box.lower[other] - lower[axis]) <= 3e-6 * size);
      CHECK(std::abs(box.upper[other] - upper[axis]) <= 3e-6 * size);
    }
  }
  CHECK(count == 18);
}

TEST_CASE("without facets spheres, cylinders and circles are round") {
  CHECK(is_near(csg("sphere($fn = 0, $fa = 12, $fs = 2, r = 2);").volume(), 32 * pi / 3, 1e-4));
  CHECK(csg("sphere($fn = 0, $fa = 12, $fs = 2, r = 2);").says("Sphere { center"));
  const Imported cone = csg("cylinder($fn = 0, h = 3, r1 = 0, r2 = 2, center = true);");
  CHECK(is_near(cone.volume(), 4 * pi, 1e-4));
  CHECK(cone.says("Cone { from -> vec3(0, 0, 1.5) to -> vec3(0, 0, -1.5) radius -> 2 }"));
  const Imported ring =
      csg("rotate_extrude(angle = 360, $fn = 0) { multmatrix([[1, 0, 0, 5], [0, 1, 0, 0], "
          "[0, 0, 1, 0], [0, 0, 0, 1]]) { circle($fn = 0, r = 2); } }");
  CHECK(is_near(ring.volume(), 2 * pi * 5 * 4 * pi, 1e-4));
  const Imported plate =
      csg("linear_extrude(height = 2, scale = [1, 1]) { difference() { square(size = [8, 8], "
          "center = true); circle($fn = 0, r = 3); } }");
  CHECK(is_near(plate.volume(), 2 * (64 - 9 * pi), 1e-4));
  CHECK(plate.says("Box"));
  CHECK(plate.says("- Cylinder"));
}

TEST_CASE("a $fn of up to 8 means that many sides") {
  const Imported nut = csg("cylinder($fn = 6, $fa = 12, $fs = 2, h = 1, r1 = 2, r2 = 2);");
  CHECK(is_near(nut.volume(), 1.5 * std::sqrt(3.0) * 4, 1e-4));
  CHECK(nut.says("Extrusion"));
  CHECK(csg("cylinder($fn = 9, $fa = 12, $fs = 2, h = 1, r1 = 2, r2 = 2);").says("Cylinder"));
}

TEST_CASE("z of OpenSCAD is y, and y is z") {
  const Imported part = csg("cube(size = [1, 2, 3], center = false);");
  const BoundingBox box = tight_bounding_box(part.scene.entities.at(0));
  CHECK(std::abs(box.upper.x - 1) < 1e-6);
  CHECK(std::abs(box.upper.y - 3) < 1e-6);
  CHECK(std::abs(box.upper.z - 2) < 1e-6);
}

TEST_CASE("matrices are written as turns, moves and factors where they are such") {
  CHECK(csg("multmatrix([[0.866025, -0.5, 0, 1], [0.5, 0.866025, 0, 2], [0, 0, 1, 3], "
            "[0, 0, 0, 1]]) { cube(size = [1, 1, 1], center = false); }")
            .says("<rotate vec3(0, 0, 30), translate vec3(1, 2, 3)"));
  CHECK(csg("multmatrix([[2, 0, 0, 0], [0, 3, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) { "
            "sphere($fn = 0, r = 1); }")
            .says("<scale vec3(2, 3, 1)"));
  const Imported mirrored =
      csg("multmatrix([[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) { cube(size = "
          "[1, 2, 3], center = false); }");
  CHECK(std::abs(tight_bounding_box(mirrored.scene.entities.at(0)).lower.x + 1) < 1e-5);
  CHECK(csg("multmatrix([[1, 0.5, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) { cube(size = "
            "[1, 1, 1], center = false); }")
            .says("<matrix [[1, 0.5, 0, 0], "));
}

TEST_CASE("hulls and sums of round solids are exact where a script has a word for them") {
  const std::string moved = "multmatrix([[1, 0, 0, 4], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) ";
  const Imported capsule =
      csg("hull() { sphere($fn = 0, r = 1); " + moved + "{ sphere($fn = 0, r = 1); } }");
  CHECK(capsule.says("Capsule"));
  CHECK(is_near(capsule.volume(), 4 * pi + 4 * pi / 3, 1e-4));
  CHECK(csg("hull() { sphere($fn = 0, r = 1); " + moved + "{ sphere($fn = 0, r = 2); } }")
            .says("Tube"));
  const Imported rounded =
      csg("minkowski() { cube(size = [2, 3, 4], center = true); sphere($fn = 0, r = 1); }");
  CHECK(rounded.says("RoundedBox"));
  CHECK(is_near(rounded.volume(), 24 + 2 * (6 + 8 + 12) + pi * (2 + 3 + 4) + 4 * pi / 3, 1e-4));
  const Imported slot =
      csg("linear_extrude(height = 1, scale = [1, 1]) { hull() { circle($fn = 0, r = 1); " + moved +
          "{ circle($fn = 0, r = 1); } } }");
  CHECK(is_near(slot.volume(), 8 + pi, 1e-4));
  const Imported slab =
      csg("hull() { cylinder($fn = 0, h = 2, r1 = 1, r2 = 1, center = false); " + moved +
          "{ cylinder($fn = 0, h = 2, r1 = 1, r2 = 1, center = false); } }");
  CHECK(is_near(slab.volume(), 2 * (8 + pi), 1e-4));
  const Imported wide =
      csg("linear_extrude(height = 1, scale = [1, 1]) { offset(r = 1, $fn = 0) { square(size = "
          "[4, 2], center = false); } }");
  CHECK(is_near(wide.volume(), 8 + 12 + pi, 1e-4));
  const importing::ImportResult others =
      importing::import_csg("hull() { sphere($fn = 0, $fa = 12, $fs = 2, r = 1);\n" + moved +
                                "{ cube(size = [1, 1, 1], center = false); } }",
                            "test.csg");
  CHECK(said(others.diagnostics) ==
        "1:1: warning: this hull of round solids is made of OpenSCAD's facets\n");
}

TEST_CASE("the outermost colour holds, and its alpha is a transparency") {
  const Imported part =
      csg("color([1, 0, 0, 0.25]) { color([0, 0, 1, 1]) { cube(size = [1, 1, 1], center = false); "
          "} }");
  CHECK(part.says("Material { color -> srgb(1, 0, 0) transparency -> 0.75 }"));
  CHECK(!part.says("srgb(0, 0, 1)"));
  CHECK(!part.says("plain"));
  CHECK(csg("cube(size = [1, 1, 1], center = false);").says("part <material plain>"));
}

TEST_CASE("what is shown in the background is no part of the part") {
  const Imported part =
      csg("cube(size = [1, 1, 1], center = false);\n%cube(size = [5, 5, 5], center = true);\n"
          "#sphere($fn = 0, r = 1);\n*cube(size = [9, 9, 9], center = false);");
  REQUIRE(part.scene.entities.size() == 2);
  CHECK(!part.scene.entities[1].casts_shadow());
  CHECK(part.volume() < 8);
  CHECK(part.says("ghosts <material ghost, shadow false>"));
  CHECK(is_near(csg("cube(size = [9, 9, 9], center = false); !cube(size = [1, 1, 1], center = "
                    "false);")
                    .volume(),
                1, 1e-4));
}

TEST_CASE("what is empty has OpenSCAD's meaning") {
  const std::string cube = "cube(size = [1, 1, 1], center = false);";
  CHECK(is_near(csg(cube + "sphere($fn = 0, r = 0); group();").volume(), 1, 1e-4));
  CHECK(is_near(csg("difference() { " + cube + " group(); }").volume(), 1, 1e-4));
  for (const char* nothing : {"intersection() { cube(size = [1, 1, 1], center = false); group(); }",
                              "difference() { group(); cube(size = [1, 1, 1], center = false); }",
                              "", "cube(size = [-1, 1, 1], center = false);"}) {
    const importing::ImportResult result = importing::import_csg(nothing, "test.csg");
    CHECK(!result.script);
    CHECK(said(result.diagnostics) ==
          "1:1: error: there is no solid in this file: it has nothing, or only what is empty\n");
  }
}

TEST_CASE("what occurs again has a name, and the script is that of the whole") {
  const std::string part =
      "difference() { cube(size = [4, 4, 4], center = true); "
      "cylinder($fn = 0, h = 9, r1 = 1, r2 = 1, center = true); }";
  const Imported both =
      csg(part + "multmatrix([[1, 0, 0, 9], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) { " + part +
          " }");
  CHECK(both.script.find("Cylinder") == both.script.rfind("Cylinder"));
  CHECK(both.says("\nsolid = Box"));
  CHECK(is_near(both.volume(), 2 * (64 - 4 * pi), 1e-4));
}

TEST_CASE("a shape that is not understood is an error with its place, unless parts will do") {
  const std::string text = "cube(size = [1, 1, 1], center = false);\ngroup() {\n\tfoo(a = 1);\n}\n";
  const importing::ImportResult strict = importing::import_csg(text, "test.csg");
  CHECK(!strict.script);
  CHECK(said(strict.diagnostics) == "3:2: error: 'foo' is not understood\n");
  CHECK(strict.diagnostics.at(0).source_line == "\tfoo(a = 1);");
  const Imported partial = csg(text, {.partial = true});
  CHECK(said(partial.diagnostics) == "3:2: warning: 'foo' is not understood\n");
  CHECK(is_near(partial.volume(), 1, 1e-4));
}

TEST_CASE("a text that is no tree is an error with its place") {
  const std::pair<const char*, const char*> wrong[] = {
      {"cube(", "1:6: error: a value is expected here\n"},
      {"cube(size = [1, 2);", "1:18: error: ',' is expected between the items of a list\n"},
      {"cube()", "1:7: error: ';' is expected behind a module, and the file ends\n"},
      {"group() { cube();", "1:18: error: the '{' of 'group' has no '}'\n"},
      {"x = 3;", "1:3: error: '(' is expected behind the name of a module\n"},
      {"cube(size = red);", "1:16: error: 'red' is no value\n"},
      {"text(text = \"abc);", "1:19: error: this text has no end\n"},
      {"/* cube();", "1:1: error: this comment has no end\n"}};
  for (const auto& [text, message] : wrong)
    CHECK(said(importing::import_csg(text, "test.csg").diagnostics) == message);
  std::string deep;
  for (int i = 0; i < 5000; ++i) deep += "group(){";
  CHECK(said(importing::import_csg(deep, "test.csg").diagnostics) ==
        "1:3209: error: modules lie over 400 deep in one another\n");
}

TEST_CASE("a text may have quotes in it, and letters are solids") {
  const Imported part =
      csg("linear_extrude(height = 1, scale = [1, 1]) { text(text = \"a\"b\", size = 10, spacing = "
          "1, font = \"\", direction = \"ltr\", halign = \"left\", valign = \"baseline\"); }");
  CHECK(part.says("Text { text -> \"a\\\"b\" depth -> 1 size -> 13.8"));
  CHECK(part.volume() > 10);
}
