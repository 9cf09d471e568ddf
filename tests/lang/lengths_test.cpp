// Numbers that a unit follows are lengths: so many scene units, by the unit of the Settings.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "run.hpp"

using namespace crt::test;

namespace {

const std::string millimetres = "Settings { unit -> \"mm\" }\n";

std::vector<std::string> printed(const std::string& text, crt::ScriptOptions options = {}) {
  const Run found = run_statements(text, std::move(options));
  CAPTURE(text);
  CHECK(found.messages().empty());
  return found.printed;
}

std::string first_message(const std::string& text, crt::ScriptOptions options = {}) {
  const Run found = run_statements(text, std::move(options));
  CAPTURE(text);
  REQUIRE(!found.result.diagnostics.empty());
  return found.result.diagnostics[0].message;
}

bool contains(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

}  // namespace

TEST_CASE("lengths are so many scene units, rounded once") {
  CHECK(printed(millimetres + "print(10mm, 2cm, 1.5m, 1in, .5in, 1e1mm)") ==
        std::vector<std::string>{"10 20 1500 25.4 12.7 10"});
  CHECK(printed("Settings { unit -> \"in\" }\nprint(25.4mm, 1in)") ==
        std::vector<std::string>{"1 1"});
  CHECK(printed("Settings { unit -> \"cm\" }\nprint(1mm, 3mm, 0.7m)") ==
        std::vector<std::string>{"0.1 0.3 70"});
  // A scene without a unit is in metres.
  CHECK(printed("print(10mm, 1m)") == std::vector<std::string>{"0.01 1"});
}

TEST_CASE("a length is a Float like any other") {
  CHECK(printed(millimetres +
                "a = -2cm + 3 * 1mm\nprint(a, 7cm / 1cm, 1cm == 10mm, vec3(1cm, 0, 0))") ==
        std::vector<std::string>{"-17 7 true vec3(10, 0, 0)"});
  CHECK(printed(millimetres + "for (i in range(2)) { print(i * 5mm) }") ==
        std::vector<std::string>{"0", "5"});
  CHECK(printed(millimetres + "side = Macro (n) { return n * 1cm }\nprint(side(3))") ==
        std::vector<std::string>{"30"});
}

TEST_CASE("the unit may stand behind the length, or come from the caller") {
  CHECK(printed("print(10mm)\nSettings { width -> 10 unit -> \"mm\" height -> 10 }") ==
        std::vector<std::string>{"10"});
  crt::ScriptOptions options;
  options.settings.emplace_back("unit", "\"cm\"");
  CHECK(printed("print(10mm)\n" + millimetres, options) == std::vector<std::string>{"1"});
  CHECK(printed("print(10mm)", options) == std::vector<std::string>{"1"});
  // What is so called elsewhere is not the scene's unit.
  CHECK(printed("unit = \"mm\"\nprint(10mm, unit)") == std::vector<std::string>{"0.01 mm"});
}

TEST_CASE("lengths of a unit that is computed are errors, at their places") {
  const std::string computed = "Settings { unit -> \"m\" + \"m\" }\n";
  CHECK(contains(first_message(computed + "print(1cm)"), "not known here"));
  const Run found = run_statements("a = 1\nprint(1cm)\n" + computed);
  CHECK(found.result.diagnostics.at(0).place.line == 2);
  CHECK(printed("print(1.5)\n" + computed) == std::vector<std::string>{"1.5"});
}

TEST_CASE("only units follow a number directly") {
  for (const char* wrong : {"10km", "10mmm", "1m2", "3x", "10MM"})
    CHECK(contains(first_message("a = " + std::string(wrong)), wrong));
  // The unit of a length must follow at once.
  CHECK(!run_statements(millimetres + "print(10 mm)").ok());
  crt::ScriptOptions old;
  old.compat = 2015;
  CHECK(contains(first_message("a = 10mm;", old), "neither a number nor a name"));
}
