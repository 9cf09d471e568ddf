// `crt new` writes a script to begin with.
#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <system_error>

#include "cli/commands.hpp"
#include "cli/reporter.hpp"
#include "text/first_script.hpp"

namespace crt::cli {

namespace {

/// Writes a file that must not be there, or throws Error (io).
void write_new(const std::filesystem::path& path, std::string_view text) {
  const auto refuse = [&](const char* reason) {
    throw Error(ErrorCode::io, fmt::format("cannot write '{}': {}", path.string(), reason));
  };
  // "x" makes no file where anything is, not even a link that leads nowhere.
  std::FILE* const file = std::fopen(path.c_str(), "wx");
  if (!file) {
    if (errno == EEXIST) refuse("it exists, and is left as it is");
    refuse(std::strerror(errno));
  }
  const bool is_written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  const int write_error = errno;
  if (std::fclose(file) == 0 && is_written) return;
  const int error = is_written ? errno : write_error;
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  refuse(std::strerror(error));
}

}  // namespace

ExitCode run_new(const NewRequest& request) {
  Reporter reporter(request);
  std::filesystem::path scene = request.scene;
  if (!scene.has_extension()) scene += ".crt";
  try {
    write_new(scene, text::first_script(scene.filename().string()));
    if (!request.quiet)
      reporter.print(
          fmt::format("{0} is a scene to begin with. Render it: crt render {0}\n", scene.string()));
  } catch (const Error& error) {
    reporter.add(error);
  }
  return reporter.finish();
}

}  // namespace crt::cli
