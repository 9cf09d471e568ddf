// These tests check that what is wrong with a script as it is typed is what is wrong when it runs.
#include <doctest/doctest.h>

#include <algorithm>
#include <crt/language_service.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

using namespace crt;
namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::vector<fs::path> scripts_in(const std::string& folder) {
  std::vector<fs::path> scripts;
  for (const auto& entry : fs::directory_iterator(std::string(CRT_SOURCE_DIR) + folder)) {
    if (entry.path().extension() == ".crt") scripts.push_back(entry.path());
  }
  return scripts;
}

/// Returns what a run says, or nothing if a limit ended it or the script is one to import. Pictures
/// and meshes are read only then.
std::vector<Diagnostic> said_by_run(const std::string& text, const std::string& name) {
  ScriptOptions options;
  options.limits.errors = 100;
  options.print = [](std::string_view) {};
  std::vector<Diagnostic> found = run_script(text, name, options).diagnostics;
  const bool is_other = std::any_of(found.begin(), found.end(), [](const Diagnostic& diagnostic) {
    return diagnostic.code == ErrorCode::limit || diagnostic.code == ErrorCode::io ||
           diagnostic.message.starts_with("cannot read") ||
           diagnostic.message == "the script has no Scene block";
  });
  return is_other ? std::vector<Diagnostic>() : found;
}

}  // namespace

TEST_CASE("a wrong script has the diagnostics of its run") {
  int compared = 0;
  for (const fs::path& path : scripts_in("/tests/lang/corpus/bad")) {
    const std::string text = text_of(path);
    const std::vector<Diagnostic> run = said_by_run(text, path.string());
    if (run.empty()) continue;
    CAPTURE(path.string());
    const std::vector<Diagnostic> typed = LanguageService(text, path.string()).diagnostics();
    REQUIRE(typed.size() == run.size());
    for (std::size_t i = 0; i < run.size(); ++i) {
      CHECK(typed[i].message == run[i].message);
      CHECK(typed[i].place == run[i].place);
    }
    ++compared;
  }
  CHECK(compared > 100);
}

TEST_CASE("a right script has no errors, whatever files it uses") {
  for (const char* folder : {"/tests/lang/corpus/good", "/examples/scenes"}) {
    for (const fs::path& path : scripts_in(folder)) {
      CAPTURE(path.string());
      for (const Diagnostic& found : LanguageService(text_of(path), path.string()).diagnostics()) {
        CAPTURE(found.message);
        CHECK(found.severity == Severity::warning);
      }
    }
  }
}
