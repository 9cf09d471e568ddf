#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>

#include "cli/command.hpp"
#include "cli/json.hpp"

using namespace crt::test;

namespace fs = std::filesystem;

namespace {

constexpr double pi = std::numbers::pi;

/// This script has a plate with a hole, a ball, a disc and a half-space.
const std::string parts_script = R"(Settings { unit -> "mm" }
hole = Cylinder { from -> vec3(1, 1, -1) to -> vec3(1, 1, 2) radius -> 0.5 }
Scene {
  Box { cornerA -> vec3(0, 0, 0) cornerB -> vec3(4, 2, 1) } - hole
  Sphere { center -> vec3(5, 0, 0) radius -> 1 }
  Disc { center -> vec3(9, 0, 0) normal -> vec3(0, 1, 0) radius -> 1 }
  Plane { normal -> vec3(0, 1, 0) position -> vec3(0, -3, 0) }
}
)";

struct Fixture {
  TemporaryFolder folder;
  Fixture() {
    folder.write("parts.crt", parts_script);
    folder.write("ball.crt", "Scene { Sphere { center -> vec3(0, 0, 0) radius -> 1 } }\n");
  }

  Json measured(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "measure");
    arguments.emplace_back("--json");
    const Outcome run = run_crt(folder, arguments);
    REQUIRE_MESSAGE(run.exit_code == 0, run.err);
    return parse_json(run.out);
  }
};

bool contains(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

bool holds(const Json& interval, double truth) {
  return interval.items.at(0).number <= truth && truth <= interval.items.at(1).number;
}

double width(const Json& interval) {
  return interval.items.at(1).number - interval.items.at(0).number;
}

}  // namespace

TEST_CASE_FIXTURE(Fixture, "without a question all but the mass is said of each entity") {
  const Json json = measured({"parts.crt"});
  CHECK(json["unit"].string == "mm");
  REQUIRE(json["entities"].items.size() == 4);
  const Json& plate = json["entities"].items[0];
  CHECK(plate["name"].string == "entity 0 (line 4)");
  CHECK(holds(plate["volume"], 8 - pi / 4));
  CHECK(width(plate["volume"]) <= 1e-4 * 8);
  CHECK(holds(plate["area"], 28 - pi / 2 + pi));
  CHECK(holds(plate["centroid"].items[0], (16 - pi / 4) / (8 - pi / 4)));
  CHECK(plate["bounds"]["upper"].items[0].number == doctest::Approx(4).epsilon(1e-4));
  CHECK(!plate.has("mass"));
  CHECK(!plate.has("inertia"));
  CHECK(holds(json["sum"]["volume"], 8 - pi / 4 + 4 * pi / 3));
}

TEST_CASE_FIXTURE(Fixture, "what has no volume is named with why, and its box is given") {
  const Json json = measured({"parts.crt"});
  const Json& disc = json["entities"].items[2];
  CHECK(contains(disc["fault"].string, "only a solid can be measured"));
  CHECK(!disc.has("volume"));
  CHECK(disc["bounds"]["upper"].items[0].number == doctest::Approx(10));
  const Json& half = json["entities"].items[3];
  CHECK(contains(half["fault"].string, "infinite"));
  CHECK(half["bounds"]["lower"].items[1].kind == Json::Kind::null);
  const Outcome run = run_crt(folder, {"measure", "parts.crt"});
  CHECK(run.exit_code == 0);
  CHECK(contains(run.out, "entity 2 (line 6)\n"));
  CHECK(contains(run.out, "only a solid can be measured"));
  CHECK(contains(run.out, "sum of 2 of 4 entities"));
}

TEST_CASE_FIXTURE(Fixture, "the guide shows what is printed of its example") {
  const fs::path source = CRT_SOURCE_DIR;
  fs::copy_file(source / "examples/measure/plate.crt", folder.path() / "plate.crt");
  std::ifstream file(source / "docs/measure.md");
  const std::string page((std::istreambuf_iterator<char>(file)), {});
  const Outcome run = run_crt(folder, {"measure", "plate.crt"});
  CHECK(run.exit_code == 0);
  CHECK_MESSAGE(
      contains(page, "<!-- printed by crt measure plate.crt -->\n```\n" + run.out + "```\n"),
      run.out);
  const Outcome section = run_crt(folder, {"measure", "plate.crt", "--section", "y=6"});
  CHECK_MESSAGE(contains(page, "<!-- printed by crt measure plate.crt --section y=6 -->\n```\n" +
                                   section.out + "```\n"),
                section.out);
  fs::copy_file(source / "examples/measure/bracket.crt", folder.path() / "bracket.crt");
  const Outcome masses = run_crt(folder, {"measure", "bracket.crt", "--mass"});
  CHECK_MESSAGE(contains(page, "<!-- printed by crt measure bracket.crt --mass -->\n```\n" +
                                   masses.out + "```\n"),
                masses.out);
}

