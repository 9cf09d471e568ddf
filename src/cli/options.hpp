// A request holds what a command line of `crt` asks for. options.cpp parses it, and is the only
// source that includes CLI11. The options of each command are rows (option_table.hpp), which
// option_values.cpp gives their meaning.
#pragma once

#include <crt/render.hpp>
#include <crt/script.hpp>
#include <crt/source_code.hpp>
#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "cli/command_description.hpp"

namespace crt::cli {

/// Says how the process ends. The README and `crt --help` list these codes.
enum class ExitCode {
  done = 0,
  script = 1,         ///< the script is wrong
  usage = 2,          ///< the command line is wrong
  files = 3,          ///< a file could not be read or written
  internal = 70,      ///< a bug, or no memory left (sysexits.h: EX_SOFTWARE)
  interrupted = 130,  ///< SIGINT or SIGTERM (what shells report for SIGINT)
};

enum class DiagnosticsFormat { text, json };

/// A FrameRange is the frames first..last of an animation, both rendered.
struct FrameRange {
  int first = 0;
  int last = 0;
};

/// As the name of a file, this is standard input or output.
inline constexpr const char* standard_stream = "-";

/// A CommonRequest holds what all commands take that run scripts.
struct CommonRequest {
  ScriptOptions script;
  DiagnosticsFormat diagnostics = DiagnosticsFormat::text;
  bool quiet = false;
};

/// A PictureRequest holds what all commands take that make pictures.
struct PictureRequest : CommonRequest {
  std::filesystem::path output;  ///< empty: beside the script
  RenderOptions render;
  std::uint64_t max_primitives = 0;  ///< see PrepareOptions
  bool reproducible = false;
};

/// A SectionPlane is {p : normal . p / |normal| = offset}.
struct SectionPlane {
  Vec3 normal{0, 0, 1};
  double offset = 0;
};

struct RenderRequest : PictureRequest {
  std::vector<std::filesystem::path> scenes;
  std::optional<FrameRange> frames;
  bool film = false;                    ///< of the frames of the script, if no others are named
  double frames_per_second = 24;        ///< of a film
  std::filesystem::path keep_frames;    ///< the pictures of a film go into this folder, too
  std::optional<SectionPlane> section;  ///< cuts scenes open, in place of their cameras' own
  /// Statistics go to this file, to standard output if it is "-", or nowhere if it is empty.
  std::string stats;
};

struct WatchRequest : PictureRequest {
  std::filesystem::path scene;
};

/// A FarmRequest holds what all verbs of the command take. `given` has the options by name.
struct FarmRequest : PictureRequest {
  std::string verb;
  std::filesystem::path target;  ///< the script to plan, else the job
  std::set<std::string> given;
  // to plan
  std::optional<FrameRange> frames;
  bool film = false;  ///< the frames are those that the script's Settings have
  int tasks = 0;
  double least_seconds = 60;
  int tile_width = 0;
  int tile_height = 0;
  // to work and merge
  std::optional<int> task;
  bool follow = false;
  // to show
  std::filesystem::path sheet;
  // to submit
  bool local = false;
  bool slurm = false;
  bool parallel = false;
  bool no_wait = false;
  int processes = 0;
  std::string hosts;
  std::vector<std::string> slurm_options;
};

struct CheckRequest : CommonRequest {
  std::vector<std::filesystem::path> scenes;
};

/// A SolidMeasure is what `crt trade` measures of solids. `mass` is all of the mass properties.
enum class SolidMeasure { volume, area, mass };

struct TradeRequest : CommonRequest {
  std::filesystem::path scene;
  /// The command writes this name with .csv and .svg.
  std::filesystem::path output;
  /// Measures this part only. Without it, bands with about `pixels` pixels together are measured.
  std::optional<Region> region;
  double pixels = 30000;
  /// One setting, or one of the references, may take this many seconds for what is measured.
  double max_seconds = 10;
  /// A pixel of the references has this many samples, a power of 2.
  int reference_samples = 4096;
  int threads = 0;
  // These are the user's questions.
  std::optional<double> budget;
  std::optional<double> error;
  /// Measures solids instead of pictures.
  std::optional<SolidMeasure> measure;
};

/// A MeasureRequest asks how much entities are, and where.
struct MeasureRequest : CommonRequest {
  std::filesystem::path scene;
  // If none of these is asked for, volume, area, bounds and centroid are.
  bool volume = false;
  bool area = false;
  bool bounds = false;
  bool mass = false;  ///< with it the centroid and the inertia
  std::optional<SectionPlane> section;
  double deviation = 0;          ///< of the section; 0 stands for a share of the size
  std::filesystem::path output;  ///< gets the section; empty for none
  double hatch = 0;
  bool thickness = false;
  /// Is that of entities whose materials say none, by cubed scene units.
  std::optional<double> density;
  double relative_width = 1e-4;
  double wall_width = 1e-2;  ///< the relative width of a thickness, which takes longer
  double seconds = std::numeric_limits<double>::infinity();  ///< that each number may take
  int threads = 0;
  bool json = false;
  std::vector<std::pair<std::string, std::string>> distances;  ///< of entities, as they are called
  bool interference = false;

