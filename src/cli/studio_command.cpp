// `crt studio` becomes the program crt-studio, which is a package of its own and lies beside crt.
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <vector>

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

/// Says what is wrong with what is asked for, if anything is.
bool accept_studio(const StudioRequest& request, const fs::path& scene, Reporter& reporter) {
  std::error_code failed;
  const bool is_folder = fs::is_directory(scene, failed);
  if (!is_folder && !fs::is_regular_file(scene, failed)) {
    reporter.add(ErrorCode::io,
                 fmt::format("there is no script '{0}'; to begin one: crt new {0}", scene.string()),
                 ExitCode::files);
  } else if (!is_folder && scene.extension() != ".crt") {
    reporter.add(
        ErrorCode::invalid_argument,
        fmt::format("'{}' is no script: the studio opens files that end in .crt", scene.string()),
        ExitCode::usage);
  } else if (!request.tls_key.empty() && request.tls_certificate.empty()) {
    reporter.add(ErrorCode::invalid_argument,
                 "--tls-key is the key of a certificate: --tls-cert names it", ExitCode::usage);
  } else {
    return true;
  }
  return false;
}

/// Returns the command line of the studio: NAME=VALUE for each value that it is to have.
std::vector<std::string> studio_words(const StudioRequest& request, const fs::path& scene) {
  std::error_code failed;
  const bool is_folder = fs::is_directory(scene, failed);
  const fs::path folder = is_folder ? scene : scene.parent_path();
  std::vector<std::string> words{
      "crt-studio", fmt::format("folder={}", folder.empty() ? "." : folder.string()),
      fmt::format("listen={}", request.listen), fmt::format("port={}", request.port),
      fmt::format("threads={}", request.threads)};
  const auto add = [&words](const char* name, const std::string& value) {
    if (!value.empty()) words.push_back(fmt::format("{}={}", name, value));
  };
  add("script", is_folder ? "" : scene.filename().string());
  for (const std::string& name : request.names) add("name", name);
  add("tls-cert", request.tls_certificate.string());
  add("tls-key", request.tls_key.string());
  add("embed", request.embed ? "yes" : "");
  return words;
}

}  // namespace

ExitCode run_studio(const StudioRequest& request) {
  Reporter reporter(request);
  const fs::path scene = request.scene.empty() ? fs::path(".") : request.scene;
  if (!accept_studio(request, scene, reporter)) return reporter.finish();
  const std::string program = studio_program().string();
  std::vector<std::string> words = studio_words(request, scene);
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execvp(program.c_str(), pointers.data());
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
