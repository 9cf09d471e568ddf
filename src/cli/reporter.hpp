// The reporter writes errors and warnings as text when they come, or collects them into one JSON
// array.
#pragma once

#include <crt/script.hpp>
#include <set>
#include <string>
#include <vector>

#include "cli/options.hpp"

namespace crt::cli {

class Reporter {
 public:
  explicit Reporter(const CommonRequest& request)
      : format_(request.diagnostics), quiet_(request.quiet) {}

  /// Adds what one run of a script gave. What was reported before (for another frame) is not
  /// reported again.
  void add(const std::vector<Diagnostic>& diagnostics);

  /// Adds an error that has no place in a script. `exit_code` is what it means for the process.
  void add(ErrorCode code, const std::string& message, ExitCode exit_code);
  void add(const Error& error);

  /// Adds a warning that has no place in a script, unless it was added before (for another frame).
  void warn(const std::string& message);

  /// Says whether a region is inside a picture. If not, it reports an error.
  bool accept_region(const Region& region, const Settings& settings);

  /// Writes a note about something that went right, as text on standard error.
  void note(const std::string& message);

  /// Writes text on standard error. If that fails, only the exit code shows it.
  void say(const std::string& text);

  /// Writes text on standard output. If that fails an error is added, unless the caller has closed
  /// it and that is fine.
  enum class IfClosed { is_fine, fails };
  void print(const std::string& text, IfClosed if_closed = IfClosed::is_fine);

  /// Prints the JSON array if that is the format. Returns the code to end with: that of the gravest
  /// thing reported.
  ExitCode finish();

 private:
  void add_one(const Diagnostic& diagnostic, const std::string& text);

  DiagnosticsFormat format_;
  bool quiet_;
  std::vector<Diagnostic> told_;
  std::set<std::string> texts_;
  ExitCode exit_code_ = ExitCode::done;
};

}  // namespace crt::cli
