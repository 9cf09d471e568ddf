// Texts that come from elsewhere are looked at before they are taken for UTF-8.
#pragma once

#include <cstddef>
#include <string_view>

namespace crt::text {

/// Says whether a text is UTF-8 (RFC 3629) as far as its lead and continuation bytes go.
constexpr bool is_utf8(std::string_view text) {
  const auto byte = [&](std::size_t place) { return static_cast<unsigned char>(text[place]); };
  for (std::size_t place = 0; place < text.size();) {
    const unsigned char first = byte(place);
    if (first >= 0x80U && (first < 0xc2U || first > 0xf4U)) return false;
    const std::size_t end = place + (first < 0x80U ? 1 : first < 0xe0U ? 2 : first < 0xf0U ? 3 : 4);
    if (end > text.size()) return false;
    for (++place; place < end; ++place) {
      if ((byte(place) & 0xc0U) != 0x80U) return false;
    }
  }
  return true;
}

}  // namespace crt::text