  bool asks_for_some() const { return volume || area || bounds || mass || thickness || section; }
  bool asks_for_pairs() const { return interference || !distances.empty(); }
  /// Asks whether there is anything to say of single entities.
  bool asks_for_entities() const { return asks_for_some() || !asks_for_pairs(); }
};

/// Says what is asked of a script's scene.
enum class Question { intersect, crossings, contains };

/// An AskRequest asks rays or points from standard input.
struct AskRequest : CommonRequest {
  std::filesystem::path scene;
  std::optional<Question> question;  ///< without it: intersect
  int threads = 0;
};

struct NewRequest : CommonRequest {
  std::filesystem::path scene;
};

/// An ExportRequest asks for source code.
struct ExportRequest : CommonRequest {
  std::filesystem::path scene;
  std::filesystem::path output;            ///< empty for standard output
  std::optional<SourceLanguage> language;  ///< without it the ending of the output says it
  std::optional<int> entity;               ///< writes this one alone
  std::optional<double> deviation;         ///< of triangles, in scene units
  std::optional<double> seconds;           ///< that the triangles of each entity may take
};

/// An ImportRequest asks for a script of another program's file.
struct ImportRequest : CommonRequest {
  std::filesystem::path file;
  std::filesystem::path output;  ///< empty for standard output
  bool facets = false;
  bool partial = false;
  std::vector<std::filesystem::path> include_folders;
  double seconds = 60;  ///< that OpenSCAD may take
};

struct FormatRequest : CommonRequest {
  std::vector<std::filesystem::path> scenes;  ///< "-" stands for the standard streams
  bool check = false;
};

/// An LspRequest asks for the language server. All else is asked by its client.
struct LspRequest {};

/// A StudioRequest asks for the page that shows a script while it is written.
struct StudioRequest : CommonRequest {
  std::filesystem::path scene;       ///< a script or a folder; empty for the current folder
  std::string listen = "127.0.0.1";  ///< an IP address without brackets
  int port = 0;                      ///< 0 takes one that is free
  std::vector<std::string> names;    ///< what browsers may call this machine, too
  // Without a certificate it is not encrypted. The key may be in the same file.
  std::filesystem::path tls_certificate;
  std::filesystem::path tls_key;
  int threads = 0;
  bool embed = false;  ///< in a frame of another page, until standard input ends
};

/// Asks for the completions of all commands in a shell.
struct CompletionsRequest {
  std::string shell;  ///< bash, zsh or fish
  CommandDescriptions commands;
};

/// Asks for the manual page.
struct ManRequest {
  CommandDescriptions commands;
};

/// A Request is what is asked for, or the code to end with (after help, a version or a complaint
/// has been printed).
using Request = std::variant<RenderRequest, FarmRequest, WatchRequest, CheckRequest, TradeRequest,
                             MeasureRequest, AskRequest, NewRequest, ExportRequest, ImportRequest,
                             FormatRequest, LspRequest, StudioRequest, CompletionsRequest,
                             ManRequest, ExitCode>;

Request parse_command_line(int argc, const char* const* argv);

}  // namespace crt::cli
