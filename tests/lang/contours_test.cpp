// Profiles of scripts have curves, and come from SVG paths.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "crt/query.hpp"
#include "run.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Returns where a ray along x, at a height, meets the profile's extrusion.
std::vector<double> crossings_of(const std::string& profile, double y) {
  const Run done = run("Scene { Extrusion { profile -> " + profile + " height -> 1 } }");
  INFO(profile);
  REQUIRE(done.ok());
  std::vector<double> places;
  for (const Hit& hit :
       crossings(prepare(*done.result.scene), {.origin = {-100, y, 0.5}, .direction = {1, 0, 0}})) {
    places.push_back(hit.t - 100);
  }
  return places;
}

std::string fault(const std::string& text) {
  const Run done = run(text);
  REQUIRE(done.errors().size() == 1);
  return done.messages()[0];
}

}  // namespace

TEST_CASE("a contour's corner may come with the control points of a curve") {
  // The parabola y = x^2 from -1 to 1, and half of it drawn back as a cubic.
  CHECK(crossings_of("[[-1, 1], [0, -1, 1, 1]]", 0.25)[1] == doctest::Approx(0.5).epsilon(1e-3));
  const std::string closing = "[[-1.0 / 3, -1.0 / 3, 1.0 / 3, -1.0 / 3, 1, 1], [-1, 1]]";
  CHECK(crossings_of(closing, 0.25)[1] == doctest::Approx(0.5).epsilon(1e-3));
  CHECK(
      fault("Scene { Extrusion { profile -> [[0, 0], [1, 0, 1, 1e200, 0, 1]] height -> 1 } }") ==
      "'profile' has a curve that is wrong: control2 must have finite numbers of at most 1e100 in "
      "magnitude (it is (1, 1e+200))");
  CHECK(fault("Scene { Extrusion { profile -> [[0, 0], [1, 0, 1, 1, 0]] height -> 1 } }")
            .find("'profile' must have corners such as") == 0);
}

TEST_CASE("svg gives the contours of a path as a List") {
  const Run done =
      run("print(svg(\"M0 0H2V1z\"), len(svg(\"M0 0H9V9H0ZM3 3H6V6H3Z\", 0, "
          "\"evenodd\")))\nScene {}");
  REQUIRE(done.ok());
  CHECK(done.printed == std::vector<std::string>{"[[[0, 0], [2, 0], [2, -1]]] 2"});
  using Places = std::vector<double>;
  CHECK(crossings_of("svg(\"M0 0A1 1 0 1 1 0-2 1 1 0 1 1 0 0\")", 1) == Places{-1, 1});
  CHECK(crossings_of("svg(\"M0 0H9V9H0ZM3 3H6V6H3Z\", 0.001, \"nonzero\")", -4) == Places{0, 9});
  CHECK(crossings_of("svg(\"M0 0H9V9H0ZM3 3H6V6H3Z\", 0.001, \"evenodd\")", -4) ==
        Places{0, 3, 6, 9});
}

TEST_CASE("an error of svg says where the path is wrong") {
  CHECK(fault("a = svg(\"M0 0X\")\nScene {}").find("svg: path has 'X' at character 5") == 0);
  CHECK(fault("a = svg(3)\nScene {}") ==
        "svg(path, deviation, rule) takes a String here, not an Integer");
  CHECK(fault("a = svg(\"M0 0Q1 1 2 0\", 1e-30)\nScene {}").find("svg: deviation must be 0") == 0);
  CHECK(fault("a = svg(\"M0 0H1V1\", 0, \"even\")\nScene {}") ==
        "svg(path, deviation, rule) takes \"nonzero\" or \"evenodd\" here, not a String");
}

TEST_CASE("a path that takes long to fill ends at the script's limit") {
  const std::string script =
      "path = \"\"\nfor (i in range(3000)) { path += \"M\" + i + \" 0h9000v9000h-9000z\" }\n"
      "while (true) { a = svg(path) }\nScene {}";
  ScriptOptions options;
  options.limits.steps = 3'000'000;
  CHECK(run(script, options).failed_with(ErrorCode::limit));
}

TEST_CASE("Text is letters drawn out along z") {
  const auto spans = [](const std::string& attributes, double y) {
    ScriptOptions options;
    options.resource_directories = {CRT_SOURCE_DIR "/share/fonts"};
    const Run done = run("Scene { Text { depth -> 2 " + attributes + " } }", options);
    INFO(attributes);
    REQUIRE(done.ok());
    CHECK(done.messages().empty());
    std::vector<double> places;
    for (const Hit& hit : crossings(prepare(*done.result.scene),
                                    {.origin = {-10000, y, 1.5}, .direction = {1, 0, 0}})) {
      places.push_back(hit.t - 10000);
    }
    return places;
  };
  // In 2048ths of the em: an I is from 189 to 380, of 569, and 1409 high.
  const std::vector<double> letter = spans("text -> \"I\" size -> 2048", 700);
  REQUIRE(letter.size() == 2);
  CHECK(letter[0] == doctest::Approx(189));
  CHECK(letter[1] == doctest::Approx(380));
  CHECK(spans("text -> \"I\" size -> 2048", 1408).size() == 2);
  CHECK(spans("text -> \"I\" size -> 2048", 1410).empty());
  CHECK(spans("text -> \"I\" size -> 2048 alignment -> \"right\"", 700)[0] ==
        doctest::Approx(189 - 569));
  CHECK(spans("text -> \"I\\nH\" size -> 2048 linespacing -> 2", 300 - 2 * 2355).size() == 4);
  CHECK(spans("text -> \"I\" font -> \"/LiberationSans-Regular.ttf\"", 0.5).size() == 2);
}

TEST_CASE("Text that cannot be is an error, and text with nothing to see a warning") {
  const auto message = [](const std::string& attributes) {
    const Run done = run("Scene { Text { " + attributes + " } }");
    REQUIRE(done.messages().size() == 1);
    return done.messages()[0];
  };
  CHECK(message("text -> \" \" depth -> 1") ==
        "'text' has nothing to see: what has no size draws nothing");
  CHECK(message("text -> \"a\" depth -> 0") == "'depth' is 0: what has no size draws nothing");
  CHECK(message("text -> \"\\u6f22a\\u5b57\\u6f22\" depth -> 1") ==
        "the font has no letter for 2 characters of 'text': U+6F22, U+5B57");
  CHECK(message("text -> \"a\" depth -> 1 size -> 0") ==
        "'size' must be in [1e-90, 1e90] (it is 0)");
  CHECK(message("text -> \"a\" depth -> 1 linespacing -> 1e5") ==
        "'linespacing' must be in [-1000, 1000] (it is 100000)");
  CHECK(message("text -> \"a\" depth -> 1 alignment -> \"middle\"")
            .find("'alignment' must be \"left\", \"center\" or \"right\"") == 0);
  CHECK(message("text -> \"a\" depth -> 1 font -> \"no.ttf\"") == "there is no file 'no.ttf'");
  CHECK(message("text -> \"a\" depth -> 1 font -> \"../../etc/passwd\"").find("lies outside") !=
        std::string::npos);
}
