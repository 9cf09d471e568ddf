#include "service/checker.hpp"

#include <algorithm>
#include <array>
#include <crt/image.hpp>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>

#include "text/format.hpp"
#include "text/letters.hpp"

namespace crt::service {

namespace {

namespace fs = std::filesystem;

/// Says whether a script stands for itself, or is one to import.
bool stands_alone(const lang::Script& script) {
  const auto& statements = script.statements.statements;
  return std::any_of(statements.begin(), statements.end(), [](const lang::Statement& statement) {
    return std::holds_alternative<lang::SceneBlock>(statement.node) ||
           std::holds_alternative<lang::SettingsBlock>(statement.node);
  });
}

/// Says whether an error came of a limit that is lower here than where the script is rendered.
bool is_of_low_limit(const Diagnostic& diagnostic) {
  if (diagnostic.code != ErrorCode::limit) return false;
  constexpr std::array<std::string_view, 3> same_everywhere = {
      "nested more than", "lists nested more than", "macros call one another more than"};
  return std::none_of(
      same_everywhere.begin(), same_everywhere.end(),
      [&](std::string_view beginning) { return diagnostic.message.starts_with(beginning); });
}

constexpr std::array<std::string_view, 16> picture_endings = {
    ".png", ".jpg", ".jpeg", ".exr", ".hdr", ".tif", ".tiff", ".tga",
    ".bmp", ".gif", ".webp", ".pfm", ".ppm", ".pgm", ".dds",  ".jp2"};
constexpr std::array<std::string_view, 5> mesh_endings = {".obj", ".ply", ".stl", ".off", ".3mf"};

/// The content of a mesh file says what its format is. This is a closed mesh.
constexpr std::string_view tiny_mesh =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

std::vector<std::byte> bytes_of(std::string_view text) {
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return {begin, begin + text.size()};
}

/// Gives something tiny for each picture and mesh file that is there. Decoding a large one would
/// take longer than typing.
class TinyFiles {
 public:
  explicit TinyFiles(decltype(ScriptOptions::open_file) open) : open_(std::move(open)) {}

  std::optional<std::vector<std::byte>> operator()(const fs::path& path) {
    if (open_) {
      if (auto content = open_(path)) return content;
    }
    const std::string ending = text::in_small_letters(path.extension().string());
    const auto is_one_of = [&](const auto& endings) {
      return std::find(endings.begin(), endings.end(), ending) != endings.end();
    };
    const bool is_mesh = is_one_of(mesh_endings);
    std::error_code failed;
    if ((!is_mesh && !is_one_of(picture_endings)) || !fs::is_regular_file(path, failed))
      return std::nullopt;
    if (is_mesh) return bytes_of(tiny_mesh);
    // A height field has at least so many pixels.
    if (picture_->empty()) *picture_ = Image(2, 2).encode("png");
    return *picture_;
  }

 private:
  decltype(ScriptOptions::open_file) open_;
  std::shared_ptr<std::vector<std::byte>> picture_ = std::make_shared<std::vector<std::byte>>();
};

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

std::vector<Diagnostic> check_alone(Program& program, const ScriptOptions& options) {
  const lang::Source& main = program.main();
  const auto parsed = program.parsed_main();
  return (parsed ? lang::run_parsed(main.text, main.name, options, *parsed)
                 : run_script(main.text, main.name, options))
      .diagnostics;
}

/// Checks a script that others import as such: by a script that does nothing else.
std::vector<Diagnostic> check_import(const lang::Source& source, ScriptOptions& options) {
  const fs::path path = source.name;
  if (!path.is_absolute())  // a text without a file can only be run
    return run_script(source.text + "\nScene { }\n", source.name, options).diagnostics;
  options.open_file = [&path, &source, open = options.open_file](const fs::path& asked) {
    if (asked != path) return open(asked);
    return std::optional(bytes_of(source.text));
  };
  const std::string importer = "import " + quoted(path.filename().string()) + "\nScene { }\n";
  const fs::path name = path.parent_path() / (path.filename().string() + " as it is imported");
  return run_script(importer, name.string(), options).diagnostics;
}

}  // namespace

void lower_limits(ScriptLimits& limits) {
  // Some 50 ms at most.
  limits.steps = 500'000;
  limits.entities = 50'000;
  limits.list_length = 200'000;
  limits.string_bytes = 1 << 20;
  limits.memory_bytes = std::size_t{256} << 20;
  limits.source_bytes = std::size_t{16} << 20;
  limits.errors = 100;
}

std::vector<Diagnostic> check_script(Program& program, ScriptOptions options) {
  const lang::Source& main = program.main();
  if (main.text.size() > longest_checked) {
    return {{.severity = Severity::warning,
             .code = ErrorCode::limit,
             .message = text::format("a script of more than {} MiB is not checked as it is typed",
                                     longest_checked >> 20),
             .place = {.file = main.name, .line = 1, .column = 1}}};
  }
  lower_limits(options.limits);
  options.open_file = TinyFiles(options.open_file);
  options.print = [](std::string_view) {};
  std::vector<Diagnostic> diagnostics =
      stands_alone(program.script()) ? check_alone(program, options) : check_import(main, options);
  std::erase_if(diagnostics, is_of_low_limit);
  return diagnostics;
}

}  // namespace crt::service
