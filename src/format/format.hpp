// The formatter lays a script out: indentation, blanks between tokens, blank lines, columns of
// comments. It keeps the author's lines, as line ends may carry meaning, and every token and
// comment. So a formatted script has the tree that it had.
#pragma once

#include <crt/script.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crt::format {

/// A Formatted is a script as the formatter wrote it, or what is wrong with it.
struct Formatted {
  /// Is absent if the script has syntax errors. Formatting it again gives the same.
  std::optional<std::string> text{};
  std::vector<Diagnostic> diagnostics{};
};

/// Formats a script. `name` stands for it in messages. It throws nothing for what a script holds.
Formatted format_script(std::string_view text, const std::string& name);

}  // namespace crt::format
