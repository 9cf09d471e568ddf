// This header runs scripts of the CRT language: text in, a Scene or diagnostics out. A script can
// do nothing that this C++ API cannot.
#pragma once

#include <crt/error.hpp>
#include <crt/mesh.hpp>
#include <crt/scene.hpp>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace crt {

/// A SourcePlace is a place in a script. Lines and columns count from 1. Columns count code points,
/// tabs as one.
struct SourcePlace {
  std::string file{};
  int line = 0;
  int column = 0;
  int length = 1;  ///< of the marked piece on that line, in code points

  friend bool operator==(const SourcePlace&, const SourcePlace&) = default;
};

/// A TextSpan is a piece of a script, [begin, end), in bytes.
struct TextSpan {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  friend bool operator==(const TextSpan&, const TextSpan&) = default;
};

/// Says how bad a diagnostic is.
enum class Severity { warning, error };

/// A Diagnostic is one message about a script.
struct Diagnostic {
  Severity severity = Severity::error;
  ErrorCode code = ErrorCode::script;
  std::string message{};  ///< one line, with what was expected and a suggestion where there is one
  SourcePlace place{};
  std::string source_line{};  ///< the text of that line, without its end
  /// Lists, for an error inside macros, where each was called, innermost first.
  std::vector<std::pair<std::string, SourcePlace>> calls{};
};

/// Returns "scene.crt:3:5: error: ..." with the source line and a caret under it, then the calls.
/// It ends in a newline.
std::string format_diagnostic(const Diagnostic& diagnostic);

/// Returns a JSON array of objects with severity, code, message, file, line, column, length, source
/// and calls.
std::string diagnostics_to_json(const std::vector<Diagnostic>& diagnostics);

/// Says what a script may use up. Passing a limit is an ordinary error (ErrorCode::limit) at its
/// place.
struct ScriptLimits {
  std::uint64_t steps = 20'000'000;  ///< expressions evaluated; making an entity counts as 16 more
  std::uint64_t entities = 10'000'000;  ///< made or put into the scene
  std::size_t call_depth = 256;         ///< macros within macros; at most 1000
  std::size_t list_length = 10'000'000;
  std::size_t string_bytes = 16 << 20;
  std::size_t memory_bytes = std::size_t{2}
                             << 30;     ///< about what all lists and strings hold together
  std::size_t source_bytes = 64 << 20;  ///< of a script and its imports together
  std::size_t errors = 20;              ///< reported before giving up
  /// This is how many pixels all pictures have together that the script or its meshes name, and
  /// heights of height fields. Headers of files say it before anything is decoded. 0 stands for
  /// affordable_image_pixels().
  std::uint64_t image_pixels = 0;
};

/// Says what a script may see and use. The defaults let it read files in its own directory alone.
struct ScriptOptions {
  /// Imports, images and meshes are looked for in these after the script's own directory. A path
  /// with a leading '/' is looked for in these alone.
  std::vector<std::filesystem::path> resource_directories{};
  /// Lets paths leave those directories.
  bool allow_outside_files = false;
  /// This is the frame of an animation, the constant `t`.
  double t = 0;
  /// These are top-level variables set from outside, as script expressions ("n", "18"). What the
  /// script assigns to them at the top level is ignored.
  std::vector<std::pair<std::string, std::string>> variables{};
  /// These are attributes of Settings that win over the script's, as script expressions ("gamma",
  /// "2.2").
  std::vector<std::pair<std::string, std::string>> settings{};
  /// 0 leaves it to the script's Settings. 2015 means that the script is one of that year, see
  /// docs/compat.md. The scene's Settings::compat then says so.
  int compat = 0;
  ScriptLimits limits{};
  /// Gets what `print` prints, a line at a time without its end. The thread that runs the script
  /// calls it.
  std::function<void(std::string_view)> print{};
  /// Is asked for each file (its resolved path) before the file system is. Returning nothing means
  /// that the file is read from the file system.
  std::function<std::optional<std::vector<std::byte>>(const std::filesystem::path&)> open_file{};
  /// Is called every few thousand steps. Returning false ends the script with ErrorCode::cancelled.
  std::function<bool()> go_on{};
};

/// An EntityPlace says which pieces of the main script put an entity into the scene.
struct EntityPlace {
  /// This is the statement outside of all macros: within the Scene block, or in a loop in there.
  TextSpan statement{};
  /// This is the statement that gave the entity, such as that of an object in a macro. If it is in
  /// an imported script, it is the same as `statement`.
  TextSpan origin{};

  friend bool operator==(const EntityPlace&, const EntityPlace&) = default;
};

/// A ScriptResult is what running a script gave.
struct ScriptResult {
  /// The scene is present if there was no error.
  std::optional<Scene> scene{};
  std::vector<Diagnostic> diagnostics{};
  /// Says where each of the scene's entities comes from, in their order.
  std::vector<EntityPlace> entity_places{};
  /// Says whether the script or an import reads the constant `t`, once there is a scene. If not,
  /// every `t` gives the same scene.
  bool reads_time = false;
};

/// Runs a script. `name` stands for it in messages, and its files are looked for in the directory
/// of `name`. It never throws for what a script does: errors are in the result. What a callback
/// throws comes out.
ScriptResult run_script(std::string_view text, const std::string& name,
                        const ScriptOptions& options = {});

/// Runs the script in a file. A missing file is a diagnostic with ErrorCode::io.
ScriptResult run_script_file(const std::filesystem::path& path, const ScriptOptions& options = {});

/// Makes an entity of a mesh file that is found as the files of a script in the current directory
/// are: there, in the resource directories or by open_file(), and nowhere else unless the options
/// allow it. So are the files that it names, whose pictures ScriptLimits::image_pixels limits.
/// `smooth` is that of MeshAttributes. Of the options for the mesh `warn` does not count: the
/// MeshReport has the warnings. Throws Error (io) if there is none, and as load_mesh() in
/// crt/mesh_file.hpp does. What open_file() throws comes out.
Entity load_mesh(const std::filesystem::path& path, const ScriptOptions& options,
                 std::optional<double> smooth = {}, const MeshOptions& mesh = {});

}  // namespace crt
