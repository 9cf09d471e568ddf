// docs/language.md is true: its examples run, and its tables are those of the code.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "crt/image.hpp"
#include "lang/builtins.hpp"
#include "lang/objects.hpp"
#include "lang/settings.hpp"
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

/// Returns the cells of "| a | b \| c |", without the blanks around them.
std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result;
  std::string cell;
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i] != '|' || line[i - 1] == '\\') {
      cell += line[i];
      continue;
    }
    const std::size_t begin = cell.find_first_not_of(' ');
    const std::size_t end = cell.find_last_not_of(' ');
    result.push_back(begin == std::string::npos ? "" : cell.substr(begin, end - begin + 1));
    cell.clear();
  }
  return result;
}

/// Returns the tables of attributes, by the heading they stand under: "name type default" for each
/// row.
std::map<std::string, std::vector<std::string>> attribute_tables() {
  std::map<std::string, std::vector<std::string>> tables;
  std::string heading;
  bool inside = false;
  for (const std::string& line : reference_lines()) {
    if (line.starts_with("#")) heading = line.substr(line.find(' ') + 1);
    if (line.starts_with("| attribute |")) {
      inside = true;
      tables[heading];
    } else if (!line.starts_with("|")) {
      inside = false;
    } else if (inside && !line.starts_with("| ---")) {
      const std::vector<std::string> row = cells(line);
      REQUIRE(row.size() == 4);
      tables[heading].push_back(row[0] + " " + row[1] + " " + row[2]);
    }
  }
  return tables;
}

std::vector<std::string> rows_of(const crt::lang::ObjectType& type) {
  std::vector<std::string> rows;
  for (const crt::lang::AttributeType& attribute : type.attributes) {
    const std::string default_text =
        attribute.required ? "required" : fmt::format("`{}`", attribute.default_text);
    rows.push_back(fmt::format("`{}` {} {}", attribute.name, attribute.type, default_text));
  }
  return rows;
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
  auto tables = attribute_tables();
  for (const crt::lang::ObjectType& type : crt::lang::object_types()) {
    CAPTURE(type.name);
    CHECK(tables[std::string(type.name)] == rows_of(type));
    tables.erase(std::string(type.name));
  }
  CHECK(tables["Settings"] == rows_of(crt::lang::settings_type()));
  tables.erase("Settings");
  CHECK(tables.empty());
}

TEST_CASE("the reference lists every built-in by its name") {
  std::string table;
  for (const std::string& line : reference_lines()) {
    if (line.starts_with("| `")) table += cells(line)[0] + '\n';
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
    const std::vector<std::string> row = cells(line);
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
