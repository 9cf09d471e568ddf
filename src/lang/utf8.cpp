#include "lang/utf8.hpp"

#include <cstdint>
#include <cstring>

#include "text/format.hpp"

namespace crt::lang {

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

std::string abbreviated(std::string_view text) {
  constexpr std::size_t longest_bytes = 200;
  if (text.size() <= longest_bytes) return printable(text);
  std::size_t end = 0;
  while (end < longest_bytes) decode_utf8(text, end);
  return printable(text.substr(0, end)) + "...";
}

std::string describe_code_point(char32_t code_point) {
  constexpr char32_t first_unseen = 0xA0;  // the no-break space; the accented letters come after it
  if (text::is_control(code_point) || code_point == '\t' || code_point == first_unseen ||
      (code_point >= 0x2000 && code_point <= 0x200F) || code_point == 0xFEFF) {
    return text::format("U+{:04X}", static_cast<std::uint32_t>(code_point));
  }
  std::string text = "'";
  append_utf8(text, code_point);
  return text + "'";
}

}  // namespace crt::lang
