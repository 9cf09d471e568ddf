// Errors and warnings: told as text when they come, or collected into one JSON array.
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

  /// What one run of a script gave. What was told before (for another frame) is not told again.
  void add(const std::vector<Diagnostic>& diagnostics);

  /// An error that has no place in a script; `exit_code` is what it means for the process.
  void add(ErrorCode code, const std::string& message, ExitCode exit_code);
  void add(const Error& error);

  /// Whether a region is inside a picture; if not, that is told.
  bool accept_region(const Region& region, const Settings& settings);

  /// Something that went right, for the user to know: text on standard error.
  void note(const std::string& message);

  /// Text on standard error. What cannot be told anywhere shows in the exit code alone.
  void say(const std::string& text);

  /// Text on standard output. Where that does not take it an error is added, or nothing happens if
  /// the caller has closed it and that is fine.
  enum class IfClosed { is_fine, fails };
  void print(const std::string& text, IfClosed if_closed = IfClosed::is_fine);

  /// Prints the JSON array if that is the format. Gives the code to end with: that of the gravest
  /// thing told.
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
