// The reporter collects the diagnostics of a script. A Failure carries an error up to it.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "crt/script.hpp"
#include "lang/source_map.hpp"

namespace crt::lang {

/// A Failure is an error in a running script, which is thrown from where it happened to the
/// statement that gives up.
struct Failure {
  Span span;
  std::string message;
  ErrorCode code = ErrorCode::script;
  /// Lists the macros it passed through: name and where each was called, innermost first.
  std::vector<std::pair<std::string, Span>> calls = {};

  /// Notes that the failure leaves a macro that was called at `call`.
  void add_call(std::string_view name, Span call);
};

/// Says whether the script cannot continue after it: a limit was passed, or the caller wants no
/// more.
inline bool ends_script(const Failure& failure) {
  return failure.code == ErrorCode::limit || failure.code == ErrorCode::cancelled;
}

/// Is thrown where continuing makes no sense and everything was reported.
struct GiveUp {};

/// A Reporter holds the diagnostics of a run, in the order they come.
class Reporter {
 public:
  Reporter(const SourceMap& sources, std::size_t most_errors)
      : sources_(sources), max_errors_(most_errors) {}

  /// Adds an error. Throws GiveUp when there are as many errors as the caller wants to see.
  void error(const Failure& failure);
  void error(Span span, std::string message, ErrorCode code = ErrorCode::script);

  /// Adds a warning once for a place, and at most as many as errors.
  void warning(Span span, std::string message);

  /// Returns the line that a span begins in, from 1.
  int line_of(Span span) const { return sources_.place(span).line; }

  bool has_errors() const { return error_count_ > 0; }
  std::vector<Diagnostic>& diagnostics() { return diagnostics_; }

 private:
  Diagnostic make(Severity severity, Span span, std::string message, ErrorCode code) const;

  const SourceMap& sources_;
  std::size_t max_errors_;
  std::size_t error_count_ = 0;
  std::set<std::pair<std::uint32_t, std::string>> warned_;
  std::vector<Diagnostic> diagnostics_;
};

}  // namespace crt::lang
