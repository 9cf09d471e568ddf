// The parts of the library are those of the standards, fit together, and are what docs/parts.md
// says.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <regex>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "crt/measure.hpp"
#include "lang/library.hpp"
#include "run.hpp"

namespace {

namespace fs = std::filesystem;

constexpr std::array scripts = {"fasteners", "gears", "bearings", "pulleys", "springs",
                                "beams",     "boxes", "hinges",   "plates",  "dimensions"};

std::string imports() {
  std::string text = "Settings { unit -> \"mm\" }\n";
  for (const char* script : scripts) text += fmt::format("import \"crt/{}\"\n", script);
  return text;
}

/// Returns the number that an expression is.
double number(const std::string& expression) {
  const crt::test::Run run = crt::test::run_statements(imports() + "print(" + expression + ")\n");
  CAPTURE(expression);
  REQUIRE(run.printed.size() == 1);
  return std::stod(run.printed[0]);
}

/// Returns the message of what is wrong with a part, and where it was called.
std::string complaint(const std::string& part) {
  const crt::test::Run run = crt::test::run(imports() + "Scene {\n  " + part + "\n}\n");
  CAPTURE(part);
  REQUIRE(run.errors().size() == 1);
  const crt::Diagnostic error = run.errors()[0];
  REQUIRE_FALSE(error.calls.empty());
  return fmt::format("{}: {}", error.calls.back().second.line - static_cast<int>(scripts.size()),
                     error.message);
}

/// Says how much the entities of a Scene overlap, all pairs together.
double overlap(const std::string& statements) {
  const crt::test::Run run = crt::test::run(imports() + "Scene {\n" + statements + "\n}\n");
  CAPTURE(statements);
  REQUIRE(run.result.diagnostics.empty());
  double sum = 0;
  for (const crt::Overlap& pair :
       crt::interference(run.result.scene->entities, {.relative_width = 0.1}))
    sum += pair.volume.upper;
  return sum;
}

/// Returns docs/parts.md, and the library's scripts with single blanks only.
std::string page() {
  std::ifstream file(fs::path(CRT_SOURCE_DIR) / "docs" / "parts.md");
  std::ostringstream text;
  text << file.rdbuf();
  REQUIRE_FALSE(text.str().empty());
  return text.str();
}
std::string with_single_blanks(std::string_view text) {
  const std::string single = std::regex_replace(std::string(text), std::regex("\\s+"), " ");
  return std::regex_replace(single, std::regex("(\\() | (\\))"), "$1$2");
}

}  // namespace

TEST_CASE("every example of the page of parts runs without error or warning, and has a picture") {
  const std::string text = page();
  const std::regex example("!\\[[^\\]]+\\]\\((parts/\\w+\\.png)\\)\n\n```crt\n([^`]+)```");
  std::size_t count = 0;
  for (std::sregex_iterator found(text.begin(), text.end(), example), end; found != end; ++found) {
    ++count;
    CHECK(fs::exists(fs::path(CRT_SOURCE_DIR) / "docs" / (*found)[1].str()));
    for (const crt::Diagnostic& diagnostic :
         crt::test::run("Settings { unit -> \"mm\" }\n" + (*found)[2].str()).result.diagnostics)
      FAIL_CHECK(crt::format_diagnostic(diagnostic));
  }
  CHECK(count >= scripts.size());
}

TEST_CASE("the page of parts has the arguments and the defaults of the scripts") {
  std::map<std::string, std::string> macros;
  for (const crt::lang::LibraryScript& script : crt::lang::library()) {
    const std::string text(script.text);
    const std::regex macro("\n(\\w+) = Macro (\\([^{]*\\)) \\{");
    for (std::sregex_iterator found(text.begin(), text.end(), macro), end; found != end; ++found)
      macros[(*found)[1]] = with_single_blanks((*found)[2].str());
  }
  const std::string text = page();
  const std::regex row("\n- `(\\w+)(\\([^`]*\\))`:");
  std::size_t count = 0;
  for (std::sregex_iterator found(text.begin(), text.end(), row), end; found != end; ++found) {
    ++count;
    CHECK_MESSAGE(macros[(*found)[1]] == with_single_blanks((*found)[2].str()), (*found)[1].str());
  }
  CHECK(count >= 35);
}

