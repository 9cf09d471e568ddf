// This runs the command `crt` in a folder of its own, as a shell would.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace crt::test {

/// A TemporaryFolder lives as long as the test.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  bool has(const std::string& name) const { return std::filesystem::exists(path_ / name); }
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  /// Returns the names of all that is in it, sorted.
  std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

/// An Outcome is what a run left behind.
struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// Runs `crt` with these arguments in the folder. Standard input is empty, the outputs are files.
Outcome run_crt(const TemporaryFolder& folder, const std::vector<std::string>& arguments);

/// Surroundings are what a run has beside its arguments.
struct Surroundings {
  std::string input{};                     ///< what standard input holds
  std::vector<std::string> environment{};  ///< entries that replace others
};

/// Runs `crt` in these surroundings.
Outcome run_crt_in(const Surroundings& surroundings, const TemporaryFolder& folder,
                   const std::vector<std::string>& arguments);

/// Runs `crt` with standard output, or standard error, going to a file or device that exists.
Outcome run_crt_into(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                     const std::string& out, const std::string& err);

/// Runs `crt` with standard output closed.
Outcome run_crt_without_output(const TemporaryFolder& folder,
                               const std::vector<std::string>& arguments);

/// Runs `crt` with all standard streams closed, and returns its exit code.
int run_crt_unheard(const TemporaryFolder& folder, const std::vector<std::string>& arguments);

/// Returns what a command of the shell prints in the folder. It must end with success.
std::string shell(const TemporaryFolder& folder, const std::string& command);

/// Says whether this machine has terminals to give. A container without /dev/pts has none.
bool has_terminals();

/// A RunningCrt shows what `crt` writes while it runs.
class RunningCrt {
 public:
  /// Ends the process if it still runs.
  ~RunningCrt();
  RunningCrt(const RunningCrt&) = delete;
  RunningCrt& operator=(const RunningCrt&) = delete;

  /// Reads what it shows until `text` is among it or it ends, and says whether it was.
  bool shows(const std::string& text);
  /// Forgets what it has shown.
  void forget() { shown_.clear(); }
  void send(int signal) const;
  /// Waits for its end, and returns its exit code, or -1 if a signal ended it.
  int wait();
  const std::string& shown() const { return shown_; }

 protected:
  RunningCrt() = default;

  pid_t process_ = 0;
  int from_crt_ = -1;

 private:
  bool read_more();

  std::string shown_;
};

/// A CrtOnTerminal runs `crt` with its standard error on a terminal, or with all standard streams.
class CrtOnTerminal : public RunningCrt {
 public:
  enum class Streams { error, all };
  CrtOnTerminal(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                Streams on_terminal = Streams::error,
                const std::vector<std::string>& environment = {"TERM=xterm"});
};

/// A CrtOnPipe runs `crt` with its standard error going into a pipe.
class CrtOnPipe : public RunningCrt {
 public:
  CrtOnPipe(const TemporaryFolder& folder, const std::vector<std::string>& arguments);
};

}  // namespace crt::test
