// Editors count lines and characters, the front end counts bytes. These functions translate.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "lang/source_map.hpp"

namespace crt::lsp {

/// Says what a character of a Position is: a byte of UTF-8, or a unit of UTF-16.
enum class Encoding { utf8, utf16 };

/// A Position is a place between characters. Lines and characters count from 0.
struct Position {
  std::uint32_t line = 0;
  std::uint32_t character = 0;

  friend bool operator==(const Position&, const Position&) = default;
};

struct Range {
  Position start;
  Position end;

  friend bool operator==(const Range&, const Range&) = default;
};

/// Counts the characters of a text.
std::uint32_t count_characters(std::string_view text, Encoding encoding);

/// Returns the byte of a position, counted from the beginning of the source. A position behind the
/// end of its line, or behind the last line, is that end.
std::uint32_t byte_at(const lang::Source& source, Position position, Encoding encoding);

/// Returns the position of a byte, which may be behind the end.
Position position_of(const lang::Source& source, std::uint32_t byte, Encoding encoding);

/// Returns the range of a span of this source.
Range range_of(const lang::Source& source, lang::Span span, Encoding encoding);

/// Returns the bytes that hold the first so many code points of a text.
std::string_view first_code_points(std::string_view text, std::size_t count);

}  // namespace crt::lsp
