// docs/language.md is true: its examples run, and its tables are those of the code.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "crt/image.hpp"
#include "lang/builtins.hpp"
#include "lang/objects.hpp"
#include "lang/settings.hpp"
#include "reference_tables.hpp"
#include "run.hpp"

namespace {

namespace fs = std::filesystem;

std::vector<std::string> reference_lines() {
  std::ifstream file(fs::path(CRT_SOURCE_DIR) / "docs" / "language.md");
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  REQUIRE_FALSE(lines.empty());
  return lines;
}

/// Returns the examples: what stands between ```crt and ```.
std::vector<std::string> examples() {
  std::vector<std::string> result;
  bool inside = false;
  for (const std::string& line : reference_lines()) {
    if (line == "```crt") {
      inside = true;
      result.emplace_back();
    } else if (line == "```") {
      inside = false;
    } else if (inside) {
      result.back() += line + '\n';
    }
  }
  return result;
}

/// Returns a picture of one pixel as a PNG file.
std::vector<std::byte> png() {
  const fs::path file = fs::temp_directory_path() / fmt::format("crt_reference_{}.png", getpid());
  crt::Image(1, 1).write(file);
  std::ifstream stream(file, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(stream)),
                         std::istreambuf_iterator<char>());
  fs::remove(file);
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return std::vector<std::byte>(begin, begin + text.size());
}

}  // namespace

TEST_CASE("every example of the reference runs without error or warning") {
  crt::ScriptOptions options;
  options.open_file = [content = png()](const fs::path& path) {
    if (path.extension() != ".obj") return content;
    const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const auto* begin = reinterpret_cast<const std::byte*>(mesh.data());
    return std::vector<std::byte>(begin, begin + mesh.size());
  };
  const std::vector<std::string> scripts = examples();
  CHECK(scripts.size() > 20);
  for (const std::string& script : scripts) {
    const bool has_scene = script.find("Scene {") != std::string::npos;
    const crt::test::Run result = crt::test::run(script + (has_scene ? "" : "Scene { }"), options);
    for (const crt::Diagnostic& diagnostic : result.result.diagnostics) {
      CAPTURE(script);
      FAIL_CHECK(crt::format_diagnostic(diagnostic));
    }
  }
}

TEST_CASE("an example that is said to print something prints it") {
  const std::vector<std::string> lines = reference_lines();
  std::size_t checked = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i] != "prints" || lines[i + 2] != "```") continue;
    std::vector<std::string> expected;
    for (std::size_t j = i + 3; lines[j] != "```"; ++j) expected.push_back(lines[j]);
    std::string script;
    for (std::size_t j = i - 3; lines[j] != "```crt"; --j) script = lines[j] + '\n' + script;
    CHECK(crt::test::run_statements(script).printed == expected);
    ++checked;
  }
  CHECK(checked >= 1);
}

TEST_CASE("the reference's tables of attributes are those of the code, row by row") {
  const std::string page = fmt::format("{}\n", fmt::join(reference_lines(), "\n"));
  const auto shown = crt::test::with_attribute_tables(page);
  CHECK_MESSAGE(shown == page, "run ./dev generate");
  std::vector<std::string> objects = {"Settings"};
  for (const crt::lang::ObjectType& type : crt::lang::object_types())
    objects.emplace_back(type.name);
  for (const std::string& name : objects) {
    CAPTURE(name);
    const std::size_t heading = page.find("# " + name + "\n");
    REQUIRE(heading != std::string::npos);
    const std::string section = page.substr(heading, page.find("\n#", heading) - heading);
    CHECK(section.find("\n| attribute | type | default | meaning and range |\n") !=
          std::string::npos);
  }
}

TEST_CASE("the parser's fuzzer knows the names of all objects and attributes") {
  std::ifstream file(fs::path(CRT_SOURCE_DIR) / "tests" / "fuzz" / "parser.dict");
  const std::string words((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  CHECK_MESSAGE(crt::test::with_object_words(words) == words, "run ./dev generate");
}

TEST_CASE("the reference lists every built-in by its name") {
  std::string table;
  for (const std::string& line : reference_lines()) {
    if (line.starts_with("| `")) table += crt::test::cells(line)[0] + '\n';
  }
  for (const crt::lang::Builtin& builtin : crt::lang::builtins()) {
    CAPTURE(builtin.name);
    CHECK(table.find(fmt::format("`{}(", builtin.name)) != std::string::npos);
  }
}

TEST_CASE("what the reference says a built-in's example is, it is") {
  std::size_t checked = 0;
  for (const std::string& line : reference_lines()) {
    if (!line.starts_with("| `")) continue;
    const std::vector<std::string> row = crt::test::cells(line);
    const std::size_t is = row.size() == 3 ? row[2].find("` is ") : std::string::npos;
    if (is == std::string::npos) continue;
    const std::string expression = row[2].substr(1, is - 1);
    const std::string value = row[2].substr(is + 5);
    if (value.find("pi") != std::string::npos) continue;  // a word, not a script's text
    CAPTURE(expression);
    // The tolerance allows for the error in the last digit of a sine.
    const std::string script = "x = " + expression + "\ny = " + value +
                               "\nok = x == y || (str(x) != \"\" && abs(x - y) < 1e-15)\nprint(ok)";
    CHECK(crt::test::run_statements(script).printed == std::vector<std::string>{"true"});
    ++checked;
  }
  CHECK(checked >= 12);
}
