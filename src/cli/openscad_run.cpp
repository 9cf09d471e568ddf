#include "cli/openscad_run.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include <cerrno>
#include <chrono>
#include <crt/error.hpp>
#include <crt/script.hpp>
#include <csignal>
#include <cstdlib>
#include <system_error>
#include <thread>

#include "cli/process.hpp"
#include "cli/script_source.hpp"

namespace crt::cli {

namespace {

namespace fs = std::filesystem;

/// A TemporaryFolder is nobody else's, and goes with what is in it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "crt-import-XXXXXX").string();
    if (!mkdtemp(name.data()))
      throw Error(ErrorCode::io, fmt::format("cannot make a folder '{}'", name));
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// Waits for a process until a time. Returns whether it went well, and kills it if it is too slow.
bool has_succeeded_in_time(pid_t process, double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(std::min(seconds, 1e6));
  auto pause = std::chrono::milliseconds(1);
  for (;;) {
    int status = 0;
    const pid_t ended = waitpid(process, &status, WNOHANG);
    if (ended == process) return WIFEXITED(status) && WEXITSTATUS(status) == 0;
    if (ended < 0 && errno != EINTR) return false;
    if (Clock::now() >= end) {
      kill(process, SIGKILL);
      (void)has_succeeded(process);
      throw Error(ErrorCode::limit,
                  fmt::format("openscad took longer than {} s: see --seconds", seconds));
    }
    std::this_thread::sleep_for(pause);
    pause = std::min(pause * 2, std::chrono::milliseconds(50));
  }
}

}  // namespace

std::string csg_of_scad(const fs::path& part, double seconds) {
  std::error_code failed;
  if (!fs::is_regular_file(part, failed))
    throw Error(ErrorCode::io, fmt::format("{}: there is no such file", part.string()));
  const TemporaryFolder folder;
  const fs::path tree = folder.path() / "part.csg";
  pid_t process = 0;
  try {
    // A path that is absolute is no option, whatever it begins with.
    process = start_program({"openscad", "-o", tree.string(), fs::absolute(part).string()});
  } catch (const Error& error) {
    throw Error(ErrorCode::io, fmt::format("{}. It evaluates .scad files: install OpenSCAD, or "
                                           "import the .csg file that it writes",
                                           error.what()));
  }
  if (!has_succeeded_in_time(process, seconds))
    throw Error(ErrorCode::io, fmt::format("{}: openscad could not evaluate it", part.string()));
  return ScriptSource(tree).text();
}

}  // namespace crt::cli