TEST_CASE("beams have the areas of their catalogue") {
  // These are in square centimetres, as makers list them with EN 10365 and EN 10056-1.
  const std::vector<std::pair<const char*, double>> areas = {
      {"IPE 80", 7.64},   {"IPE 100", 10.3},  {"IPE 120", 13.2},  {"IPE 140", 16.4},
      {"IPE 160", 20.1},  {"IPE 180", 23.9},  {"IPE 200", 28.5},  {"IPE 220", 33.4},
      {"IPE 240", 39.1},  {"IPE 270", 45.9},  {"IPE 300", 53.8},  {"IPE 330", 62.6},
      {"IPE 360", 72.7},  {"IPE 400", 84.5},  {"HEA 100", 21.2},  {"HEA 120", 25.3},
      {"HEA 140", 31.4},  {"HEA 160", 38.8},  {"HEA 180", 45.3},  {"HEA 200", 53.8},
      {"HEA 220", 64.3},  {"HEA 240", 76.8},  {"HEA 260", 86.8},  {"HEA 280", 97.3},
      {"HEA 300", 112.5}, {"HEB 100", 26.0},  {"HEB 120", 34.0},  {"HEB 140", 43.0},
      {"HEB 160", 54.3},  {"HEB 180", 65.3},  {"HEB 200", 78.1},  {"HEB 220", 91.0},
      {"HEB 240", 106},   {"HEB 260", 118.4}, {"HEB 280", 131.4}, {"HEB 300", 149.1},
      {"UPE 80", 10.1},   {"UPE 100", 12.5},  {"UPE 120", 15.4},  {"UPE 140", 18.4},
      {"UPE 160", 21.7},  {"UPE 180", 25.1},  {"UPE 200", 29.0},  {"UPE 220", 33.9},
      {"UPE 240", 38.5},  {"UPE 270", 44.8},  {"UPE 300", 56.6},  {"L 20x3", 1.12},
      {"L 25x3", 1.42},   {"L 30x3", 1.74},   {"L 30x4", 2.27},   {"L 40x4", 3.08},
      {"L 40x5", 3.79},   {"L 50x4", 3.89},   {"L 50x5", 4.80},   {"L 50x6", 5.69},
      {"L 60x5", 5.82},   {"L 60x6", 6.91},   {"L 60x8", 9.03},   {"L 70x6", 8.13},
      {"L 70x7", 9.40},   {"L 80x8", 12.3},   {"L 80x10", 15.1},  {"L 100x8", 15.5},
      {"L 100x10", 19.2}, {"L 100x12", 22.7}};
  CHECK(number("len(keys(beamSizes))") == static_cast<double>(areas.size()));
  for (const auto& beam : areas) {
    CAPTURE(beam.first);
    CHECK(number(fmt::format("volume(beam(\"{}\", 10), 1e-4)", beam.first)) ==
          doctest::Approx(1000 * beam.second).epsilon(0.005));
  }
  CHECK(number("volume(beam(tubeContour(50, 4), 10), 1e-4)") ==
        doctest::Approx(std::numbers::pi * (625 - 441) * 10).epsilon(1e-4));
  const double corners = (4 - std::numbers::pi) * (6 * 6 - 4 * 4);
  CHECK(number("volume(beam(hollowContour(50, 30, 4), 10), 1e-4)") ==
        doctest::Approx((50 * 30 - 42 * 22 - corners) * 10).epsilon(1e-4));
}