TEST_CASE_FIXTURE(Fixture, "only what is asked for is said") {
  const Json volume = measured({"ball.crt", "--volume", "--relative-width", "1e-9"});
  const Json& ball = volume["entities"].items[0];
  CHECK(holds(ball["volume"], 4 * pi / 3));
  CHECK(width(ball["volume"]) <= 1e-9 * 4.2);
  CHECK(!ball.has("area"));
  CHECK(!ball.has("bounds"));
  const Json area = measured({"ball.crt", "--area"});
  CHECK(holds(area["entities"].items[0]["area"], 4 * pi));
  CHECK(!area["entities"].items[0].has("volume"));
  const Json bounds = measured({"parts.crt", "--bounds"});
  CHECK(bounds["entities"].items[0].has("bounds"));
  CHECK(!bounds["entities"].items[2].has("fault"));
}

TEST_CASE_FIXTURE(Fixture, "a density gives the mass, and the inertia with it") {
  const Json json = measured({"ball.crt", "--density", "3"});
  const Json& ball = json["entities"].items[0];
  CHECK(json["density"].number == 3);
  CHECK(holds(ball["mass"], 4 * pi));
  CHECK(holds(ball["inertia"].items[0], 0.4 * 4 * pi));
  CHECK(holds(ball["inertia"].items[3], 0));
  CHECK(holds(json["sum"]["mass"], 4 * pi));
}

TEST_CASE_FIXTURE(Fixture, "parts of an assembly have the densities of their materials, in kg") {
  const std::string steel = "steel = Material { density -> 7850 }\n";
  const std::string parts =
      "Settings { unit -> \"mm\" }\nScene {\n"
      "  Box { cornerA -> vec3(0, 0, 0) cornerB -> vec3(100, 100, 10) material -> steel }\n"
      "  Box { cornerA -> vec3(0, 0, 20) cornerB -> vec3(100, 100, 30)\n"
      "    material -> PrincipledMaterial { density -> 1000 } }\n";
  folder.write("all.crt", steel + parts + "}\n");
  const Json json = measured({"all.crt", "--mass"});
  const Json& plate = json["entities"].items[0];
  CHECK(plate["density"].number == 7850);
  CHECK(plate["mass_unit"].string == "kg");
  CHECK(holds(plate["mass"], 0.785));
  CHECK(width(plate["mass"]) <= 1e-4);
  CHECK(holds(json["entities"].items[1]["mass"], 0.1));
  CHECK(holds(json["sum"]["mass"], 0.885));
  CHECK(json["sum"]["mass_unit"].string == "kg");
  CHECK(holds(json["sum"]["centroid"].items[2], (5 * 0.785 + 25 * 0.1) / 0.885));
  CHECK(contains(run_crt(folder, {"measure", "all.crt", "--mass"}).out, "  mass      0.885"));
  CHECK(contains(run_crt(folder, {"measure", "all.crt", "--mass"}).out, " kg, between 0.8"));

  // What has no density is weighed by that which is given, and not at all without one.
  folder.write(
      "some.crt",
      steel + parts + "  Box { cornerA -> vec3(0, 0, 40) cornerB -> vec3(1, 1, 41) }\n}\n");
  const Json some = measured({"some.crt", "--mass"});
  CHECK(holds(some["entities"].items[2]["mass"], 1));
  CHECK(!some["entities"].items[2].has("mass_unit"));
  CHECK(!some["sum"].has("mass"));
  CHECK(!some["sum"].has("centroid"));
  const Json given = measured({"some.crt", "--density", "2"});
  CHECK(holds(given["entities"].items[2]["mass"], 2));
  CHECK(holds(given["entities"].items[0]["mass"], 0.785));
  CHECK(holds(given["sum"]["mass"], 2.885));
  CHECK(!given["sum"].has("mass_unit"));

  folder.write("mixed.crt",
               steel +
                   "Scene { Box { cornerA -> vec3(0, 0, 0) cornerB -> vec3(1, 1, 1)"
                   " material -> steel } + Sphere { center -> vec3(5, 0, 0) radius -> 1"
                   " material -> Material { density -> 1 } } }\n");
  CHECK(contains(measured({"mixed.crt", "--mass"})["entities"].items[0]["fault"].string,
                 "different densities, such as "));
  CHECK(!measured({"mixed.crt", "--volume"})["entities"].items[0].has("fault"));
}

