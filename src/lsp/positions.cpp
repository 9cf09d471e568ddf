#include "lsp/positions.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>

#include "lang/utf8.hpp"

namespace crt::lsp {

namespace {

/// Code points from here on take two units of UTF-16.
constexpr char32_t first_of_two_units = 0x10000;

std::uint32_t units_of(std::optional<char32_t> code_point) {
  return code_point && *code_point >= first_of_two_units ? 2 : 1;
}

}  // namespace

std::uint32_t count_characters(std::string_view text, Encoding encoding) {
  if (encoding == Encoding::utf8) return static_cast<std::uint32_t>(text.size());
  std::uint32_t count = 0;
  for (std::size_t place = 0; place < text.size();)
    count += units_of(lang::decode_utf8(text, place));
  return count;
}

std::uint32_t byte_at(const lang::Source& source, Position position, Encoding encoding) {
  if (position.line >= source.line_starts.size())
    return static_cast<std::uint32_t>(source.text.size());
  const std::string_view line = lang::line_at(source, position.line);
  std::size_t place = 0;
  if (encoding == Encoding::utf8) {
    place = std::min<std::size_t>(position.character, line.size());
  } else {
    for (std::uint32_t units = 0; place < line.size();) {
      std::size_t next = place;
      units += units_of(lang::decode_utf8(line, next));
      if (units > position.character) break;
      place = next;
    }
  }
  return source.line_starts[position.line] + static_cast<std::uint32_t>(place);
}

Position position_of(const lang::Source& source, std::uint32_t byte, Encoding encoding) {
  byte = std::min(byte, static_cast<std::uint32_t>(source.text.size()));
  const auto line = static_cast<std::uint32_t>(lang::line_of(source, byte));
  const std::string_view text = lang::line_at(source, line);
  const std::size_t before = std::min<std::size_t>(byte - source.line_starts[line], text.size());
  return {line, count_characters(text.substr(0, before), encoding)};
}

Range range_of(const lang::Source& source, lang::Span span, Encoding encoding) {
  return {position_of(source, span.begin - source.base, encoding),
          position_of(source, span.end - source.base, encoding)};
}

std::string_view first_code_points(std::string_view text, std::size_t count) {
  std::size_t end = 0;
  while (count > 0 && end < text.size()) lang::decode_utf8(text, end), --count;
  return text.substr(0, end);
}

}  // namespace crt::lsp
