// These functions read and write UTF-8, and make any bytes fit to be shown.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "text/printable.hpp"

namespace crt::lang {

using text::append_utf8;
using text::decode_utf8;
using text::printable;

/// Counts the code points in `text`. A byte that is not UTF-8 counts as one.
std::size_t count_code_points(std::string_view text);

/// Returns the printable text, cut off where it is longer than a message should be.
std::string abbreviated(std::string_view text);

/// Returns the name of a code point in a message: 'x', or U+00A0 where it cannot be seen.
std::string describe_code_point(char32_t code_point);

}  // namespace crt::lang