TEST_CASE_FIXTURE(Fixture, "numbers have the digits that are sure, and the unit") {
  const Outcome rough = run_crt(folder, {"measure", "ball.crt", "--volume"});
  CHECK(contains(rough.out, "  volume    4.18"));
  CHECK(contains(rough.out, " m3, between 4.18"));
  const Outcome fine = run_crt(
      folder, {"measure", "ball.crt", "--volume", "--relative-width", "1e-8", "--unit", "in"});
  CHECK(contains(fine.out, "  volume    4.1887902"));
  CHECK(contains(fine.out, " in3, between 4.18879"));
  CHECK(!contains(fine.out, "sum"));
}

TEST_CASE_FIXTURE(Fixture,
                  "a script from standard input is measured, and what it prints is beside") {
  const Outcome run = run_crt_in(
      {.input = "print(7)\nScene { Box { cornerA -> vec3(0, 0, 0) cornerB -> vec3(1, 1, 1) } }\n"},
      folder, {"measure", "-", "--volume"});
  CHECK_MESSAGE(run.exit_code == 0, run.err);
  CHECK(contains(run.out, "entity 0 (line 2)"));
  CHECK(contains(run.err, "7\n"));
}

TEST_CASE_FIXTURE(Fixture, "a wrong option or script of measure ends with its code") {
  CHECK(run_crt(folder, {"measure", "ball.crt", "--relative-width", "0"}).exit_code == 2);
  CHECK(run_crt(folder, {"measure", "ball.crt", "--relative-width", "2"}).exit_code == 2);
  CHECK(run_crt(folder, {"measure", "ball.crt", "--density", "-1"}).exit_code == 2);
  CHECK(run_crt(folder, {"measure", "ball.crt", "--seconds", "0"}).exit_code == 2);
  CHECK(run_crt(folder, {"measure", "none.crt"}).exit_code == 3);
  folder.write("wrong.crt", "Scene { Ball { } }\n");
  const Outcome run = run_crt(folder, {"measure", "wrong.crt"});
  CHECK(run.exit_code == 1);
  CHECK(run.out.empty());
}

TEST_CASE_FIXTURE(Fixture, "time that is over leaves wider bounds that hold the truth") {
  const Json json = measured({"ball.crt", "--relative-width", "1e-12", "--seconds", "1e-6"});
  CHECK(holds(json["entities"].items[0]["volume"], 4 * pi / 3));
}

TEST_CASE_FIXTURE(Fixture, "a section has an area, contours and a drawing") {
  const Json json = measured({"parts.crt", "--section", "z=0.5", "--deviation", "0.01"});
  const Json& plate = json["entities"].items[0];
  CHECK(!plate.has("volume"));
  const Json& section = plate["section"];
  CHECK(holds(section["area"], 8 - pi / 4));
  CHECK(section["deviation"].number <= 0.01);
  CHECK(section["contours"].items.size() == 2);
  CHECK(section["contours"].items[0].items.size() == 4);
  CHECK(section["contours"].items[1].items.size() == 2);
  CHECK(section["upper"].items[1].number == doctest::Approx(2));
  CHECK(json["entities"].items[2].has("fault"));  // the disc is no solid
  const Json slanted = measured({"ball.crt", "--section", "1,2,2=0.6"});
  CHECK(holds(slanted["entities"].items[0]["section"]["area"], pi * 0.64));

  const Outcome run =
      run_crt(folder, {"measure", "parts.crt", "--section", "z=0.5", "-o", "a.svg"});
  CHECK(run.exit_code == 0);
  CHECK(contains(run.out, "contours  2, within"));
  CHECK(contains(folder.read("a.svg"), "mm\""));
  CHECK(
      run_crt(folder, {"measure", "ball.crt", "--section", "x=0", "--hatch", "0.1", "-o", "b.dxf"})
          .exit_code == 0);
  CHECK(contains(folder.read("b.dxf"), "HATCH"));
  const Outcome none = run_crt(folder, {"measure", "ball.crt", "--section", "x=7"});
  CHECK(contains(none.out, "section   none"));
}

TEST_CASE_FIXTURE(Fixture, "wrong questions about sections are refused") {
  for (const char* const plane : {"z", "w=1", "z=", "1,2=3", "1,2,3,4=5", "0,0,0=1", "z=inf", ""}) {
    CAPTURE(plane);
    const Outcome run = run_crt(folder, {"measure", "ball.crt", "--section", plane});
    CHECK(run.exit_code != 0);
    CHECK(contains(run.err, "--section"));
  }
  CHECK(run_crt(folder, {"measure", "ball.crt", "-o", "a.svg"}).exit_code != 0);
  CHECK(run_crt(folder, {"measure", "ball.crt", "--section", "z=0", "-o", "a.png"}).exit_code != 0);
  CHECK(
      run_crt(folder, {"measure", "ball.crt", "--section", "z=0", "--deviation", "0"}).exit_code !=
      0);
}

