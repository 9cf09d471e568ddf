// This header translates between the ways in which editors count the places of a text: bytes of
// UTF-8, units of UTF-16, lines with columns. It belongs to the library crt::service.
#pragma once

#include <crt/script.hpp>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace crt {

/// A LineColumn is a place between characters. Lines and columns count from 0.
struct LineColumn {
  std::uint32_t line = 0;
  std::uint32_t column = 0;

  friend bool operator==(const LineColumn&, const LineColumn&) = default;
};

/// Says what a column of a LineColumn counts: bytes of UTF-8, or units of UTF-16.
enum class ColumnUnit { utf8, utf16 };

/// TextPlaces translates the places of one text, which is not kept. Places behind the end are the
/// end. Each question takes about the logarithm of how long the text is. A line ends with a line
/// feed, a carriage return or both, and a byte that is not UTF-8 is one unit.
class TextPlaces {
 public:
  /// Takes a text of less than 4 GiB.
  explicit TextPlaces(std::string_view text);

  /// Returns the unit of UTF-16, from the beginning of the text, that a byte is in.
  std::uint32_t unit_of(std::uint32_t byte) const;
  /// Returns the first byte of the character that a unit of UTF-16 is in.
  std::uint32_t byte_of(std::uint32_t unit) const;

  /// Returns the line and the column of a byte. Within the end of a line that is where it begins.
  LineColumn position_of(std::uint32_t byte, ColumnUnit unit) const;
  /// Returns the first byte of the character at a place. A column behind the end of its line is
  /// that end.
  std::uint32_t byte_at(LineColumn position, ColumnUnit unit) const;

  /// Returns the bytes of what a diagnostic marks, which is on one line of this text. An end of the
  /// text that is marked has none.
  TextSpan span_of(const SourcePlace& place) const;

 private:
  std::uint32_t advance(std::uint32_t byte, int code_points, std::uint32_t end) const;

  std::uint32_t size_ = 0;
  /// Says where each line begins and ends. Its end is not in it.
  std::vector<TextSpan> lines_;
  /// Has the bytes and the units of UTF-16 of each character that takes more than a byte.
  std::vector<std::pair<TextSpan, TextSpan>> wide_;
};

}  // namespace crt
