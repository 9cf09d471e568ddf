// Texts of other programs are imported, and the scripts of them run.
#pragma once

#include <doctest/doctest.h>

#include <crt/entity.hpp>
#include <crt/measure.hpp>
#include <crt/script.hpp>
#include <string>
#include <vector>

#include "import/import.hpp"

namespace crt::test {

/// An Imported is a script, what was said of it, and its scene.
struct Imported {
  std::string script{};
  std::vector<Diagnostic> diagnostics{};
  Scene scene{};

  /// Returns how much the first entity is, within 1e-4 of itself.
  double volume() const {
    const Interval found = crt::volume(scene.entities.at(0), {.relative_width = 1e-4});
    return (found.lower + found.upper) / 2;
  }
  bool says(const std::string& text) const { return script.find(text) != std::string::npos; }
};

/// Runs what was imported. There must be a script.
inline Imported run_imported(const importing::ImportResult& result) {
  Imported imported{.diagnostics = result.diagnostics};
  for (const Diagnostic& diagnostic : result.diagnostics) INFO(format_diagnostic(diagnostic));
  REQUIRE(result.script.has_value());
  imported.script = *result.script;
  INFO(imported.script);
  ScriptResult run = run_script(imported.script, "test.crt");
  for (const Diagnostic& diagnostic : run.diagnostics) CHECK(format_diagnostic(diagnostic).empty());
  REQUIRE(run.scene.has_value());
  imported.scene = *run.scene;
  return imported;
}

inline Imported csg(const std::string& text, const importing::ImportOptions& options = {}) {
  return run_imported(importing::import_csg(text, "test.csg", options));
}

inline Imported pov(const std::string& text, const importing::ImportOptions& options = {}) {
  return run_imported(importing::import_pov(text, "test.pov", options));
}

/// Returns the diagnostics as lines, "2:5: error: ...".
inline std::string said(const std::vector<Diagnostic>& diagnostics) {
  std::string lines;
  for (const Diagnostic& diagnostic : diagnostics) {
    lines += std::to_string(diagnostic.place.line) + ":" + std::to_string(diagnostic.place.column) +
             (diagnostic.severity == Severity::error ? ": error: " : ": warning: ") +
             diagnostic.message + "\n";
  }
  return lines;
}

}  // namespace crt::test