TEST_CASE_FIXTURE(Fixture, "two entities are as far apart as is printed, with a point of each") {
  const Json json = measured({"parts.crt", "--distance", "1,0", "--distance", "entity 1,0"});
  CHECK(!json.has("entities"));
  REQUIRE(json["distances"].items.size() == 2);
  const Json& found = json["distances"].items[0];
  // From the ball's middle to the corner of the plate at (4, 0, 0) is 1, so they touch.
  CHECK(found["first"].number == 1);
  CHECK(found["second"].number == 0);
  CHECK(found["distance"].items[0].number == 0);
  CHECK(found["on_second"].items[0].number == doctest::Approx(4));
  folder.write("two.crt", R"(Settings { unit -> "mm" }
Scene {
  Box { cornerA -> vec3(0, 0, 0) cornerB -> vec3(1, 1, 1) }
  Box { cornerA -> vec3(3, 0, 0) cornerB -> vec3(4, 1, 1) }
  Box { cornerA -> vec3(0.5, 0.5, 0.5) cornerB -> vec3(2, 2, 2) }
})");
  const Outcome apart =
      run_crt(folder, {"measure", "two.crt", "--distance", "entity 0 (line 3),entity 1 (line 4)"});
  CHECK_MESSAGE(apart.exit_code == 0, apart.err);
  CHECK(contains(apart.out, "distance of entity 0 (line 3) and entity 1 (line 4)\n  clearance 2"));
  CHECK(contains(apart.out, "  from      (1, "));
  CHECK(contains(apart.out, "  to        (3, "));
  CHECK(!contains(apart.out, "volume"));
  const Outcome within = run_crt(folder, {"measure", "two.crt", "--distance", "0,2", "--volume"});
  CHECK(contains(within.out, "  overlap   both hold ("));
  CHECK(contains(within.out, "  volume    1.0"));
  CHECK(!contains(within.out, "centroid"));
}

TEST_CASE_FIXTURE(Fixture, "entities that overlap are listed with the volume they have in common") {
  folder.write("three.crt", R"(Scene {
  Box { cornerA -> vec3(0, 0, 0) cornerB -> vec3(2, 2, 2) }
  Box { cornerA -> vec3(2, 0, 0) cornerB -> vec3(3, 2, 2) }
  Box { cornerA -> vec3(1, 1, 1) cornerB -> vec3(4, 4, 4) }
})");
  const Json json = measured({"three.crt", "--interference"});
  REQUIRE(json["interference"].items.size() == 2);
  CHECK(json["interference"].items[1]["first"].number == 1);
  CHECK(json["interference"].items[1]["second"].number == 2);
  CHECK(holds(json["interference"].items[1]["volume"], 1));
  const Outcome run = run_crt(folder, {"measure", "three.crt", "--interference"});
  CHECK(contains(run.out, "  entity 0 (line 2) and entity 2 (line 4)\n    volume  1"));
  const Outcome alone = run_crt(folder, {"measure", "ball.crt", "--interference"});
  CHECK(contains(alone.out, "no two of them overlap"));
}

TEST_CASE_FIXTURE(Fixture, "a distance of what is not there, or has none, is refused") {
  CHECK(run_crt(folder, {"measure", "parts.crt", "--distance", "0"}).exit_code == 2);
  CHECK(run_crt(folder, {"measure", "parts.crt", "--distance", "0,1,2"}).exit_code == 2);
  for (const char* wrong : {"0,4", "0,-1", "entity,0", "0,"}) {
    const Outcome run = run_crt(folder, {"measure", "parts.crt", "--distance", wrong});
    CHECK(run.exit_code != 0);
    CHECK(contains(run.err, "there is no entity '"));
    CHECK(run.out.empty());
  }
  CHECK(contains(run_crt(folder, {"measure", "parts.crt", "--distance", "0,2"}).err, "solid"));
}

TEST_CASE_FIXTURE(Fixture, "the thinnest wall is said with where it is") {
  const Json json = measured({"parts.crt", "--thickness"});
  const Json& plate = json["entities"].items[0]["thickness"];
  CHECK(holds(plate["least"], 0.5));
  CHECK(width(plate["least"]) <= 0.005);
  CHECK(plate["to"].items.size() == 3);
  CHECK(!json["entities"].items[0].has("volume"));
  CHECK(contains(json["entities"].items[2]["fault"].string, "only a solid"));
  const Outcome run = run_crt(folder, {"measure", "parts.crt", "--thickness"});
  CHECK(contains(run.out, "  thickness 0.5"));
  CHECK(contains(run.out, " mm, between "));
  CHECK(contains(run.out, "    from    ("));
}
