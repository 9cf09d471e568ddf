// Random numbers without state: each is a function of a seed and of what it is for (pixel, sample,
// dimension), so that no order of work and no number of threads can change a picture.
//
// Source: Salmon, Moraes, Dror, Shaw, Parallel random numbers: as easy as 1, 2, 3, SC 2011
// (Philox4x32-10: section 3.3 and table 2; it passes BigCrush from 7 rounds on).
#pragma once

#include <array>
#include <cstdint>

namespace crt::core {

using PhiloxCounter = std::array<std::uint32_t, 4>;
using PhiloxKey = std::array<std::uint32_t, 2>;

/// The 128 random bits at a place of the sequence that the key names.
constexpr PhiloxCounter philox4x32_10(PhiloxCounter counter, PhiloxKey key) {
  constexpr std::uint64_t multiplier_0 = 0xd2511f53u;
  constexpr std::uint64_t multiplier_1 = 0xcd9e8d57u;
  constexpr std::uint32_t key_step_0 = 0x9e3779b9u;  // of the golden ratio
  constexpr std::uint32_t key_step_1 = 0xbb67ae85u;  // of the square root of 3
  constexpr int rounds = 10;
  for (int round = 0; round < rounds; ++round) {
    const std::uint64_t product_0 = multiplier_0 * counter[0];
    const std::uint64_t product_1 = multiplier_1 * counter[2];
    counter = {static_cast<std::uint32_t>(product_1 >> 32) ^ counter[1] ^ key[0],
               static_cast<std::uint32_t>(product_1),
               static_cast<std::uint32_t>(product_0 >> 32) ^ counter[3] ^ key[1],
               static_cast<std::uint32_t>(product_0)};
    key = {key[0] + key_step_0, key[1] + key_step_1};
  }
  return counter;
}

/// Maps 64 random bits to [0, 1): the upper 53 of them, all the double can hold at this spacing.
constexpr double to_unit_interval(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

/// What a random number is for. Numbers for different uses are independent.
struct RandomUse {
  std::uint32_t x = 0;  ///< the pixel, in the whole picture
  std::uint32_t y = 0;
  std::uint32_t sample = 0;     ///< the how-manieth sample of the pixel
  std::uint32_t dimension = 0;  ///< which decision of that sample
};

/// Two independent numbers, uniform in [0, 1): what a point in a square or on a lens takes.
constexpr std::array<double, 2> random_pair(std::uint64_t seed, const RandomUse& use) {
  const PhiloxKey key = {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)};
  const PhiloxCounter bits = philox4x32_10({use.x, use.y, use.sample, use.dimension}, key);
  return {to_unit_interval(std::uint64_t{bits[1]} << 32 | bits[0]),
          to_unit_interval(std::uint64_t{bits[3]} << 32 | bits[2])};
}

/// One number, uniform in [0, 1): the first of random_pair.
constexpr double random_number(std::uint64_t seed, const RandomUse& use) {
  return random_pair(seed, use)[0];
}

}  // namespace crt::core
