// What a command line of `crt` asks for. Parsing it is the business of options.cpp, the only source
// that includes CLI11, and what values mean that of option_values.cpp.
#pragma once

#include <crt/render.hpp>
#include <crt/script.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace crt::cli {

/// How the process ends; the README and `crt --help` list these.
enum class ExitCode {
  done = 0,
  script = 1,         ///< the script is wrong
  usage = 2,          ///< the command line is wrong
  files = 3,          ///< a file could not be read or written
  internal = 70,      ///< a bug, or no memory left (sysexits.h: EX_SOFTWARE)
  interrupted = 130,  ///< SIGINT or SIGTERM (what shells report for SIGINT)
};

enum class DiagnosticsFormat { text, json };

/// Frames first..last of an animation, both rendered.
struct FrameRange {
  int first = 0;
  int last = 0;
};

/// What both commands take.
struct CommonRequest {
  ScriptOptions script;
  DiagnosticsFormat diagnostics = DiagnosticsFormat::text;
  bool quiet = false;
};

struct RenderRequest : CommonRequest {
  std::filesystem::path scene;
  std::filesystem::path output;
  std::optional<FrameRange> frames;
  RenderOptions render;
  std::uint64_t max_primitives = 0;  ///< see PrepareOptions
  /// Where statistics go: a file, "-" for standard output, or nowhere.
  std::string stats;
  bool reproducible = false;
};

struct CheckRequest : CommonRequest {
  std::vector<std::filesystem::path> scenes;
};

struct TradeRequest : CommonRequest {
  std::filesystem::path scene;
  /// What is written: this with .csv, .svg, and .png if asked for.
  std::filesystem::path output;
  bool png = false;
  /// Measures this part only; else bands with about so many pixels together.
  std::optional<Region> region;
  double pixels = 30000;
  /// That one setting, or one of the references, may take for what is measured.
  double most_seconds = 10;
  /// Of a pixel of the references: a power of 2.
  int reference_samples = 4096;
  int threads = 0;
  // What the user wants to know.
  std::optional<double> budget;
  std::optional<double> error;
};

/// The request, or the code to end with (after help, a version or a complaint has been printed).
using Request = std::variant<RenderRequest, CheckRequest, TradeRequest, ExitCode>;

Request parse_command_line(int argc, const char* const* argv);

}  // namespace crt::cli
