#include "lang/utf8.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>

namespace crt::lang {

namespace {

constexpr char32_t replacement_character = 0xFFFD;
constexpr char32_t delete_character = 0x7F;

/// Returns the length of the sequence that a lead byte begins.
int sequence_length(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead <= 0xDF) return 2;
  if (lead >= 0xE0 && lead <= 0xEF) return 3;
  if (lead >= 0xF0 && lead <= 0xF4) return 4;
  return 0;
}

bool is_control(char32_t code_point) {
  const bool c0 = code_point < 0x20 && code_point != '\t';
  const bool c1 = code_point >= delete_character && code_point < 0xA0;
  // Marks that turn the direction of what follows can make a line show another text than it has.
  const bool turns_direction = (code_point >= 0x202A && code_point <= 0x202E) ||
                               (code_point >= 0x2066 && code_point <= 0x2069);
  return c0 || c1 || turns_direction;
}

}  // namespace

std::optional<char32_t> decode_utf8(std::string_view text, std::size_t& position) {
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

void append_utf8(std::string& text, char32_t code_point) {
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

std::size_t count_code_points(std::string_view text) {
  std::size_t count = 0;
  for (std::size_t position = 0; position < text.size(); ++count) {
    // This counts eight bytes at a time as long as they are ASCII. Lines can be long, and are
    // counted again and again.
    for (; text.size() - position >= sizeof(std::uint64_t); position += sizeof(std::uint64_t)) {
      constexpr std::uint64_t high_bits = 0x8080808080808080U;
      std::uint64_t bytes = 0;
      std::memcpy(&bytes, text.data() + position, sizeof bytes);
      if ((bytes & high_bits) != 0) break;
      count += sizeof bytes;
    }
    if (position == text.size()) break;
    decode_utf8(text, position);
  }
  return count;
}

std::string printable(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t position = 0; position < text.size();) {
    const std::optional<char32_t> code_point = decode_utf8(text, position);
    append_utf8(result,
                code_point && !is_control(*code_point) ? *code_point : replacement_character);
  }
  return result;
}

std::string abbreviated(std::string_view text) {
  constexpr std::size_t longest_bytes = 200;
  if (text.size() <= longest_bytes) return printable(text);
  std::size_t end = 0;
  while (end < longest_bytes) decode_utf8(text, end);
  return printable(text.substr(0, end)) + "...";
}

std::string describe_code_point(char32_t code_point) {
  constexpr char32_t first_unseen = 0xA0;  // the no-break space; the accented letters come after it
  if (is_control(code_point) || code_point == '\t' || code_point == first_unseen ||
      (code_point >= 0x2000 && code_point <= 0x200F) || code_point == 0xFEFF) {
    return fmt::format("U+{:04X}", static_cast<std::uint32_t>(code_point));
  }
  std::string text = "'";
  append_utf8(text, code_point);
  return text + "'";
}

}  // namespace crt::lang
