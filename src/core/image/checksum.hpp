// PNG files have a check sum of each chunk.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace crt::core {

/// Returns the check sum of PNG files. It takes eight bytes at a time: tables say what each of them
/// becomes by the time the last one is in.
///
/// Sources: ISO/IEC 15948 (PNG), annex D; Kounavis, Berry: "A systematic approach to building high
/// performance software-based CRC generators", 2005.
inline std::uint32_t checksum(std::span<const std::byte> bytes) {
  constexpr std::size_t at_once = 8;
  using Table = std::array<std::uint32_t, 256>;
  static constexpr std::array<Table, at_once> tables = [] {
    constexpr std::uint32_t polynomial = 0xedb88320;
    std::array<Table, at_once> made{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t sum = i;
      for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1) ^ ((sum & 1) != 0 ? polynomial : 0);
      made[0][i] = sum;
    }
    for (std::size_t k = 1; k < at_once; ++k) {
      for (std::size_t i = 0; i < 256; ++i) {
        const std::uint32_t sum = made[k - 1][i];
        made[k][i] = made[0][sum & 0xff] ^ (sum >> 8);
      }
    }
    return made;
  }();

  std::uint32_t sum = 0xffffffff;
  for (; bytes.size() >= at_once; bytes = bytes.subspan(at_once)) {
    std::uint32_t next = 0;
    for (std::size_t k = 0; k < at_once; ++k) {
      const std::uint32_t before = k < 4 ? sum >> (8 * k) : 0;
      const auto byte = std::to_integer<std::uint32_t>(bytes[k]);
      next ^= tables[at_once - 1 - k][(before ^ byte) & 0xff];
    }
    sum = next;
  }
  for (const std::byte byte : bytes) {
    sum = tables[0][(sum ^ std::to_integer<std::uint32_t>(byte)) & 0xff] ^ (sum >> 8);
  }
  return ~sum;
}

}  // namespace crt::core
