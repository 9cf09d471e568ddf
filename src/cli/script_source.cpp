#include "cli/script_source.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "cli/options.hpp"

namespace crt::cli {

namespace {

std::string read_standard_input(std::size_t most_bytes) {
  std::string text;
  constexpr std::size_t piece = 1 << 16;
  while (text.size() <= most_bytes) {
    const std::size_t before = text.size();
    text.resize(before + piece);
    const ssize_t count = read(STDIN_FILENO, text.data() + before, piece);
    const int error = errno;
    text.resize(before + (count > 0 ? static_cast<std::size_t>(count) : 0));
    if (count == 0) break;
    if (count < 0 && error != EINTR) {
      throw Error(ErrorCode::io, fmt::format("cannot read standard input: {}",
                                             std::generic_category().message(error)));
    }
  }
  return text;
}

}  // namespace

ScriptSource::ScriptSource(std::filesystem::path file, const ScriptLimits& limits)
    : file_(std::move(file)) {
  if (file_ == standard_stream) text_ = read_standard_input(limits.source_bytes);
}

std::string ScriptSource::name() const {
  return text_ ? "<standard input>" : file_.string();
}

std::string ScriptSource::text() const {
  if (text_) return *text_;
  std::ifstream file(file_, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

ScriptResult ScriptSource::run(const ScriptOptions& options) const {
  return text_ ? run_script(*text_, name(), options) : run_script_file(file_, options);
}

}  // namespace crt::cli
