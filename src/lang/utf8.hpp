// Reading and writing UTF-8, and making any bytes fit to be shown.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace crt::lang {

/// The code point that starts at `position`, which moves past it; past one byte, and nothing, where
/// the bytes are not UTF-8 (RFC 3629: no overlong forms, no surrogates). `position` is within
/// `text`.
std::optional<char32_t> decode_utf8(std::string_view text, std::size_t& position);

void append_utf8(std::string& text, char32_t code_point);

/// Code points in `text`; a byte that is not UTF-8 counts as one.
std::size_t count_code_points(std::string_view text);

/// The text with everything that could upset a terminal or a JSON reader (control characters but
/// the tab, bytes that are not UTF-8) replaced by U+FFFD, the sign for that.
std::string printable(std::string_view text);

/// The same, cut off where it is longer than a message should be.
std::string abbreviated(std::string_view text);

/// How a code point is named in a message: 'x', or U+00A0 where it cannot be seen.
std::string describe_code_point(char32_t code_point);

}  // namespace crt::lang