TEST_CASE("a gear's tooth is as thick at the pitch circle as its backlash leaves it") {
  for (const auto& [teeth, pressure] : std::vector<std::pair<int, int>>{
           {17, 20}, {18, 20}, {30, 20}, {100, 20}, {12, 25}, {40, 14}}) {
    const double radius = teeth;  // of a module of 2
    CAPTURE(radius);
    const double half_angle = (std::numbers::pi - 0.1) / 2 / radius;
    const double x = radius * std::cos(half_angle);
    const std::string chord = fmt::format(
        "thickness(spurGear({}, 2, 5, pressure -> {}, backlash -> 0.1), vec3({}, 2, -3), "
        "vec3({}, 2, 3))",
        teeth, pressure, x, x);
    CHECK(number(chord) == doctest::Approx(2 * radius * std::sin(half_angle)).epsilon(6e-4));
  }
}

TEST_CASE("gears that mesh touch one another nowhere, and without room they do") {
  const auto pair = [](int a, int b, double turn, double nearer) {
    return fmt::format(
        "spurGear({}, 2, 4) <rotate vec3(0, {}, 0)>\n"
        "spurGear({}, 2, 4) <rotate vec3(0, gearPhase({}, {}, {}), 0),"
        " translate vec3(gearDistance({}, {}, 2) - {}, 0, 0)>",
        a, turn, b, a, b, turn, a, b, nearer);
  };
  for (const double turn : {0.0, 3.1}) CHECK(overlap(pair(23, 12, turn, 0)) == 0);
  CHECK(overlap(pair(8, 40, 5, 0)) == 0);
  CHECK(overlap(pair(23, 12, 3.1, 0.25)) > 0);
  for (const double turn : {0.0, 2.5}) {
    CHECK(overlap(fmt::format("ringGear(60, 1, 4) <rotate vec3(0, {}, 0)>\n"
                              "spurGear(20, 1, 4) <rotate vec3(0, ringPhase(60, 20, {}), 0),"
                              " translate vec3(ringDistance(60, 20, 1), 0, 0)>",
                              turn, turn)) == 0);
    CHECK(overlap(fmt::format("spurGear(16, 2, 4) <rotate vec3(0, {}, 0)>\n"
                              "rack(8, 2, 4) <translate vec3(16, 0, rackPhase(16, 2, {}))>",
                              turn, turn)) == 0);
  }
}

TEST_CASE("bearings, washers and pulleys have the sizes of their standards") {
  const auto holds = [](const std::string& part, double x, double y) {
    return number(fmt::format("contains({}, vec3({}, {}, 0)) ? 1 : 0", part, x, y)) == 1;
  };
  for (const auto& [name, bore, outside, width] : std::vector<std::array<int, 4>>{
           {608, 8, 22, 7}, {6000, 10, 26, 8}, {6010, 50, 80, 16}, {6206, 30, 62, 16}}) {
    const std::string bearing = fmt::format("bearing({})", name);
    CAPTURE(bearing);
    CHECK(holds(bearing, outside / 2.0 - 0.001, 2));
    CHECK_FALSE(holds(bearing, outside / 2.0 + 0.001, 2));
    CHECK(holds(bearing, bore / 2.0 + 0.001, 2));
    CHECK_FALSE(holds(bearing, bore / 2.0 - 0.001, 2));
    // The sides are flat between the edges and the grooves.
    const double ring = outside / 2.0 - 0.15 * (outside - bore) / 2.0;
    for (const double y : {0.001, width - 0.001}) CHECK(holds(bearing, ring, y));
    for (const double y : {-0.001, width + 0.001}) CHECK_FALSE(holds(bearing, ring, y));
  }
  CHECK(number("volume(washer(8), 1e-5)") ==
        doctest::Approx(std::numbers::pi * (64 - 4.2 * 4.2) * 1.6).epsilon(1e-4));
  // At the datum diameter the groove of a belt A is 11 wide, and the pulley 20 in all.
  CHECK(number("thickness(vPulley(100), vec3(50, 0, 0), vec3(50, 20, 0))") ==
        doctest::Approx(9).epsilon(1e-6));
  CHECK(holds("timingPulley(20)", 4, 8.999));
  CHECK_FALSE(holds("timingPulley(20)", 4, 9.001));
  // 20 teeth of 2 mm are 12.732 across at the pitch line, and the pulley 12.224.
  CHECK(number("thickness(timingPulley(20, bore -> 0), vec3(7 * cos(9deg), 3, 7 * sin(9deg)),"
               " vec3(0, 3, 0))") == doctest::Approx(6.112).epsilon(1e-4));
  CHECK(number("thickness(timingPulley(20, bore -> 0), vec3(7, 3, 0), vec3(0, 3, 0))") ==
        doctest::Approx(6.112 - 0.764).epsilon(1e-3));
}

