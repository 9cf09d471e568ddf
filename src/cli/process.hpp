// Other programs are run as a shell runs them, but without a shell.
#pragma once

#include <spawn.h>
#include <sys/types.h>

#include <string>
#include <vector>

namespace crt::cli {

/// Starts a program by its path, or by a name that is looked for in PATH. It handles pipes as
/// usual, whatever this one does. It is in a process group of its own if it is asked for. Returns
/// the error number, or 0.
int spawn(const std::string& program, const std::vector<std::string>& words,
          const posix_spawn_file_actions_t& streams, bool own_group, pid_t& process);

/// Starts a program, which is looked for in PATH, with standard input empty. Its output goes where
/// this program's errors go, or to `output`, if that is a descriptor. Throws Error (io) if it
/// cannot be started.
pid_t start_program(const std::vector<std::string>& words, int output = -1);

/// Waits for the end of a process, and says whether all went well.
bool has_succeeded(pid_t process);

/// An Answer is what a program wrote to standard output.
struct Answer {
  bool succeeded = false;
  std::string text;
};
/// Runs a program to its end. Throws Error (io) if it cannot be started.
Answer ask_program(const std::vector<std::string>& words);

/// Returns the path of this program.
std::string this_program();

/// Returns a word between single quotes, as shells read it.
std::string shell_quoted(const std::string& word);

}  // namespace crt::cli
