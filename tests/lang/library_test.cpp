// These tests check the scripts that come with CRT.
#include "lang/library.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "crt/measure.hpp"
#include "run.hpp"

namespace {

/// Returns the names that a script of the library sets.
std::vector<std::string> names_in(std::string_view text) {
  std::vector<std::string> names;
  const std::string all(text);
  const std::regex assignment("(?:^|\\n)(\\w+) =");
  for (std::sregex_iterator found(all.begin(), all.end(), assignment), end; found != end; ++found)
    names.push_back((*found)[1]);
  return names;
}

/// Returns the reference with a blank for each line end.
std::string reference() {
  std::ifstream file(std::filesystem::path(CRT_SOURCE_DIR) / "docs" / "language.md");
  std::string text;
  for (std::string word; file >> word;) text += word + ' ';
  return text;
}

}  // namespace

TEST_CASE("every script of the library runs, and all together set each name once") {
  std::map<std::string, std::string> origin;
  CHECK(crt::lang::library().size() >= 4);
  for (const crt::lang::LibraryScript& script : crt::lang::library()) {
    CAPTURE(script.name);
    const std::vector<std::string> names = names_in(script.text);
    CHECK(names.size() >= 2);
    std::string text = fmt::format("import \"crt/{}\"\n", script.name);
    for (const std::string& name : names) {
      CHECK_MESSAGE(origin.emplace(name, script.name).second, name);
      text += fmt::format("print({})\n", name);
    }
    const crt::test::Run run = crt::test::run_statements(text);
    CHECK(run.result.diagnostics.empty());
    CHECK(run.printed.size() == names.size());
  }
}

TEST_CASE("arrays have their copies where they are said to be") {
  const crt::test::Run run = crt::test::run_statements(R"(
    import "crt/arrays"
    dot = Box { cornerA -> vec3(1, -1, -1) / 64 + vec3(2, 0, 0) cornerB -> vec3(2, 0, 0) }
    places = Macro (group, points) { return [contains(group, p) for p in points] }
    print(places(rowOf(dot, 3, vec3(1, 0, 0)), [vec3(x + 1 / 128.0, -1 / 128.0, -1 / 128.0)
                                                for x in [1, 2, 3, 4, 5]]))
    half = vec3(1, -1, -1) / 128
    print(places(gridOf(dot, [2, 1, 3], [4, 1, 2]), [vec3(x, 0, z) + half
                                                     for z in [0, 2, 4, 6] for x in [2, 6]]))
    ball = Sphere { center -> vec3(2, 0, 0) radius -> 0.1 }
    print(places(ringOf(ball, 4), [vec3(0, 0, 2), vec3(-2, 0, 0), vec3(0, 0, -2), vec3(0, 2, 0)]))
    print(places(ringOf(ball, 3, axis -> vec3(0, 0, 1), about -> vec3(1, 0, 0), angle -> 180),
                 [vec3(2, 0, 0), vec3(1, 1, 0), vec3(0, 0, 0), vec3(1, -1, 0)]))
    print(places(mirrored(ball, about -> vec3(1, 0, 0)), [vec3(2, 0, 0), vec3(0, 0, 0)]))
    rowOf(ball, 0, vec3(1, 0, 0)))");
  CHECK(run.printed ==
        std::vector<std::string>{"[false, true, true, true, false]",
                                 "[true, true, true, true, true, true, false, false]",
                                 "[true, true, true, false]", "[true, true, true, false]",
                                 "[true, true]"});
  REQUIRE(run.result.diagnostics.size() == 1);
  CHECK(run.result.diagnostics[0].message.find("a row has at least one copy, not 0") !=
        std::string::npos);
}

TEST_CASE("the reference lists the library: each script with all of its names") {
  const std::string text = reference();
  for (const crt::lang::LibraryScript& script : crt::lang::library()) {
    std::string entry = fmt::format("**`\"crt/{}\"`**: ", script.name);
    for (const std::string& name : names_in(script.text)) entry += fmt::format("`{}` ", name);
    entry.back() = '.';
    CHECK_MESSAGE(text.find(entry) != std::string::npos, entry);
  }
}

TEST_CASE("the library is found without a file, and no file takes its place") {
  crt::ScriptOptions options;
  std::size_t asked = 0;
  options.open_file = [&](const std::filesystem::path&) {
    ++asked;
    return std::vector<std::byte>();
  };
  options.resource_directories = {"/"};
  options.allow_outside_files = true;
  CHECK(crt::test::run("import \"crt/metals\" Scene { } print(gold)", options).printed ==
        std::vector<std::string>{"<Material>"});
  CHECK_FALSE(crt::test::run("import \"crt/no\" Scene { }", options).ok());
  CHECK_FALSE(crt::test::run("import \"crt/../../etc/passwd\" Scene { }", options).ok());
  CHECK(asked == 0);
}

TEST_CASE("materials of the library weigh what they are of, also when they are varied") {
  const auto density_of = [](const std::string& material) {
    std::string script;
    for (const char* name : {"metals", "glass", "woods", "materials"})
      script += fmt::format("import \"crt/{}\"\n", name);
    script += fmt::format(
        "Scene {{ Sphere {{ center -> vec3(0, 0, 0) radius -> 1 material -> {} }} }}", material);
    const crt::test::Run run = crt::test::run(script);
    REQUIRE(run.ok());
    return crt::density(run.result.scene->entities[0]);
  };
  CHECK(density_of("steel") == 7850);
  CHECK(density_of("glass") == 2500);
  CHECK(density_of("oak") == 762);
  CHECK(density_of("satinGold { color -> rgb(1, 0, 0) }") == density_of("gold"));
  CHECK(density_of("chrome") == 0);
}

TEST_CASE("the library counts as text of the script") {
  crt::ScriptOptions options;
  options.limits.source_bytes = 1000;
  CHECK(crt::test::run("import \"crt/metals\" Scene { }", options)
            .failed_with(crt::ErrorCode::limit));
}

TEST_CASE("a script may set a name of the library anew, also from outside") {
  crt::ScriptOptions options;
  CHECK(crt::test::run("import \"crt/colors\" red = 3 print(red) Scene { }").printed ==
        std::vector<std::string>{"3"});
  options.variables = {{"red", "4"}};
  CHECK(crt::test::run("import \"crt/colors\" print(red) Scene { }", options).printed ==
        std::vector<std::string>{"4"});
}
