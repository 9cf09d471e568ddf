// `crt studio` becomes the program crt-studio, which is a package of its own and lies beside crt.
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>
#include <system_error>

#include "cli/commands.hpp"
#include "cli/process.hpp"
#include "cli/reporter.hpp"

namespace crt::cli {

namespace {

namespace fs = std::filesystem;

/// Returns the program beside this one, or its name alone if there is none.
fs::path studio_program() {
  constexpr const char* name = "crt-studio";
  std::error_code failed;
  const fs::path folder = fs::path(this_program()).parent_path();
  return !folder.empty() && fs::exists(folder / name, failed) ? folder / name : fs::path(name);
}

}  // namespace

ExitCode run_studio(const StudioRequest& request) {
  Reporter reporter(request);
  const fs::path scene = request.scene.empty() ? fs::path(".") : request.scene;
  std::error_code failed;
  const bool is_folder = fs::is_directory(scene, failed);
  if (!is_folder && !fs::is_regular_file(scene, failed)) {
    reporter.add(ErrorCode::io,
                 fmt::format("there is no script '{0}'; to begin one: crt new {0}", scene.string()),
                 ExitCode::files);
    return reporter.finish();
  }
  if (!is_folder && scene.extension() != ".crt") {
    reporter.add(
        ErrorCode::invalid_argument,
        fmt::format("'{}' is no script: the studio opens files that end in .crt", scene.string()),
        ExitCode::usage);
    return reporter.finish();
  }
  const fs::path folder = is_folder                     ? scene
                          : scene.parent_path().empty() ? "."
                                                        : scene.parent_path();
  const std::string program = studio_program().string();
  std::string folder_name = folder.string();
  std::string script = is_folder ? "" : scene.filename().string();
  std::string port = fmt::format("{}", request.port);
  std::string threads = fmt::format("{}", request.threads);
  std::string name = "crt-studio";
  std::string embed = "embed";
  const std::array<char*, 7> words{name.data(),    folder_name.data(),
                                   script.data(),  port.data(),
                                   threads.data(), request.embed ? embed.data() : nullptr,
                                   nullptr};
  execvp(program.c_str(), words.data());
  const int error = errno;
  reporter.add(
      ErrorCode::unsupported,
      error == ENOENT
          ? std::string("the studio is not installed: it is the package crt-studio")
          : fmt::format("the studio cannot be started: {}", std::generic_category().message(error)),
      ExitCode::files);
  return reporter.finish();
}

}  // namespace crt::cli
