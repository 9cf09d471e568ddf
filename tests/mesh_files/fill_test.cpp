// Which rule says what is inside of a mesh from a file, and which warnings come with it.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "mesh_texts.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Returns the vertices and faces of a box, turned outwards or not, after `boxes` others.
std::string box(int lower, int upper, int boxes, bool outwards = true) {
  std::string text;
  for (int i = 0; i < 8; ++i) {
    const auto number = [&](int bit) { return std::to_string((i & bit) != 0 ? upper : lower); };
    text += "v " + number(1) + " " + number(2) + " " + number(4) + "\n";
  }
  constexpr int sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                               {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& side : sides) {
    text += "f";
    for (int k = 0; k < 4; ++k)
      text += " " + std::to_string(8 * boxes + 1 + side[outwards ? k : 3 - k]);
    text += "\n";
  }
  return text;
}

MeshReport report_of(const std::string& text, const MeshOptions& options = {}) {
  return *mesh_report(load_mesh(decode(text), "some.name", options));
}

}  // namespace

TEST_CASE("a file is filled by the nonzero rule if all shells are turned outwards") {
  using enum FillRule;
  CHECK(report_of(box(0, 4, 0)).fill == nonzero);
  CHECK(report_of(box(0, 4, 0) + box(1, 2, 1)).fill == nonzero);
  CHECK(report_of(box(0, 4, 0) + box(2, 6, 1)).fill == nonzero);
  // All of a file may be turned round, as normals are turned out of it.
  CHECK(report_of(box(0, 4, 0, false)).fill == nonzero);
  CHECK(report_of(box(0, 4, 0, false) + box(1, 2, 1, false)).fill == nonzero);
  // A cavity is turned inwards in what is turned outwards.
  CHECK(report_of(box(0, 4, 0) + box(1, 2, 1, false)).fill == nonzero);
  // A shell by itself that is turned inwards is a mistake, and nobody knows of whom.
  CHECK(report_of(box(0, 4, 0) + box(6, 7, 1, false)).fill == even_odd);
  CHECK(report_of(box(0, 4, 0) + box(1, 2, 1), {.fill = even_odd}).fill == even_odd);
  const std::string cube = box(0, 4, 0);
  const std::string turned = cube.substr(0, cube.rfind("f ")) + "f 6 8 7 5\n";
  CHECK(report_of(turned + box(1, 2, 1)).fill == nonzero);
  const std::string mixed = cube.substr(0, cube.rfind("f ")) + "f 5 7 8 6\n";
  CHECK(report_of(mixed + box(1, 2, 1)).fill == even_odd);
}

TEST_CASE("warnings of a file and of its mesh come together, with the name of the file") {
  std::string text = "mtllib nowhere.mtl\nusemtl a\n" + box(0, 4, 0) + box(1, 2, 1);
  const MeshReport report = report_of(text, {.weld = 1e-6, .stitch = 1e-6});
  CHECK(report.name == "some.name");
  REQUIRE(report.warnings.size() == 4);
  CHECK(report.warnings[0].find("nowhere.mtl") != std::string::npos);
  CHECK(report.warnings[1] ==
        "weld has made 0 of its vertices others, and 0 of its triangles went");
  CHECK(report.warnings[2] == "stitch has put 0 vertices into edges");
  CHECK(report.warnings[3].ends_with("by 'nonzero' they are one solid"));
}
