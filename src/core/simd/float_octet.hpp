// Eight floats side by side, for what is decided roughly and made certain elsewhere. As lanes.hpp
// has it for doubles.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#ifdef __AVX__
#include <immintrin.h>
#endif

namespace crt::core {

using FloatOctet = float __attribute__((vector_size(32)));
/// What comparing two of them gives, and whole numbers of their size.
using OctetMask = decltype(FloatOctet{} < FloatOctet{});
inline constexpr std::size_t octet_size = 8;

// Where GCC does not see that there is one instruction for all it is named.

/// The results of a comparison as bits.
inline std::uint32_t mask_of(const OctetMask& octet) {
#ifdef __AVX__
  return static_cast<std::uint32_t>(_mm256_movemask_ps(reinterpret_cast<__m256>(octet)));
#else
  std::uint32_t mask = 0;
  for (std::size_t i = 0; i < octet_size; ++i) mask |= octet[i] != 0 ? 1u << i : 0u;
  return mask;
#endif
}

inline FloatOctet min(const FloatOctet& a, const FloatOctet& b) {
#ifdef __AVX__
  return _mm256_min_ps(a, b);
#else
  return a < b ? a : b;
#endif
}

inline FloatOctet max(const FloatOctet& a, const FloatOctet& b) {
#ifdef __AVX__
  return _mm256_max_ps(a, b);
#else
  return a > b ? a : b;
#endif
}

inline FloatOctet sqrt(const FloatOctet& a) {
#ifdef __AVX__
  return _mm256_sqrt_ps(a);
#else
  FloatOctet result;
  for (std::size_t i = 0; i < octet_size; ++i) result[i] = std::sqrt(a[i]);
  return result;
#endif
}

/// a b + c, rounded once or twice: of use where a bound on the error covers both.
inline FloatOctet multiply_add(const FloatOctet& a, const FloatOctet& b, const FloatOctet& c) {
#ifdef __FMA__
  return _mm256_fmadd_ps(a, b, c);
#else
  return a * b + c;
#endif
}

}  // namespace crt::core
