// This is SHA-256 (FIPS 180-4), which compares long contents bit for bit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace crt::core {

/// A Sha256 takes content piece by piece.
class Sha256 {
 public:
  void add(std::span<const std::byte> bytes);
  /// Returns the hash as 64 hexadecimal digits. It is to be called once, after all content.
  std::string digits();

 private:
  static constexpr std::size_t block_size = 64;
  void take_block(const std::byte* block);

  // These are of the square roots of the first primes (5.3.3).
  std::array<std::uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                         0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<std::byte, block_size> block_{};  ///< what does not fill one yet
  std::uint64_t bytes_ = 0;
};

/// Returns the hash of a content as 64 hexadecimal digits.
std::string sha256(std::span<const std::byte> content);

}  // namespace crt::core
