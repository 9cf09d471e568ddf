// PNG files have a check sum of each chunk.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace crt::core {

/// Returns the check sum of PNG and zip files. Source: ISO/IEC 15948 (PNG), annex D.
inline std::uint32_t checksum(std::span<const std::byte> bytes) {
  static constexpr std::array<std::uint32_t, 256> of_byte = [] {
    constexpr std::uint32_t polynomial = 0xedb88320;
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < table.size(); ++i) {
      table[i] = i;
      for (int bit = 0; bit < 8; ++bit)
        table[i] = (table[i] >> 1) ^ ((table[i] & 1) != 0 ? polynomial : 0);
    }
    return table;
  }();
  std::uint32_t sum = 0xffffffff;
  for (const std::byte byte : bytes)
    sum = of_byte[(sum ^ std::to_integer<std::uint32_t>(byte)) & 0xff] ^ (sum >> 8);
  return ~sum;
}

}  // namespace crt::core
