// This runs scripts for the tests.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "crt/script.hpp"

namespace crt::test {

struct Run {
  ScriptResult result;
  std::vector<std::string> printed;

  bool ok() const { return result.scene.has_value(); }

  /// Returns the messages of errors and warnings, in order.
  std::vector<std::string> messages() const {
    std::vector<std::string> messages;
    for (const Diagnostic& diagnostic : result.diagnostics) messages.push_back(diagnostic.message);
    return messages;
  }

  std::vector<Diagnostic> errors() const {
    std::vector<Diagnostic> errors;
    for (const Diagnostic& diagnostic : result.diagnostics) {
      if (diagnostic.severity == Severity::error) errors.push_back(diagnostic);
    }
    return errors;
  }

  /// Says whether the run ended in just one error, of this kind.
  bool failed_with(ErrorCode code) const {
    return !ok() && errors().size() == 1 && errors()[0].code == code;
  }
};

inline Run run(std::string_view text, ScriptOptions options = {},
               const std::string& name = "test.crt") {
  Run run;
  options.print = [&run](std::string_view line) { run.printed.emplace_back(line); };
  run.result = run_script(text, name, options);
  return run;
}

/// Runs a script with an empty Scene behind the text.
inline Run run_statements(std::string_view text, ScriptOptions options = {}) {
  return run(std::string(text) + "\nScene { }\n", std::move(options));
}

}  // namespace crt::test
