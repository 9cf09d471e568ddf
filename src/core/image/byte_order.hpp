// Numbers in files have their bytes in either order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace crt::core {

/// Returns the number in all of these (at most 8) bytes, the most significant first.
inline std::uint64_t big_endian(std::span<const std::byte> bytes) {
  std::uint64_t value = 0;
  for (const std::byte byte : bytes) value = value << 8 | std::to_integer<std::uint64_t>(byte);
  return value;
}

/// Returns the number in all of these (at most 8) bytes, the least significant first.
inline std::uint64_t little_endian(std::span<const std::byte> bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i > 0; --i)
    value = value << 8 | std::to_integer<std::uint64_t>(bytes[i - 1]);
  return value;
}

}  // namespace crt::core
