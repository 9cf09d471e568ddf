// These functions read and write UTF-8, and make any bytes fit to be shown.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace crt::lang {

/// Returns the code point that starts at `position`, and moves that past it. Where the bytes are
/// not UTF-8 (RFC 3629: no overlong forms, no surrogates) it returns nothing and moves past one
/// byte. `position` is within `text`.
std::optional<char32_t> decode_utf8(std::string_view text, std::size_t& position);

void append_utf8(std::string& text, char32_t code_point);

/// Counts the code points in `text`. A byte that is not UTF-8 counts as one.
std::size_t count_code_points(std::string_view text);

/// Returns the text with everything that could upset a terminal or a JSON reader replaced by
/// U+FFFD, the replacement character. That is control characters but the tab, and bytes that are
/// not UTF-8.
std::string printable(std::string_view text);

/// Returns the printable text, cut off where it is longer than a message should be.
std::string abbreviated(std::string_view text);

/// Returns the name of a code point in a message: 'x', or U+00A0 where it cannot be seen.
std::string describe_code_point(char32_t code_point);

}  // namespace crt::lang
