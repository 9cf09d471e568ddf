#include "service/checker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <crt/image.hpp>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>

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

/// Gives a tiny picture for each file that is there and is no script. Decoding a large one would
/// take longer than typing.
class TinyPictures {
 public:
  explicit TinyPictures(decltype(ScriptOptions::open_file) open) : open_(std::move(open)) {}

  std::optional<std::vector<std::byte>> operator()(const fs::path& path) {
    if (open_) {
      if (auto content = open_(path)) return content;
    }
    std::error_code failed;
    if (path.extension() == ".crt" || !fs::is_regular_file(path, failed)) return std::nullopt;
    if (picture_->empty()) *picture_ = Image(1, 1).encode("png");
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
    const auto* begin = reinterpret_cast<const std::byte*>(source.text.data());
    return std::optional<std::vector<std::byte>>({begin, begin + source.text.size()});
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
             .message = fmt::format("a script of more than {} MiB is not checked as it is typed",
                                    longest_checked >> 20),
             .place = {.file = main.name, .line = 1, .column = 1}}};
  }
  lower_limits(options.limits);
  options.open_file = TinyPictures(options.open_file);
  options.print = [](std::string_view) {};
  std::vector<Diagnostic> diagnostics =
      stands_alone(program.script()) ? check_alone(program, options) : check_import(main, options);
  std::erase_if(diagnostics, is_of_low_limit);
  return diagnostics;
}

}  // namespace crt::service
