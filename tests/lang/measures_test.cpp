// Scripts ask how much a solid is and where, and pay for it.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "run.hpp"

using crt::test::run_statements;

namespace {

const std::string plate =
    "hole = Cylinder { from -> vec3(1, 1, -1) to -> vec3(1, 1, 2) radius -> 0.5 }\n"
    "plate = Box { cornerA -> vec3(0, 0, 0) cornerB -> vec3(4, 2, 1) } - hole\n";

/// Returns what one expression prints.
std::string printed(const std::string& expression) {
  const auto run = run_statements(plate + "print(" + expression + ")\n");
  CAPTURE(expression);
  REQUIRE(run.printed.size() == 1);
  return run.printed[0];
}

/// Returns the messages of a script that ends with one expression.
std::string complaint(const std::string& expression) {
  const auto run = run_statements(plate + "x = " + expression + "\n");
  CAPTURE(expression);
  REQUIRE(!run.result.diagnostics.empty());
  return run.result.diagnostics[0].message;
}

bool contains(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

}  // namespace

TEST_CASE("volume() is that of the solid, to a millionth or as asked") {
  CHECK(printed("abs(volume(plate) - (8 - pi / 4)) < 8e-6") == "true");
  CHECK(printed("abs(volume(plate, 1e-9) - (8 - pi / 4)) < 8e-9") == "true");
  CHECK(printed("abs(volume(plate, 0.5) - (8 - pi / 4)) < 4") == "true");
  CHECK(printed("abs(volume(plate <scale 2>) / volume(plate) - 8) < 1e-4") == "true");
}

TEST_CASE("bounds() are the corners of the box around what is left") {
  CHECK(printed("len(bounds(plate))") == "2");
  CHECK(printed("length(bounds(plate)[0] - vec3(0, 0, 0)) < 1e-5") == "true");
  CHECK(printed("length(bounds(plate)[1] - vec3(4, 2, 1)) < 1e-5") == "true");
  const std::string left =
      "bounds(plate - Box { cornerA -> vec3(3, -1, -1) cornerB -> vec3(9, 9, 9) })[1]";
  CHECK(printed("length(" + left + " - vec3(3, 2, 1)) < 1e-5") == "true");
}

TEST_CASE("contains() is true inside and on the surface") {
  CHECK(printed("contains(plate, vec3(3, 1, 0.5))") == "true");
  CHECK(printed("contains(plate, vec3(4, 1, 0.5))") == "true");
  CHECK(printed("contains(plate, vec3(1, 1, 0.5))") == "false");
  CHECK(printed("contains(plate, vec3(5, 1, 0.5))") == "false");
}

TEST_CASE("area() and centroid() are those of the solid") {
  CHECK(printed("abs(area(plate) - (28 + pi / 2)) < 3e-3") == "true");
  CHECK(printed("abs(area(plate, 1e-5) - (28 + pi / 2)) < 3e-4") == "true");
  const std::string x = "(8 * 2 - pi / 4) / (8 - pi / 4)";
  CHECK(printed("length(centroid(plate) - vec3(" + x + ", 1, 0.5)) < 4e-4") == "true");
  CHECK(printed("length(centroid(plate, 1e-6) - vec3(" + x + ", 1, 0.5)) < 4e-6") == "true");
}

TEST_CASE("distance() of a point is below 0 inside, and 0 on the surface") {
  CHECK(printed("abs(distance(plate, vec3(3, 1, 4)) - 3) < 3e-6") == "true");
  CHECK(printed("abs(distance(plate, vec3(7, 6, 0.5)) - 5) < 5e-6") == "true");
  CHECK(printed("abs(distance(plate, vec3(3, 1, 0.25)) + 0.25) < 1e-6") == "true");
  CHECK(printed("abs(distance(plate, vec3(1, 1, 0.5)) - 0.5) < 1e-4") == "true");
  CHECK(printed("distance(plate, vec3(4, 1, 0.5))") == "0");
}

TEST_CASE("distance() of two solids is that between them, and 0 where they touch or overlap") {
  const std::string ball = "Sphere { center -> vec3(8, 1, 0.5) radius -> 1 }";
  CHECK(printed("abs(distance(plate, " + ball + ") - 3) < 6e-4") == "true");
  CHECK(printed("distance(plate, plate <translate vec3(4, 0, 0)>)") == "0");
  CHECK(printed("distance(plate, plate <translate vec3(1, 1, 0)>)") == "0");
  // Between a shaft and its bore all places are about equally near.
  const std::string pin = "Cylinder { from -> vec3(1, 1, -1) to -> vec3(1, 1, 2) radius -> 0.4 }";
  CHECK(contains(complaint("distance(plate, " + pin + ")"), "more than"));
}

TEST_CASE("thickness() is that of the thinnest wall, or of what is between two points") {
  CHECK(printed("abs(thickness(plate) - 0.5) < 5e-3") == "true");
  CHECK(printed("abs(thickness(plate, 1e-4) - 0.5) < 5e-5") == "true");
  CHECK(printed("abs(thickness(plate, vec3(-1, 1, 0.5), vec3(9, 1, 0.5)) - 3) < 1e-9") == "true");
  CHECK(printed("abs(thickness(plate, vec3(3, 1, 0.5), vec3(9, 1, 0.5)) - 1) < 1e-9") == "true");
  CHECK(printed("abs(thickness(plate, vec3(3, 1, 0.5), vec3(2, 1, 0.5)) - 1) < 1e-9") == "true");
  CHECK(printed("thickness(plate, vec3(1, 1, -1), vec3(1, 1, 2))") == "0");
  CHECK(contains(complaint("thickness(plate, vec3(2, 1, 1), vec3(9, 1, 1))"),
                 "the way goes along the surface"));
  CHECK(contains(complaint("thickness(plate, vec3(2, 1, 1), vec3(2, 1, 1))"), "another point"));
  CHECK(contains(complaint("thickness(plate, vec3(2, 1, 1))"), "takes a number here"));
  const std::string corner =
      "thickness(Box { cornerA -> vec3(0, 0, 0) cornerB -> vec3(1, 1, 1) } "
      "^ Plane { normal -> vec3(1, 1, 1) position -> vec3(0.5, 0, 0) })";
  CHECK(contains(complaint(corner), "no two sides of it are parallel"));
}

TEST_CASE("what cannot be measured is an error at the argument that says why") {
  CHECK(contains(complaint("volume(3)"), "volume(entity, relativewidth) takes an entity here"));
  CHECK(contains(complaint("volume(plate, 0)"), "must be from 1e-9 to 1"));
  CHECK(contains(complaint("volume(plate, \"fine\")"), "takes a number here"));
  CHECK(contains(complaint("contains(plate, 3)"), "takes a Vec3 here"));
  const std::string disc = "Disc { center -> vec3(0, 0, 0) normal -> vec3(0, 1, 0) radius -> 1 }";
  CHECK(contains(complaint("volume(" + disc + ")"), "volume: only a solid can be measured"));
  CHECK(contains(complaint("contains(" + disc + ", vec3(0, 0, 0))"), "only a solid"));
  const std::string half = "Plane { normal -> vec3(0, 1, 0) position -> vec3(0, 0, 0) }";
  CHECK(contains(complaint("volume(" + half + ")"), "infinite"));
  CHECK(contains(complaint("bounds(" + half + ")"), "there is no box around it"));
  CHECK(contains(complaint("bounds(plate - plate)"), "it is empty"));
  CHECK(contains(complaint("area(" + half + ")"), "area: the solid has no box around it"));
  CHECK(contains(complaint("centroid(plate - plate)"), "nothing proves that it has a volume"));
  CHECK(contains(complaint("distance(plate - plate, vec3(0, 0, 0))"), "a solid without points"));
  CHECK(contains(complaint("distance(plate, plate - plate)"), "a solid without points"));
  CHECK(contains(complaint("distance(plate, " + half + ")"), "distance: the solid has no box"));
  CHECK(contains(complaint("distance(plate, 3)"), "takes a Vec3 or an entity here"));
}

TEST_CASE("measuring is paid for in steps, the same on every run") {
  for (const char* question :
       {"volume(plate, 1e-9)", "area(plate)", "centroid(plate)", "bounds(plate)",
        "contains(plate, vec3(1, 1, 1))", "distance(plate, vec3(3, 1, 4))",
        "distance(plate, hole <translate vec3(4, 0, 0)>)", "thickness(plate)",
        "thickness(plate, vec3(-1, 1, 0.5), vec3(9, 1, 0.5))"}) {
    CAPTURE(question);
    const std::string script =
        plate + "for (i in range(100000)) { x = " + std::string(question) + " }\n";
    crt::ScriptOptions options;
    options.limits.steps = 100'000;
    const auto first = run_statements(script, options);
    REQUIRE(!first.result.diagnostics.empty());
    CHECK(first.result.diagnostics[0].code == crt::ErrorCode::limit);
    const auto second = run_statements(script, options);
    CHECK(second.result.diagnostics[0].message == first.result.diagnostics[0].message);
  }
}

TEST_CASE("a search in a script ends by its steps, at the place of the call") {
  crt::ScriptOptions options;
  options.limits.steps = 1'000'000;
  const std::string ring =
      "ring = Torus { center -> vec3(0, 0, 0) axis -> vec3(1, 2, 3) radius -> 2 "
      "thickness -> 0.5 }\n";
  for (const std::string question :
       {"area(ring, 1e-9)", "centroid(ring, 1e-9)", "distance(ring, vec3(0, 0, 0), 1e-9)",
        "thickness(ring)", "distance(ring, ring <scale 0.5>, 1e-9)"}) {
    CAPTURE(question);
    const auto run = run_statements(ring + "x = " + question + "\n", options);
    REQUIRE(!run.result.diagnostics.empty());
    CHECK(run.result.diagnostics[0].code == crt::ErrorCode::limit);
    CHECK(run.result.diagnostics[0].place.line == 2);
  }
}

TEST_CASE("a script can be ended while it measures") {
  crt::ScriptOptions options;
  int asked = 0;
  options.go_on = [&] { return ++asked < 3; };
  const auto run = run_statements(
      plate +
          "x = volume(Torus { center -> vec3(0, 0, 0) axis -> vec3(1, 2, 3) radius -> 2 "
          "thickness -> 0.5 } - plate, 1e-9)\n",
      options);
  REQUIRE(!run.result.diagnostics.empty());
  CHECK(run.result.diagnostics[0].code == crt::ErrorCode::cancelled);
}
