// Files of other programs become scripts of the CRT language: what OpenSCAD writes as .csg, and a
// subset of the scenes of POV-Ray. docs/import.md says what is understood.
#pragma once

#include <crt/script.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crt::importing {

struct ImportOptions {
  /// Makes the facets that OpenSCAD makes of round solids, in place of round ones.
  bool facets = false;
  /// Writes a script although the shapes of some things are not understood: these are left out, and
  /// the diagnostics about them are warnings.
  bool partial = false;
  /// Files that a scene includes are looked for in these, after the folder of the scene.
  std::vector<std::filesystem::path> include_folders{};
};

/// An ImportResult has the script, unless there is an error among the diagnostics.
struct ImportResult {
  std::optional<std::string> script{};
  std::vector<Diagnostic> diagnostics{};
};

/// Translates the tree that `openscad -o part.csg part.scad` writes. `name` stands for it in
/// messages and in the script. Files that it names are looked for in the folder of `name`. It never
/// throws for what the text holds.
ImportResult import_csg(std::string_view text, const std::string& name,
                        const ImportOptions& options = {});

/// Translates a scene of POV-Ray. It may include files beside it and in the folders of the options,
/// and of no other. Otherwise it does as import_csg() does.
ImportResult import_pov(std::string_view text, const std::string& name,
                        const ImportOptions& options = {});

}  // namespace crt::importing
