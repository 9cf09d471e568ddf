// Runs each script of corpus/good, corpus/bad and scripts_2015 and compares what it does with what
// its comments say: a line each, in this order.
//   -- prints: a line that `print` gave
//   -- error 3:9: the message         (or warning; the file goes before the line if it is another)
//   -- in macro 5:3                   a call that the error above lies in, innermost first
//   -- and 252 calls more             where there are over four
//   -- entities: 4                    of the scene, if there was no error
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "crt/script.hpp"
#include "lang/objects.hpp"

namespace {

namespace fs = std::filesystem;

const fs::path tests = fs::path(CRT_SOURCE_DIR) / "tests" / "lang";

std::vector<fs::path> scripts_in(const char* folder) {
  std::vector<fs::path> scripts;
  for (const fs::directory_entry& entry : fs::directory_iterator(tests / folder)) {
    if (entry.path().extension() == ".crt") scripts.push_back(entry.path());
  }
  std::sort(scripts.begin(), scripts.end());
  return scripts;
}

/// Lists the names of all objects as messages do.
std::string all_objects() {
  std::string list;
  const std::span<const crt::lang::ObjectType> types = crt::lang::object_types();
  for (const crt::lang::ObjectType& type : types)
    list += (list.empty() ? "" : &type == &types.back() ? " and " : ", ") + std::string(type.name);
  return list;
}

std::vector<std::string> expectations(const fs::path& script) {
  std::vector<std::string> lines;
  std::ifstream file(script, std::ios::binary);
  for (std::string line; std::getline(file, line);) {
    // A list of all objects grows with them.
    if (const std::size_t list = line.find("{objects}"); list != std::string::npos)
      line.replace(list, std::string("{objects}").size(), all_objects());
    for (const char* kind :
         {"-- prints: ", "-- error ", "-- warning ", "-- in ", "-- and ", "-- entities: "}) {
      if (line.starts_with(kind)) lines.push_back(line);
    }
  }
  return lines;
}

/// Makes paths in messages, which are as the script was called, relative to its folder.
std::string without_folder(std::string text, const fs::path& folder) {
  const std::string prefix = folder.string() + "/";
  for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix, at))
    text.erase(at, prefix.size());
  return text;
}

void describe(const crt::Diagnostic& diagnostic, const fs::path& script,
              std::vector<std::string>& lines) {
  constexpr std::size_t max_calls = 4;
  const crt::SourcePlace& place = diagnostic.place;
  const std::string file =
      place.file == script.string() ? "" : without_folder(place.file, script.parent_path()) + ":";
  lines.push_back(fmt::format(
      "-- {} {}{}:{}: {}", diagnostic.severity == crt::Severity::error ? "error" : "warning", file,
      place.line, place.column, without_folder(diagnostic.message, script.parent_path())));
  for (std::size_t i = 0; i < std::min(diagnostic.calls.size(), max_calls); ++i) {
    const auto& [name, call] = diagnostic.calls[i];
    lines.push_back(fmt::format("-- in {} {}:{}", name, call.line, call.column));
  }
  if (diagnostic.calls.size() > max_calls)
    lines.push_back(fmt::format("-- and {} calls more", diagnostic.calls.size() - max_calls));
}

std::vector<std::string> run(const fs::path& script) {
  std::vector<std::string> lines;
  crt::ScriptOptions options;
  options.print = [&lines](std::string_view line) {
    lines.push_back(fmt::format("-- prints: {}", line));
  };
  const crt::ScriptResult result = crt::run_script_file(script, options);
  for (const crt::Diagnostic& diagnostic : result.diagnostics) describe(diagnostic, script, lines);
  if (result.scene) lines.push_back(fmt::format("-- entities: {}", result.scene->entities.size()));
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

/// Checks a script, which states in comments what it must do.
void check(const fs::path& script) {
  const std::vector<std::string> expected = expectations(script);
  CAPTURE(script.filename().string());
  REQUIRE_FALSE(expected.empty());
  CHECK(joined(run(script)) == joined(expected));
}

bool has_error(const std::vector<std::string>& lines) {
  return std::any_of(lines.begin(), lines.end(),
                     [](const std::string& line) { return line.starts_with("-- error "); });
}

}  // namespace

TEST_CASE("good scripts do what their comments say") {
  const std::vector<fs::path> scripts = scripts_in("corpus/good");
  CHECK(scripts.size() >= 60);
  for (const fs::path& script : scripts) {
    check(script);
    CHECK_FALSE(has_error(expectations(script)));
  }
}

TEST_CASE("bad scripts give the errors that their comments say, at their places") {
  const std::vector<fs::path> scripts = scripts_in("corpus/bad");
  CHECK(scripts.size() >= 90);
  for (const fs::path& script : scripts) {
    check(script);
    CHECK(has_error(expectations(script)));
  }
}

TEST_CASE("scripts of 2015 do what their comments say, without an error") {
  const std::vector<fs::path> scripts = scripts_in("scripts_2015");
  CHECK(scripts.size() >= 12);
  for (const fs::path& script : scripts) {
    check(script);
    CHECK_FALSE(has_error(expectations(script)));
  }
}

TEST_CASE("a script does the same every time") {
  for (const char* folder : {"corpus/good", "corpus/bad", "scripts_2015"}) {
    for (const fs::path& script : scripts_in(folder)) {
      if (script.stem().string().starts_with("endless")) continue;  // only to save time
      CHECK(run(script) == run(script));
    }
  }
}
