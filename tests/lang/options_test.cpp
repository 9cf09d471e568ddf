// These tests check what the caller sets from outside: variables, settings, t.
#include <doctest/doctest.h>

#include "run.hpp"

namespace {

using crt::ErrorCode;
using crt::ScriptOptions;
using crt::test::run_statements;
using Strings = std::vector<std::string>;

ScriptOptions with_variables(std::vector<std::pair<std::string, std::string>> variables) {
  ScriptOptions options;
  options.variables = std::move(variables);
  return options;
}

ScriptOptions with_settings(std::vector<std::pair<std::string, std::string>> settings) {
  ScriptOptions options;
  options.settings = std::move(settings);
  return options;
}

}  // namespace

TEST_CASE("a name of the library in what is set from outside gets a hint") {
  const auto message = [](std::pair<std::string, std::string> variable) {
    const auto run = run_statements("a = 1\nprint(a)", with_variables({std::move(variable)}));
    REQUIRE_FALSE(run.ok());
    return run.result.diagnostics.front().message;
  };
  CHECK(
      message({"gold", "1"}) ==
      "the script sets no variable 'gold' at its top level; 'gold' is in \"crt/metals\", which it "
      "does not import");
  CHECK(
      message({"a", "red"}) ==
      "unknown name 'red'; 'red' is in \"crt/colors\", which is not imported yet: write its value");
}

TEST_CASE("a result says whether the script reads t") {
  const auto reads_time = [](const char* script) {
    return run_statements(script).result.reads_time;
  };
  CHECK(reads_time("print(t)"));
  CHECK(reads_time("f = Macro () { return t }\nprint(f())"));
  CHECK(reads_time("t = t / 25\nprint(t)"));
  CHECK_FALSE(reads_time("print(1)"));
  CHECK_FALSE(reads_time("t = 1\nprint(t)"));
  CHECK_FALSE(reads_time("f = Macro (t) { return t }\nprint(f(1))"));
  CHECK(run_statements("a = 1\nprint(a)", with_variables({{"a", "t"}})).result.reads_time);
}

TEST_CASE("a variable set from outside wins over the script's assignments at the top level") {
  const char* script = "n = 3\nn = n + 1\nif (true) { n = 7 }\nprint(n)";
  CHECK(run_statements(script).printed == Strings{"7"});
  CHECK(run_statements(script, with_variables({{"n", "18"}})).printed == Strings{"18"});
  CHECK(run_statements(script, with_variables({{"n", "2 * 3 + sin(0)"}})).printed == Strings{"6"});
  CHECK(run_statements(script, with_variables({{"n", "\"text\""}})).printed == Strings{"text"});
  CHECK(run_statements(script, with_variables({{"n", "1"}, {"n", "2"}})).printed == Strings{"2"});
}

TEST_CASE("what the script would have assigned is not evaluated") {
  CHECK(run_statements("n = 1 / 0\nprint(n)", with_variables({{"n", "5"}})).printed ==
        Strings{"5"});
}

TEST_CASE("macros have their own variables of that name") {
  const char* script =
      "n = 3\nf = Macro (n) { print(n) }\ng = Macro () { n = 9 print(n) }\nf(4)\ng()\nprint(n)";
  CHECK(run_statements(script, with_variables({{"n", "5"}})).printed == Strings{"4", "9", "5"});
}

TEST_CASE("a variable that the script never sets is an error, with the one that was meant") {
  const crt::test::Run result =
      run_statements("radius = 3\nf = Macro () { inner = 1 }", with_variables({{"raduis", "1"}}));
  REQUIRE(result.failed_with(ErrorCode::script));
  const crt::Diagnostic error = result.errors()[0];
  CHECK(error.message ==
        "the script sets no variable 'raduis' at its top level; did you mean 'radius'?");
  CHECK(error.place == crt::SourcePlace{"<set raduis>", 1, 1, 1});
  CHECK(run_statements("f = Macro () { inner = 1 }", with_variables({{"inner", "1"}}))
            .failed_with(ErrorCode::script));
}

TEST_CASE("a variable that only an import sets can be set from outside") {
  ScriptOptions options = with_variables({{"n", "5"}});
  options.open_file = [](const std::filesystem::path&) {
    const std::string text = "n = 1\n";
    const auto* begin = reinterpret_cast<const std::byte*>(text.data());
    return std::vector<std::byte>(begin, begin + text.size());
  };
  CHECK(run_statements("import \"other.crt\"\nprint(n)", options).printed == Strings{"5"});
}

TEST_CASE("errors in a value from outside stand in that value") {
  for (const auto& example : std::vector<std::pair<std::string, int>>{
           {"1 +", 4}, {"1 / 0", 3}, {"unknown", 1}, {"n", 1}, {"", 1}, {"1 2", 3}, {"\"a", 1}}) {
    const std::string& text = example.first;
    CAPTURE(text);
    const crt::test::Run result = run_statements("n = 1", with_variables({{"n", text}}));
    REQUIRE_FALSE(result.ok());
    CHECK(result.errors()[0].place.file == "<set n>");
    CHECK(result.errors()[0].place.line == 1);
    CHECK(result.errors()[0].place.column == example.second);
    CHECK(result.errors()[0].source_line == text);
  }
}

TEST_CASE("settings from outside win over the script's, and need none there") {
  const crt::test::Run result =
      run_statements("Settings { width -> 10 gamma -> 1.5 }",
                     with_settings({{"gamma", "2.2"}, {"height", "30"}, {"title", "\"outside\""}}));
  REQUIRE(result.ok());
  CHECK(result.result.scene->settings.width == 10);
  CHECK(result.result.scene->settings.height == 30);
  CHECK(result.result.scene->settings.gamma == 2.2);
  CHECK(result.result.scene->settings.title == "outside");
  CHECK(run_statements("", with_settings({{"width", "5"}})).result.scene->settings.width == 5);
  CHECK(run_statements("", with_settings({{"width", "5"}, {"width", "6"}}))
            .result.scene->settings.width == 6);
}

TEST_CASE("a script's setting that is overridden is not checked") {
  CHECK(run_statements("Settings { width -> -1 }", with_settings({{"width", "5"}})).ok());
}

TEST_CASE("wrong settings from outside are errors at their value") {
  const auto error = [](const std::string& name, const std::string& value) {
    const crt::test::Run result = run_statements("", with_settings({{name, value}}));
    REQUIRE(result.errors().size() == 1);
    CHECK(result.errors()[0].place.file == "<setting " + name + ">");
    return result.errors()[0].message;
  };
  CHECK(error("gama", "1") == "Settings has no attribute 'gama'; did you mean 'gamma'?");
  CHECK(error("width", "1.5") == "'width' must be an Integer, not a Float");
  CHECK(error("width", "0") == "'width' must be between 1 and 65536 (it is 0)");
  CHECK(error("projection", "\"round\"").find("'projection' must be \"pinhole\"") == 0);
}

TEST_CASE("t is the caller's") {
  ScriptOptions options;
  options.t = 2.5;
  CHECK(run_statements("print(t, t * 2)", options).printed == Strings{"2.5 5"});
}

TEST_CASE("each run starts anew: random numbers, imports and variables") {
  const char* script = "print(rand(), rand(0, 100))";
  CHECK(run_statements(script).printed == run_statements(script).printed);
  CHECK_FALSE(run_statements("a = 1").printed == run_statements("print(1)").printed);
  CHECK_FALSE(run_statements("print(a)").ok());
}
