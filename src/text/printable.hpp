// Any bytes are made fit to be shown on a terminal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace crt::text {

/// Returns the length of the sequence that a lead byte begins.
constexpr int sequence_length(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead <= 0xDF) return 2;
  if (lead >= 0xE0 && lead <= 0xEF) return 3;
  if (lead >= 0xF0 && lead <= 0xF4) return 4;
  return 0;
}

/// Returns the code point that starts at `position`, and moves that past it. Where the bytes are
/// not UTF-8 (RFC 3629: no overlong forms, no surrogates) it returns nothing and moves past one
/// byte. `position` is within `text`.
inline std::optional<char32_t> decode_utf8(std::string_view text, std::size_t& position) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t start = position++;
  const int length = sequence_length(byte(start));
  if (length == 1) return byte(start);
  if (length == 0 || text.size() - start < static_cast<std::size_t>(length)) return std::nullopt;
  auto code_point = static_cast<char32_t>(byte(start) & (0xFF >> (length + 1)));
  for (int i = 1; i < length; ++i) {
    const unsigned char next = byte(start + static_cast<std::size_t>(i));
    if ((next & 0xC0) != 0x80) return std::nullopt;
    code_point = (code_point << 6) | (next & 0x3F);
  }
  const bool overlong =
      (length == 3 && code_point < 0x800) || (length == 4 && code_point < 0x10000);
  const bool surrogate = code_point >= 0xD800 && code_point <= 0xDFFF;
  if (overlong || surrogate || code_point > 0x10FFFF) return std::nullopt;
  position = start + static_cast<std::size_t>(length);
  return code_point;
}

inline void append_utf8(std::string& text, char32_t code_point) {
  const auto put = [&text](std::uint32_t byte) { text.push_back(static_cast<char>(byte)); };
  const auto bits = static_cast<std::uint32_t>(code_point);
  if (bits < 0x80) {
    put(bits);
  } else if (bits < 0x800) {
    put(0xC0 | (bits >> 6));
    put(0x80 | (bits & 0x3F));
  } else if (bits < 0x10000) {
    put(0xE0 | (bits >> 12));
    put(0x80 | ((bits >> 6) & 0x3F));
    put(0x80 | (bits & 0x3F));
  } else {
    put(0xF0 | (bits >> 18));
    put(0x80 | ((bits >> 12) & 0x3F));
    put(0x80 | ((bits >> 6) & 0x3F));
    put(0x80 | (bits & 0x3F));
  }
}

/// Says whether a character could make a terminal or a line show something else than the text.
/// The tab could not.
constexpr bool is_control(char32_t code_point) {
  constexpr char32_t delete_character = 0x7F;
  const bool c0 = code_point < 0x20 && code_point != '\t';
  const bool c1 = code_point >= delete_character && code_point < 0xA0;
  // Marks that turn the direction of what follows can make a line show another text than it has.
  const bool turns_direction = (code_point >= 0x202A && code_point <= 0x202E) ||
                               (code_point >= 0x2066 && code_point <= 0x2069);
  return c0 || c1 || turns_direction;
}

/// Says which characters are left as they are, though they are control characters.
enum class Kept { tabs, tabs_and_line_ends };

/// Returns the text with everything that could upset a terminal or a JSON reader replaced by
/// U+FFFD, the replacement character. That is control characters but those that are kept, and bytes
/// that are not UTF-8.
inline std::string printable(std::string_view text, Kept kept = Kept::tabs) {
  constexpr char32_t replacement_character = 0xFFFD;
  std::string result;
  result.reserve(text.size());
  for (std::size_t position = 0; position < text.size();) {
    const std::optional<char32_t> code_point = decode_utf8(text, position);
    const bool is_fine = code_point && (!is_control(*code_point) ||
                                        (*code_point == '\n' && kept == Kept::tabs_and_line_ends));
    append_utf8(result, is_fine ? *code_point : replacement_character);
  }
  return result;
}

}  // namespace crt::text
