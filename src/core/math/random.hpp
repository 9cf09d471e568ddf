// Random numbers have no state. Each is a function of a seed and of what it is for: pixel, sample
// and dimension. So no order of work and no number of threads can change a picture.
//
// Source: Salmon, Moraes, Dror, Shaw, Parallel random numbers: as easy as 1, 2, 3, SC 2011
// (Philox4x32-10: section 3.3 and table 2; it passes BigCrush from 7 rounds on).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/simd/bits.hpp"

namespace crt::core {

using PhiloxCounter = std::array<std::uint32_t, 4>;
using PhiloxKey = std::array<std::uint32_t, 2>;

/// Computes Philox for one place of the sequence, or for four side by side. Only the lower 32 bits
/// of each Word count.
template <class Word>
constexpr std::array<Word, 4> philox_rounds(std::array<Word, 4> counter, PhiloxKey key) {
  constexpr std::uint32_t multiplier_0 = 0xd2511f53u;
  constexpr std::uint32_t multiplier_1 = 0xcd9e8d57u;
  constexpr std::uint32_t key_step_0 = 0x9e3779b9u;  // from the golden ratio
  constexpr std::uint32_t key_step_1 = 0xbb67ae85u;  // from the square root of 3
  constexpr int rounds = 10;
  for (int round = 0; round < rounds; ++round) {
    const Word product_0 = low_product(counter[0], multiplier_0);
    const Word product_1 = low_product(counter[2], multiplier_1);
    counter = {(product_1 >> 32) ^ counter[1] ^ key[0], product_1,
               (product_0 >> 32) ^ counter[3] ^ key[1], product_0};
    key = {key[0] + key_step_0, key[1] + key_step_1};
  }
  return counter;
}

/// Returns the 128 random bits at a place of the sequence that the key names.
constexpr PhiloxCounter philox4x32_10(const PhiloxCounter& counter, PhiloxKey key) {
  const auto words =
      philox_rounds<std::uint64_t>({counter[0], counter[1], counter[2], counter[3]}, key);
  const auto low = [](std::uint64_t word) { return static_cast<std::uint32_t>(word); };
  return {low(words[0]), low(words[1]), low(words[2]), low(words[3])};
}

/// Maps 64 random bits to [0, 1). It takes the upper 53, which are all that a double can hold at
/// this spacing.
constexpr double to_unit_interval(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

/// A RandomUse says what a random number is for. Numbers for different uses are independent.
struct RandomUse {
  std::uint32_t x = 0;  ///< the pixel in the whole picture
  std::uint32_t y = 0;
  std::uint32_t sample = 0;     ///< the number of the pixel's sample
  std::uint32_t dimension = 0;  ///< the number of the decision within that sample
};

constexpr PhiloxKey key_of(std::uint64_t seed) {
  return {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)};
}

/// Returns two independent numbers, uniform in [0, 1), such as a point in a square or on a lens
/// takes.
constexpr std::array<double, 2> random_pair(std::uint64_t seed, const RandomUse& use) {
  const PhiloxCounter bits = philox4x32_10({use.x, use.y, use.sample, use.dimension}, key_of(seed));
  return {to_unit_interval(std::uint64_t{bits[1]} << 32 | bits[0]),
          to_unit_interval(std::uint64_t{bits[3]} << 32 | bits[2])};
}

/// Maps random bits to [0, 1) in lanes. Each half of the bits becomes the last digits of a number,
/// and the sum of the two is exact.
inline Lanes to_unit_interval(const WordLanes& bits) {
  constexpr std::uint64_t exponent_of_2_to_84 = 0x4530000000000000u;
  constexpr std::uint64_t exponent_of_2_to_52 = 0x4330000000000000u;
  const WordLanes high = bits >> 43 | exponent_of_2_to_84;
  const WordLanes low = (bits >> 11 & 0xffffffffu) | exponent_of_2_to_52;
  return (bits_as<Lanes>(high) - (0x1p84 + 0x1p52) + bits_as<Lanes>(low)) * 0x1p-53;
}

/// Returns the pairs of a sample and of the three that follow it: all first numbers, then all
/// second ones.
inline std::array<Lanes, 2> random_pairs(std::uint64_t seed, const RandomUse& first) {
  const WordLanes samples([&](std::uint64_t lane) { return first.sample + lane; });
  const auto bits =
      philox_rounds<WordLanes>({first.x, first.y, samples, first.dimension}, key_of(seed));
  return {to_unit_interval(bits[1] << 32 | (bits[0] & 0xffffffffu)),
          to_unit_interval(bits[3] << 32 | (bits[2] & 0xffffffffu))};
}

/// Returns one number, uniform in [0, 1): the first of random_pair.
constexpr double random_number(std::uint64_t seed, const RandomUse& use) {
  return random_pair(seed, use)[0];
}

}  // namespace crt::core
