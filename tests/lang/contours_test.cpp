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