TEST_CASE("springs have the length that is asked for, and the volume of their wire") {
  CHECK(number("bounds(compressionSpring(2, 20, 40, 6), 1e-3)[1].y") ==
        doctest::Approx(40).epsilon(1e-3));
  CHECK(number("thickness(extensionSpring(2, 16, 8), vec3(0, 0, 0), vec3(0, 60, 0))") > 3.9);
  // Six coils of a pitch of (40 - 2 - 4.08) / 6 and two closed ones make the volume.
  const double pitch = (40 - 2 - 4.08) / 6;
  const double wire =
      6 * std::hypot(20 * std::numbers::pi, pitch) + 2 * std::hypot(20 * std::numbers::pi, 2.04);
  const crt::test::Run run =
      crt::test::run(imports() + "Scene { compressionSpring(2, 20, 40, 6, ground -> false) }");
  REQUIRE(run.ok());
  CHECK(crt::volume(run.result.scene->entities[0], {.relative_width = 1e-2}).middle() ==
        doctest::Approx(std::numbers::pi * wire).epsilon(5e-3));
}

TEST_CASE("lids fit into boxes with their clearance, and hinges turn freely") {
  CHECK(overlap("boxBase(60, 40, 25)\nboxClosed(boxLid(60, 40), 25)") == 0);
  const std::string lid = "boxClosed(boxLid(60, 40), 25)";
  CHECK(number("thickness(" + lid + ", vec3(29, 24, 0), vec3(31, 24, 0))") ==
        doctest::Approx(0.8).epsilon(1e-6));
  CHECK(number("thickness(boxBase(60, 40, 25), vec3(29, 24, 0), vec3(31, 24, 0))") ==
        doctest::Approx(1).epsilon(1e-6));
  CHECK(overlap("screwBoxBase(60, 40, 25)\nboxClosed(screwBoxLid(60, 40), 25)") == 0);
  // The leaves alone take part, as a pin in a bore takes long to compare.
  const auto leaf = [](int first, int side) {
    return fmt::format("hingeLeaf(60, 25, 2, 3, 5, range({}, 5, 2), {}, 3, 3, 0.2)", first, side);
  };
  for (const int angle : {0, 45, 180, 270}) {
    CAPTURE(angle);
    CHECK(overlap(fmt::format("{}\n{} <rotate vec3(0, {}, 0)>", leaf(0, 1), leaf(1, -1), angle)) ==
          0);
  }
  CHECK(overlap(leaf(0, 1) + "\n" + leaf(0, -1)) > 0);
  // Across the middle knuckle there are its wall, the clearance of the bore, and the pin.
  CHECK(number("thickness(hinge(60, 25), vec3(-4, 30, 0), vec3(4, 30, 0))") ==
        doctest::Approx(7 - 2 * 0.1).epsilon(1e-6));
}

