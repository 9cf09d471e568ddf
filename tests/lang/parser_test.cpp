// These tests check the parser alone: what parses, how deep it goes, and how it recovers.
#include "lang/parser.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <string>
#include <vector>

namespace {

using crt::lang::TextKind;

struct Parsed {
  std::size_t statements = 0;
  std::vector<std::string> errors;
  bool gave_up = false;
};

Parsed parse(const std::string& text, std::size_t most_errors = 20) {
  crt::lang::SourceMap sources;
  crt::lang::SymbolTable symbols;
  crt::lang::Reporter reporter(sources, most_errors);
  std::size_t memory = std::numeric_limits<std::size_t>::max();
  Parsed result;
  try {
    const crt::lang::Script script =
        crt::lang::parse(sources.add("test", text), TextKind::script, 0, symbols, reporter, memory);
    result.statements = script.statements.statements.size();
  } catch (const crt::lang::GiveUp&) {
    result.gave_up = true;
  }
  for (const crt::Diagnostic& diagnostic : reporter.diagnostics())
    result.errors.push_back(diagnostic.message);
  return result;
}

std::string repeated(const std::string& piece, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += piece;
  return text;
}

constexpr int a_million = 1'000'000;

}  // namespace

TEST_CASE("listing 2.1 of the thesis parses as it stands") {
  const Parsed result = parse(R"(--Entities----
sphere1 = Sphere {
    center -> vec3(0, 0.5, 0)
    radius -> 0.5
}

-- Constants
n = 18
max = (3 * n) / 4 + 5

--Macros---
myMacro = Macro (arg1) {
    i = 0
    -- Draw sphere1 "max" times on the x axis
    while (i < max) {
        sphere1 <translate vec3(i*1.0, 0.0, 0.0)>
        i = i - 1
    }
}
)");
  CHECK(result.errors.empty());
  CHECK(result.statements == 4);
}

TEST_CASE("nesting of every kind ends in an ordinary error, however deep") {
  const std::vector<std::string> openings = {"(",
                                             "[",
                                             "! ",
                                             "- ",
                                             "a = ",
                                             "a ? ",
                                             "a[",
                                             "f(",
                                             "S { b -> ",
                                             "Macro () { ",
                                             "if (true) { ",
                                             "while (true) { ",
                                             "for (i in [1]) { ",
                                             "a <scale ",
                                             "a ? b : ",
                                             "if (true) { } else { "};
  for (const std::string& opening : openings) {
    CAPTURE(opening);
    const Parsed result = parse("x = 1\n" + repeated(opening, a_million / 10));
    CHECK(result.gave_up);
    REQUIRE(result.errors.size() == 1);
    CHECK(result.errors[0].find("nested more than 200 levels") == 0);
  }
}

TEST_CASE("a million brackets that are closed again are too deep, too") {
  const Parsed result = parse("x = " + repeated("(", a_million) + "1" + repeated(")", a_million));
  CHECK(result.gave_up);
  CHECK(result.errors.size() == 1);
}

TEST_CASE("suffixes nest: a chain of them is bounded") {
  for (const char* suffix : {"[0]", "()", " <scale 2>"}) {
    CHECK(parse("x = a" + repeated(suffix, 190)).errors.empty());
    CHECK(parse("x = a" + repeated(suffix, 1000)).gave_up);
  }
}

TEST_CASE("nesting just below the limit parses") {
  CHECK(parse("x = " + repeated("(", 190) + "1" + repeated(")", 190)).errors.empty());
  CHECK(parse("x = " + repeated("[", 190) + repeated("]", 190)).errors.empty());
}

TEST_CASE("chains to the left and long lists do not nest") {
  constexpr int many = 100'000;
  for (const char* op : {"+", "-", "*", "/", "%", "^", "<", ">=", "==", "&&", "||"}) {
    const Parsed result = parse("x = a" + repeated(std::string(" ") + op + " a", many));
    CHECK(result.errors.empty());
    CHECK(result.statements == 1);
  }
  CHECK(parse("x = [" + repeated("1, ", many) + "]").errors.empty());
  CHECK(parse(repeated("x = 1\n", many)).statements == many);
  CHECK(parse("if (a) { } " + repeated("else if (a) { } ", many)).statements == 1);
  CHECK(parse("S { " + repeated("a -> 1 ", many) + "}").errors.empty());
}

TEST_CASE("several syntax errors are reported in one run, one a line") {
  CHECK(parse("a = ) \n b = 2 \n c = ] ] ] \n d = (\n").errors.size() == 3);
  CHECK(parse("a = (1 + )\nb = [,]\nScene { x = * }\n").errors.size() == 3);
}

TEST_CASE("the parser gives up after as many errors as the caller wants") {
  const Parsed result = parse(repeated("a = )\n", 1000), 5);
  CHECK(result.gave_up);
  CHECK(result.errors.size() == 5);
}

TEST_CASE("what follows an error in braces is parsed as before") {
  const Parsed result = parse("Scene {\n a = +\n b = 1\n}\nc = 2\n");
  CHECK(result.errors.size() == 1);
  CHECK(result.statements == 2);
}

TEST_CASE("a tree larger than its memory is an ordinary error") {
  crt::lang::SourceMap sources;
  crt::lang::SymbolTable symbols;
  crt::lang::Reporter reporter(sources, 20);
  std::size_t memory = 10'000;
  const std::string text = repeated("a ", 10'000);
  CHECK_THROWS_AS(
      crt::lang::parse(sources.add("test", text), TextKind::script, 0, symbols, reporter, memory),
      crt::lang::GiveUp);
  REQUIRE(reporter.diagnostics().size() == 1);
  CHECK(reporter.diagnostics()[0].code == crt::ErrorCode::limit);
}
