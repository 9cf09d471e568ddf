#include "cli/reporter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "cli/console.hpp"
#include "text/printable.hpp"

namespace crt::cli {

namespace {

ExitCode exit_code_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::invalid_argument:
    case ErrorCode::script:
    case ErrorCode::limit:
      return ExitCode::script;
    case ErrorCode::io:
    case ErrorCode::unsupported:  // what reads or writes such files is not installed
      return ExitCode::files;
    case ErrorCode::cancelled:
      return ExitCode::interrupted;
    case ErrorCode::out_of_memory:
    case ErrorCode::internal:
      break;
  }
  return ExitCode::internal;
}

/// Returns the code that says more of two. A script that is wrong matters more than a file it
/// lacks.
ExitCode graver(ExitCode a, ExitCode b) {
  constexpr ExitCode by_gravity[] = {ExitCode::interrupted, ExitCode::internal, ExitCode::usage,
                                     ExitCode::script,      ExitCode::files,    ExitCode::done};
  return *std::find_if(std::begin(by_gravity), std::end(by_gravity),
                       [&](ExitCode code) { return code == a || code == b; });
}

}  // namespace

void Reporter::add(const std::vector<Diagnostic>& diagnostics) {
  // The first error can cause others: a name is unknown since its file is missing.
  const auto first_error =
      std::find_if(diagnostics.begin(), diagnostics.end(),
                   [](const Diagnostic& it) { return it.severity == Severity::error; });
  if (first_error != diagnostics.end())
    exit_code_ = graver(exit_code_, exit_code_of(first_error->code));
  for (const Diagnostic& diagnostic : diagnostics)
    add_one(diagnostic, format_diagnostic(diagnostic));
}

void Reporter::add(ErrorCode code, const std::string& message, ExitCode exit_code) {
  exit_code_ = graver(exit_code_, exit_code);
  add_one(Diagnostic{.code = code, .message = message}, fmt::format("crt: error: {}\n", message));
}

void Reporter::add(const Error& error) {
  add(error.code(), error.what(), exit_code_of(error.code()));
}

void Reporter::warn(const std::string& message) {
  add_one(Diagnostic{.severity = Severity::warning, .message = message},
          fmt::format("crt: warning: {}\n", message));
}

bool Reporter::accept_region(const Region& region, const Settings& settings) {
  const bool inside =
      region.width <= settings.width - region.x && region.height <= settings.height - region.y;
  if (inside) return true;
  add(ErrorCode::invalid_argument,
      fmt::format("the region {},{},{},{} reaches beyond the picture, which has {} x {} pixels",
                  region.x, region.y, region.width, region.height, settings.width, settings.height),
      ExitCode::usage);
  return false;
}

void Reporter::note(const std::string& message) {
  if (!quiet_ && format_ == DiagnosticsFormat::text) say(message + "\n");
}

void Reporter::print(const std::string& text, IfClosed if_closed) {
  if (write_text(stdout, text) || (is_closed(errno) && if_closed == IfClosed::is_fine)) return;
  add(ErrorCode::io,
      fmt::format("cannot write to standard output: {}", std::generic_category().message(errno)),
      ExitCode::files);
}

void Reporter::say(const std::string& text) {
  if (!write_text(stderr, text) && !is_closed(errno))
    exit_code_ = graver(exit_code_, ExitCode::files);
}

void Reporter::add_one(const Diagnostic& diagnostic, const std::string& text) {
  if (quiet_ && diagnostic.severity == Severity::warning) return;
  if (!texts_.insert(text).second) return;
  told_.push_back(diagnostic);
  // What a message quotes may come from anywhere.
  if (format_ == DiagnosticsFormat::text)
    say(text::printable(text, text::Kept::tabs_and_line_ends));
}

ExitCode Reporter::finish() {
  if (format_ == DiagnosticsFormat::json) say(diagnostics_to_json(told_) + "\n");
  return exit_code_;
}

}  // namespace crt::cli