TEST_CASE("a dimension's line is off its points, and a text is within its plate") {
  // Its line is 10 above, and its arrows end above the points.
  const std::string part =
      "dimension(vec3(0, 0, 0), vec3(50, 0, 0), vec3(0, 10, 0), text -> \"x\")";
  CHECK(number("thickness(" + part + ", vec3(0, 10, 0), vec3(50, 10, 0))") ==
        doctest::Approx(50).epsilon(1e-3));
  // Texts read from left to right: an L has nothing on its upper right.
  const auto label = [](const std::string& facing, const std::string& from, const std::string& to) {
    return number(
        fmt::format("thickness(label(\"L\", vec3(0, 0, 0), facing -> {}, size -> 10,"
                    " alignment -> \"left\"), {}, {}) > 0 ? 1 : 0",
                    facing, from, to));
  };
  CHECK(label("vec3(0, 0, -1)", "vec3(0, 8, 0.5)", "vec3(3, 8, 0.5)") == 1);
  CHECK(label("vec3(0, 0, -1)", "vec3(3.2, 8, 0.5)", "vec3(9, 8, 0.5)") == 0);
  CHECK(label("vec3(0, 1, 0)", "vec3(0, -0.5, 8)", "vec3(3, -0.5, 8)") == 1);
  CHECK(label("vec3(0, 1, 0)", "vec3(3.2, -0.5, 8)", "vec3(9, -0.5, 8)") == 0);
  CHECK(label("vec3(0, 0, 1)", "vec3(0, 8, -0.5)", "vec3(-3, 8, -0.5)") == 1);
  CHECK(number("bounds(textPlate(\"ab\", 60, 25), 1e-3)[0].z") == doctest::Approx(-1).epsilon(0.1));
  CHECK(number("volume(textPlate(\"ab\", 60, 25, raised -> false), 1e-3)") <
        60 * 25 * 3 - (4 - std::numbers::pi) * 16 * 3);
}

TEST_CASE("wrong arguments of parts are errors where they are given") {
  const std::vector<std::pair<const char*, const char*>> wrong = {
      {"spurGear(5, 1, 5)", "the number of teeth is a whole one from 6 to 1000, and not 5"},
      {"spurGear(20, 0, 5)", "the module is greater than 0, and not 0"},
      {"spurGear(20, 1, 5, bore -> 18)",
       "the bore is from 0 to less than the diameter of the roots, 17.5, and not 18"},
      {"ringGear(10, 1, 5)", "the number of teeth is a whole one from 20 to 1000, and not 10"},
      {"rack(4, 1, 5, backlash -> 1)",
       "the backlash is from 0 to a quarter of the module, and not 1"},
      {"compressionSpring(2, 20, 10, 6)",
       "6 coils and two ends are longer than 10: the shortest are 16.32"},
      {"extensionSpring(2, 5, 6)",
       "the coils' diameter is from 3 to 100 times that of the wire, and not 5"},
      {"beam(\"IPE 80\", 0)", "the length is greater than 0, and not 0"},
      {"beam(hollowContour(20, 20, 10), 5)", "walls of 10 fill 20 x 20"},
      {"beam(slotContour(30), 5)", "slot profiles have a size of 20 or 40, and not 30"},
      {"vPulley(100, belt -> \"C\")", "there is no belt 'C'; there are [\"Z\", \"A\", \"B\"]"},
      {"timingPulley(10, bore -> 5)", "the bore is from 0 to less than 4.33, and not 5"},
      {"boxBase(60, 40, 25, radius -> 21)",
       "the inner radius is from 0 to half of the shorter side, and not 21"},
      {"hinge(60, 25, angle -> 300)", "a hinge opens from 0 to 270 degrees, and not 300"},
      {"label(\"a\", vec3(0, 0, 0), size -> 0)",
       "the size of letters is greater than 0, and not 0"}};
  for (const auto& [part, message] : wrong) CHECK(complaint(part) == fmt::format("3: {}", message));
  CHECK(complaint("beam(\"IPE 85\", 5)").starts_with("3: there is no beam 'IPE 85'; there are ["));
  CHECK(complaint("bearing(6099)").starts_with("3: there is no bearing '6099'; there are ["));
  CHECK(complaint("textPlate(\"much too long\", 20, 20)").starts_with("3: the text is "));
}
