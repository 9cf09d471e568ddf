// Letters of ASCII are compared in one case. No locale changes what that is.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace crt::text {

/// Returns the small letter for a large one, and any other character as it is.
constexpr char small_letter(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

inline std::string in_small_letters(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), small_letter);
  return result;
}

}  // namespace crt::text
