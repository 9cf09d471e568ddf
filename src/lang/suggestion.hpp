// These functions make messages such as "did you mean ...?"
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "text/words.hpp"

namespace crt::lang {

/// Returns the candidate that a typist most likely meant by `word`, or an empty text if none is
/// near. Among equals it is the first.
std::string_view nearest(std::string_view word, const std::vector<std::string_view>& candidates);

/// Returns "; did you mean 'radius'?", or nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& candidates);

/// A Hint is what to say of a word.
struct Hint {
  std::string_view word;
  std::string_view text;
};

inline constexpr std::string_view how_to_write_macros =
    "; a macro is written f = Macro (x) { return x + 1 }";

/// Returns the text of the word's hint, or nothing.
std::string_view hint_of(std::string_view word, std::span<const Hint> hints);

/// Returns whether one of the names is `name`.
inline bool contains(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

using text::enumerate;

}  // namespace crt::lang
