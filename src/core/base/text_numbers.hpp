// Numbers in the text of files and of paths.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace crt::core {

/// Returns the double nearest to the number that the whole word is, or nothing if it is none. What
/// is too small for a double is 0, and what is too large is infinite.
std::optional<double> number_of(std::string_view word);

/// Returns the integer that the whole word is, or nothing if it is none.
std::optional<std::int64_t> integer_of(std::string_view word);

}  // namespace crt::core
