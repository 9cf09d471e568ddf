#include "cli/command.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

extern char** environ;  // NOLINT: POSIX has no header for it

namespace crt::test {

namespace {

namespace fs = std::filesystem;

void require(bool fine, const char* what) {
  if (!fine) throw std::runtime_error(what);
}

/// Says where the three standard streams of a process go.
struct ProcessStreams {
  posix_spawn_file_actions_t actions{};

  explicit ProcessStreams(const fs::path& folder) {
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  }
  ~ProcessStreams() { posix_spawn_file_actions_destroy(&actions); }
  ProcessStreams(const ProcessStreams&) = delete;
  ProcessStreams& operator=(const ProcessStreams&) = delete;

  void write_to(int stream, const char* file) {
    constexpr mode_t readable = 0600;
    posix_spawn_file_actions_addopen(&actions, stream, file, O_WRONLY | O_CREAT | O_TRUNC,
                                     readable);
  }
};

pid_t spawn_crt(const ProcessStreams& streams, const std::vector<std::string>& arguments,
                const std::vector<std::string>& more_environment = {}) {
  std::vector<char*> words{const_cast<char*>("crt")};
  for (const std::string& argument : arguments)
    words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  // The first of several entries in the environment wins.
  std::vector<char*> environment;
  for (const std::string& entry : more_environment)
    environment.push_back(const_cast<char*>(entry.c_str()));
  for (char** entry = environ; *entry != nullptr; ++entry) environment.push_back(*entry);
  environment.push_back(nullptr);
  pid_t process = 0;
  const int failed = posix_spawn(&process, CRT_COMMAND, &streams.actions, nullptr, words.data(),
                                 environment.data());
  require(failed == 0, "cannot start " CRT_COMMAND);
  return process;
}

int exit_code_of(pid_t process) {
  int status = 0;
  require(waitpid(process, &status, 0) == process, "cannot wait for crt");
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (fs::temp_directory_path() / "crt-cli-XXXXXX").string();
  require(mkdtemp(pattern.data()) != nullptr, "cannot make a temporary folder");
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void TemporaryFolder::write(const std::string& name, const std::string& text) const {
  fs::create_directories((path_ / name).parent_path());
  std::ofstream(path_ / name, std::ios::binary) << text;
}

std::string TemporaryFolder::read(const std::string& name) const {
  return content_of(path_ / name);
}

std::vector<std::string> TemporaryFolder::names() const {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(path_))
    names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

Outcome run_crt(const TemporaryFolder& folder, const std::vector<std::string>& arguments) {
  return run_crt_into(folder, arguments, "", "");
}

Outcome run_crt_in(const Surroundings& surroundings, const TemporaryFolder& folder,
                   const std::vector<std::string>& arguments) {
  const TemporaryFolder files;
  files.write("in", surroundings.input);
  const std::string in = files.path() / "in";
  const std::string out = files.path() / "out";
  const std::string err = files.path() / "err";
  ProcessStreams streams(folder.path());
  posix_spawn_file_actions_addopen(&streams.actions, STDIN_FILENO, in.c_str(), O_RDONLY, 0);
  streams.write_to(STDOUT_FILENO, out.c_str());
  streams.write_to(STDERR_FILENO, err.c_str());
  const int exit_code = exit_code_of(spawn_crt(streams, arguments, surroundings.environment));
  return {exit_code, content_of(out), content_of(err)};
}

Outcome run_crt_into(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                     const std::string& out, const std::string& err) {
  const TemporaryFolder outputs;
  const std::string out_file = outputs.path() / "out";
  const std::string err_file = outputs.path() / "err";
  ProcessStreams streams(folder.path());
  streams.write_to(STDOUT_FILENO, (out.empty() ? out_file : out).c_str());
  streams.write_to(STDERR_FILENO, (err.empty() ? err_file : err).c_str());
  const int exit_code = exit_code_of(spawn_crt(streams, arguments));
  return {exit_code, content_of(out_file), content_of(err_file)};
}

Outcome run_crt_without_output(const TemporaryFolder& folder,
                               const std::vector<std::string>& arguments) {
  const TemporaryFolder outputs;
  const std::string err = outputs.path() / "err";
  ProcessStreams streams(folder.path());
  posix_spawn_file_actions_addclose(&streams.actions, STDOUT_FILENO);
  streams.write_to(STDERR_FILENO, err.c_str());
  const int exit_code = exit_code_of(spawn_crt(streams, arguments));
  return {exit_code, "", content_of(err)};
}

int run_crt_unheard(const TemporaryFolder& folder, const std::vector<std::string>& arguments) {
  ProcessStreams streams(folder.path());
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addclose(&streams.actions, stream);
  }
  return exit_code_of(spawn_crt(streams, arguments));
}

std::string shell(const TemporaryFolder& folder, const std::string& command) {
  const std::string line =
      "cd '" + folder.path().string() + "' && { " + command + "; } >shell.txt 2>&1";
  // NOLINTNEXTLINE(cert-env33-c): the words are the tests' own
  require(std::system(line.c_str()) == 0, command.c_str());
  return folder.read("shell.txt");
}

bool has_terminals() {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (terminal >= 0) close(terminal);
  return terminal >= 0;
}

CrtOnTerminal::CrtOnTerminal(const TemporaryFolder& folder,
                             const std::vector<std::string>& arguments, Streams on_terminal,
                             const std::vector<std::string>& environment) {
  from_crt_ = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  require(from_crt_ >= 0 && grantpt(from_crt_) == 0 && unlockpt(from_crt_) == 0,
          "cannot open a terminal");
  const std::string other_end = ptsname(from_crt_);
  ProcessStreams streams(folder.path());
  if (on_terminal == Streams::all) {
    posix_spawn_file_actions_addopen(&streams.actions, STDOUT_FILENO, other_end.c_str(),
                                     O_RDWR | O_NOCTTY, 0);
  } else {
    streams.write_to(STDOUT_FILENO, "/dev/null");
  }
  posix_spawn_file_actions_addopen(&streams.actions, STDERR_FILENO, other_end.c_str(),
                                   O_RDWR | O_NOCTTY, 0);
  process_ = spawn_crt(streams, arguments, environment);
}

CrtOnPipe::CrtOnPipe(const TemporaryFolder& folder, const std::vector<std::string>& arguments) {
  int ends[2] = {};
  require(pipe2(ends, O_CLOEXEC) == 0, "cannot make a pipe");
  from_crt_ = ends[0];
  ProcessStreams streams(folder.path());
  streams.write_to(STDOUT_FILENO, "/dev/null");
  posix_spawn_file_actions_adddup2(&streams.actions, ends[1], STDERR_FILENO);
  process_ = spawn_crt(streams, arguments);
  close(ends[1]);
}

RunningCrt::~RunningCrt() {
  if (process_ != 0) {
    send(SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  close(from_crt_);
}

bool RunningCrt::read_more() {
  char buffer[4096];
  // Reading fails once the process has ended and closed its end.
  const ssize_t count = read(from_crt_, buffer, sizeof buffer);
  if (count <= 0) return false;
  shown_.append(buffer, static_cast<std::size_t>(count));
  return true;
}

bool RunningCrt::shows(const std::string& text) {
  while (shown_.find(text) == std::string::npos) {
    if (!read_more()) return false;
  }
  return true;
}

void RunningCrt::send(int signal) const {
  kill(process_, signal);
}

int RunningCrt::wait() {
  while (read_more()) {
  }
  const int exit_code = exit_code_of(process_);
  process_ = 0;
  return exit_code;
}

}  // namespace crt::test
