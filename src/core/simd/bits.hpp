// Operations on the bits of whole numbers side by side are here, for which instruction sets have
// better instructions than the compiler finds. Each has a plain form for all other targets, with
// the same result.
#pragma once

#include <cstdint>

#include "core/simd/lanes.hpp"

#ifdef __AVX2__
#include <immintrin.h>
#endif

namespace crt::core {

namespace plain_bits {

/// Returns the products of the numbers' lower 32 bits with a factor.
template <class Word>
constexpr Word low_product(const Word& numbers, std::uint32_t factor) {
  return (numbers & 0xffffffffu) * Word(factor);
}

/// Returns numbers of 32 bits with the bits in reverse order.
template <class Bits>
constexpr Bits reversed(Bits bits) {
  bits = (bits >> 1 & 0x55555555u) | (bits & 0x55555555u) << 1;
  bits = (bits >> 2 & 0x33333333u) | (bits & 0x33333333u) << 2;
  bits = (bits >> 4 & 0x0f0f0f0fu) | (bits & 0x0f0f0f0fu) << 4;
  bits = (bits >> 8 & 0x00ff00ffu) | (bits & 0x00ff00ffu) << 8;
  return bits >> 16 | bits << 16;
}

/// Returns four bytes in a row as numbers.
inline Lanes lanes_of_bytes(const std::uint8_t* bytes) {
  return lanes_of(bytes[0], bytes[1], bytes[2], bytes[3]);
}

}  // namespace plain_bits

#ifndef __AVX2__
using plain_bits::lanes_of_bytes;
#endif
using plain_bits::low_product;
using plain_bits::reversed;

#ifdef __AVX2__

[[gnu::always_inline]] inline WordLanes low_product(const WordLanes& numbers,
                                                    std::uint32_t factor) {
  return std::bit_cast<WordLanes>(
      _mm256_mul_epu32(std::bit_cast<__m256i>(numbers), _mm256_set1_epi64x(factor)));
}

[[gnu::always_inline]] inline Lanes lanes_of_bytes(const std::uint8_t* bytes) {
  std::int32_t four;
  std::memcpy(&four, bytes, sizeof four);
  return std::bit_cast<Lanes>(_mm256_cvtepi32_pd(_mm_cvtepu8_epi32(_mm_cvtsi32_si128(four))));
}

/// Returns the numbers with the bits in reverse order. It looks the halves of bytes up.
[[gnu::always_inline]] inline BitOctet reversed(const BitOctet& bits) {
  const auto in_both_halves = [](const __m128i& bytes) {
    return _mm256_broadcastsi128_si256(bytes);
  };
  const __m256i low_half = _mm256_set1_epi8(0x0f);
  const __m128i of_a_half = _mm_setr_epi8(0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15);
  const __m256i to_low_half = in_both_halves(of_a_half);
  const __m256i to_high_half = in_both_halves(_mm_slli_epi32(of_a_half, 4));
  const __m256i bytes_back =
      in_both_halves(_mm_setr_epi8(3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12));
  const auto all = std::bit_cast<__m256i>(bits);
  const __m256i from_low = _mm256_shuffle_epi8(to_high_half, _mm256_and_si256(all, low_half));
  const __m256i from_high =
      _mm256_shuffle_epi8(to_low_half, _mm256_and_si256(_mm256_srli_epi32(all, 4), low_half));
  const __m256i bytes = _mm256_or_si256(from_low, from_high);
  return std::bit_cast<BitOctet>(_mm256_shuffle_epi8(bytes, bytes_back));
}

#endif

}  // namespace crt::core
