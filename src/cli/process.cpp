#include "cli/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <crt/error.hpp>
#include <csignal>
#include <filesystem>
#include <system_error>

extern char** environ;  // NOLINT: POSIX has no header for it

namespace crt::cli {

int spawn(const std::string& program, const std::vector<std::string>& words,
          const posix_spawn_file_actions_t& streams, bool own_group, pid_t& process) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t usual;
  sigemptyset(&usual);
  sigaddset(&usual, SIGPIPE);
  sigaddset(&usual, SIGXFSZ);
  posix_spawnattr_setsigdefault(&attributes, &usual);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, own_group ? POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP
                                                  : POSIX_SPAWN_SETSIGDEF);
  const int error =
      posix_spawnp(&process, program.c_str(), &streams, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  return error;
}

pid_t start_program(const std::vector<std::string>& words, int output) {
  posix_spawn_file_actions_t streams;
  posix_spawn_file_actions_init(&streams);
  posix_spawn_file_actions_addopen(&streams, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&streams, output < 0 ? STDERR_FILENO : output, STDOUT_FILENO);
  pid_t process = 0;
  const int error = spawn(words.front(), words, streams, false, process);
  posix_spawn_file_actions_destroy(&streams);
  if (error != 0) {
    throw Error(ErrorCode::io, fmt::format("cannot start '{}': {}", words.front(),
                                           std::generic_category().message(error)));
  }
  return process;
}

bool has_succeeded(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0) {
    if (errno != EINTR) return false;
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

Answer ask_program(const std::vector<std::string>& words) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    throw Error(ErrorCode::io, fmt::format("cannot start '{}': no pipe", words.front()));
  pid_t process = 0;
  try {
    process = start_program(words, ends[1]);
  } catch (...) {
    close(ends[0]);
    close(ends[1]);
    throw;
  }
  close(ends[1]);
  Answer answer;
  std::array<char, 4096> piece{};
  ssize_t count = 0;
  while ((count = read(ends[0], piece.data(), piece.size())) != 0) {
    if (count < 0 && errno != EINTR) break;
    if (count > 0) answer.text.append(piece.data(), static_cast<std::size_t>(count));
  }
  close(ends[0]);
  answer.succeeded = has_succeeded(process);
  return answer;
}

std::string this_program() {
  std::error_code failed;
  const std::filesystem::path path = std::filesystem::read_symlink("/proc/self/exe", failed);
  return failed ? "crt" : path.string();
}

std::string shell_quoted(const std::string& word) {
  std::string result = "'";
  for (const char c : word) c == '\'' ? result += R"('\'')" : result += c;
  return result + "'";
}

}  // namespace crt::cli
