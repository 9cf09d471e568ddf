// A script comes from a file or from standard input.
#pragma once

#include <crt/script.hpp>
#include <filesystem>
#include <optional>
#include <string>

namespace crt::cli {

class ScriptSource {
 public:
  /// Takes a file, or standard input if the name is "-". That is read here, up to one byte more
  /// than a script may have. Throws Error (io) if it cannot be read.
  explicit ScriptSource(std::filesystem::path file, const ScriptLimits& limits = {});

  /// Returns what stands for the script in messages.
  std::string name() const;
  bool is_standard_input() const { return text_.has_value(); }
  const std::filesystem::path& file() const { return file_; }
  /// Returns the text, or nothing if the file cannot be read.
  std::string text() const;

  /// Runs the script. A file is read each time.
  ScriptResult run(const ScriptOptions& options) const;

 private:
  std::filesystem::path file_;
  std::optional<std::string> text_;  ///< of standard input
};

}  // namespace crt::cli
