// These tests check how diagnostics look.
#include <doctest/doctest.h>

#include "lang/suggestion.hpp"
#include "lang/utf8.hpp"
#include "run.hpp"

namespace {

using crt::test::run_statements;

std::string formatted(const std::string& text) {
  const crt::test::Run result = run_statements(text);
  REQUIRE_FALSE(result.result.diagnostics.empty());
  return crt::format_diagnostic(result.result.diagnostics[0]);
}

}  // namespace

TEST_CASE("a diagnostic shows its line, and a caret under its place") {
  CHECK(formatted("a = 1\nb = a + true\n") ==
        "test.crt:2:7: error: '+' does not take an Integer and a Boolean\n"
        "  b = a + true\n"
        "        ^\n");
  CHECK(formatted("print(raduis)") ==
        "test.crt:1:7: error: unknown name 'raduis'\n"
        "  print(raduis)\n"
        "        ^~~~~~\n");
}

TEST_CASE("the caret counts characters, not bytes, and keeps tabs") {
  CHECK(formatted("\tprint(\"äöü€😀\", wrong)") ==
        "test.crt:1:17: error: unknown name 'wrong'\n"
        "  \tprint(\"äöü€😀\", wrong)\n"
        "  \t               ^~~~~\n");
}

TEST_CASE("windows line ends are not part of the line") {
  CHECK(formatted("a = 1\r\nb = c\r\n") ==
        "test.crt:2:5: error: unknown name 'c'\n"
        "  b = c\n"
        "      ^\n");
}

TEST_CASE("of a long line only the part around the place is shown") {
  const std::string before(500, ' ');
  const std::string text = formatted("a = " + before + "wrong" + before + " + 1");
  CHECK(text.find("test.crt:1:505: error") == 0);
  CHECK(text.size() < 500);
  const std::size_t line = text.find('\n') + 1;
  const std::size_t carets = text.find('\n', line) + 1;
  CHECK(text.substr(carets).find("^~~~~") == text.substr(line).find("wrong"));
}

TEST_CASE("the calls are listed, innermost first, and not endlessly") {
  CHECK(formatted("f = Macro (x) { y = 1 / x }\ng = Macro (x) { f(x) }\ng(0)") ==
        "test.crt:1:23: error: division by zero\n"
        "  f = Macro (x) { y = 1 / x }\n"
        "                        ^\n"
        "  in 'f', called at test.crt:2:17\n"
        "  in 'g', called at test.crt:3:1\n");
  CHECK(formatted("f = Macro (n) { f(n) }\nf(0)").find("  and 246 calls more\n") !=
        std::string::npos);
}

TEST_CASE("what could upset a terminal is not shown") {
  const std::string text = formatted("print(\"\x1b[31m\x07\xff\", wrong)");
  CHECK(text.find('\x1b') == std::string::npos);
  CHECK(text.find('\x07') == std::string::npos);
  CHECK(text.find('\xff') == std::string::npos);
}

TEST_CASE("diagnostics as JSON") {
  CHECK(crt::diagnostics_to_json({}) == "[]\n");
  const crt::test::Run result = run_statements("f = Macro () { \"tab\\t\" - 1 }\nf()");
  CHECK(crt::diagnostics_to_json(result.result.diagnostics) ==
        "[\n"
        " {\"severity\": \"error\", \"code\": \"script\", "
        "\"message\": \"'-' does not take a String and an Integer\", "
        "\"file\": \"test.crt\", \"line\": 1, \"column\": 24, \"length\": 1, "
        "\"source\": \"f = Macro () { \\\"tab\\\\t\\\" - 1 }\", "
        "\"calls\": [{\"name\": \"f\", \"file\": \"test.crt\", \"line\": 2, \"column\": 1, "
        "\"length\": 3}]}\n"
        "]\n");
}

TEST_CASE("JSON has no byte that JSON does not allow") {
  const crt::test::Run result =
      run_statements("print(\"\x01\xc3\x28\", 1 / 0)\nprint(\"\t\", wrong)");
  const std::string json = crt::diagnostics_to_json(result.result.diagnostics);
  for (const char c : json) CHECK((static_cast<unsigned char>(c) >= 0x20 || c == '\n'));
  for (std::size_t position = 0; position < json.size();)
    CHECK(crt::lang::decode_utf8(json, position).has_value());
}

TEST_CASE("errors carry the kind of what went wrong") {
  const auto code = [](const std::string& text) {
    return run_statements(text).errors().at(0).code;
  };
  CHECK(code("a = ") == crt::ErrorCode::script);
  CHECK(code("a = 1 + true") == crt::ErrorCode::script);
  CHECK(code("s = Sphere { center -> vec3(0, 0, 0) radius -> -1 }") ==
        crt::ErrorCode::invalid_argument);
  CHECK(code("import \"nowhere.crt\"") == crt::ErrorCode::io);
  CHECK(code("a = range(1e12)") == crt::ErrorCode::limit);
}

TEST_CASE("suggestions are what a typist may have meant, and nothing far") {
  using crt::lang::nearest;
  const std::vector<std::string_view> names = {"radius", "center", "reflectivity", "a"};
  CHECK(nearest("raduis", names) == "radius");
  CHECK(nearest("Radius", names) == "radius");
  CHECK(nearest("centre", names) == "center");
  CHECK(nearest("reflectvity", names) == "reflectivity");
  CHECK(nearest("weight", names).empty());
  CHECK(nearest("b", names).empty());
  CHECK(nearest("A", names) == "a");
  CHECK(nearest(std::string(10000, 'r'), names).empty());
}
