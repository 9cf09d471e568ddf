// Four doubles side by side: what vector instructions do in one step, on every target with the same
// bits as one by one. Vectors of GCC and Clang, which turn them into what the machine has.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#ifdef __AVX__
#include <immintrin.h>
#endif

namespace crt::core {

using Lanes = double __attribute__((vector_size(32)));
/// What comparing two of them gives: all bits of a lane set where it is true.
using LaneMask = decltype(Lanes{} < Lanes{});
inline constexpr int lane_count = 4;

/// As many whole numbers of 64 bits, of which these may be the bits.
using WordLanes = std::uint64_t __attribute__((vector_size(32)));

/// As many floats, and integers of their size.
using FloatLanes = float __attribute__((vector_size(16)));
using IntLanes = std::int32_t __attribute__((vector_size(16)));

/// Into a column of numbers, from one on; of any kind of lanes.
template <class Numbers, class Column>
void put_lanes(const Numbers& lanes, Column& column, std::size_t first) {
  std::memcpy(&column[first], &lanes, sizeof lanes);
}

/// As many of such numbers.
template <class Numbers, class Number>
Numbers lanes_at(const Number* column) {
  Numbers lanes;
  std::memcpy(&lanes, column, sizeof lanes);
  return lanes;
}

// Where GCC does not see that there is one instruction for all lanes it is named; the bits are the
// same.

/// Each rounded to the nearest float.
inline FloatLanes to_floats(const Lanes& a) {
  return __builtin_convertvector(a, FloatLanes);
}
inline Lanes to_doubles(const FloatLanes& a) {
#ifdef __AVX__
  return _mm256_cvtps_pd(a);
#else
  return __builtin_convertvector(a, Lanes);
#endif
}

inline FloatLanes min(const FloatLanes& a, const FloatLanes& b) {
  return b < a ? b : a;
}

inline FloatLanes max(const FloatLanes& a, const FloatLanes& b) {
  return a < b ? b : a;
}

inline Lanes lanes_of(double value) {
  return Lanes{value, value, value, value};
}

/// Whether a comparison is true in all lanes, or in any.
inline bool all(const LaneMask& mask) {
#ifdef __AVX__
  return _mm256_movemask_pd(reinterpret_cast<__m256d>(mask)) == (1 << lane_count) - 1;
#else
  return (mask[0] & mask[1] & mask[2] & mask[3]) != 0;
#endif
}

inline bool any(const LaneMask& mask) {
#ifdef __AVX__
  return _mm256_movemask_pd(reinterpret_cast<__m256d>(mask)) != 0;
#else
  return (mask[0] | mask[1] | mask[2] | mask[3]) != 0;
#endif
}

/// The lanes of a comparison as bits.
inline std::uint32_t mask_of(const LaneMask& lanes) {
#ifdef __AVX__
  return static_cast<std::uint32_t>(_mm256_movemask_pd(reinterpret_cast<__m256d>(lanes)));
#else
  std::uint32_t mask = 0;
  for (int i = 0; i < lane_count; ++i) mask |= lanes[i] != 0 ? 1u << i : 0u;
  return mask;
#endif
}

inline std::uint32_t mask_of(const IntLanes& lanes) {
#ifdef __AVX__
  return static_cast<std::uint32_t>(_mm_movemask_ps(reinterpret_cast<__m128>(lanes)));
#else
  std::uint32_t mask = 0;
  for (int i = 0; i < lane_count; ++i) mask |= lanes[i] != 0 ? 1u << i : 0u;
  return mask;
#endif
}

/// Those of which the bit is set.
inline LaneMask lanes_with(std::uint32_t mask) {
  constexpr LaneMask bits = {1, 2, 4, 8};
  return (bits & static_cast<std::int64_t>(mask)) != 0;
}

inline IntLanes int_lanes_with(std::uint32_t mask) {
  constexpr IntLanes bits = {1, 2, 4, 8};
  return (bits & static_cast<std::int32_t>(mask)) != 0;
}

/// Which of eight numbers in a row are that one, as bits.
inline std::uint32_t which_of_eight(const std::uint32_t* numbers, std::uint32_t one) {
#ifdef __AVX2__
  const __m256i row = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(numbers));
  const __m256i equal = _mm256_cmpeq_epi32(row, _mm256_set1_epi32(static_cast<int>(one)));
  return static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(equal)));
#else
  std::uint32_t mask = 0;
  for (std::uint32_t i = 0; i < 8; ++i) mask |= numbers[i] == one ? 1u << i : 0u;
  return mask;
#endif
}

inline Lanes min(const Lanes& a, const Lanes& b) {
#ifdef __AVX__
  return _mm256_min_pd(a, b);
#else
  return a < b ? a : b;
#endif
}

inline Lanes max(const Lanes& a, const Lanes& b) {
#ifdef __AVX__
  return _mm256_max_pd(b, a);
#else
  return a < b ? b : a;
#endif
}

/// v between the two.
inline Lanes clamp(const Lanes& v, const Lanes& low, const Lanes& high) {
  return min(high, max(v, low));
}

inline Lanes sqrt(const Lanes& a) {
#ifdef __AVX__
  return _mm256_sqrt_pd(a);
#else
  Lanes result{};
  for (int i = 0; i < lane_count; ++i) result[i] = std::sqrt(a[i]);
  return result;
#endif
}

inline Lanes fma(const Lanes& a, const Lanes& b, const Lanes& c) {
#ifdef __FMA__
  return _mm256_fmadd_pd(a, b, c);
#else
  Lanes result;
  for (int i = 0; i < lane_count; ++i) result[i] = std::fma(a[i], b[i], c[i]);
  return result;
#endif
}

inline Lanes floor(const Lanes& a) {
#ifdef __AVX__
  return _mm256_floor_pd(a);
#else
  Lanes result;
  for (int i = 0; i < lane_count; ++i) result[i] = std::floor(a[i]);
  return result;
#endif
}

// Formulas for one double or for lanes: templates over a Real, which is either. Comparing doubles
// gives a bool, and comparing lanes a mask of lanes.

/// What comparing gives.
template <class Real>
using MaskOf = decltype(Real{} < Real{});

using std::clamp;
using std::floor;
using std::fma;
using std::max;
using std::min;

inline bool all(bool a) {
  return a;
}
inline bool any(bool a) {
  return a;
}

inline bool both(bool a, bool b) {
  return a && b;
}
inline LaneMask both(const LaneMask& a, const LaneMask& b) {
  return a & b;
}
inline bool either(bool a, bool b) {
  return a || b;
}
inline LaneMask either(const LaneMask& a, const LaneMask& b) {
  return a | b;
}
template <class Mask, class... More>
Mask either(const Mask& a, const Mask& b, const More&... more) {
  return either(either(a, b), more...);
}
/// The first and not the second.
inline bool without(bool a, bool b) {
  return a && !b;
}
inline LaneMask without(const LaneMask& a, const LaneMask& b) {
  return a & ~b;
}
inline bool neither(bool a, bool b) {
  return !a && !b;
}
inline LaneMask neither(const LaneMask& a, const LaneMask& b) {
  return ~(a | b);
}

inline double square_root(double x) {
  return std::sqrt(x);
}
inline Lanes square_root(const Lanes& x) {
  return sqrt(x);
}

/// The absolute value.
inline double abs(double x) {
  return std::abs(x);
}
inline Lanes abs(const Lanes& x) {
#ifdef __AVX__
  return _mm256_andnot_pd(lanes_of(-0.0), x);
#else
  Lanes result;
  for (int i = 0; i < lane_count; ++i) result[i] = std::abs(x[i]);
  return result;
#endif
}

/// The least of all lanes.
inline double least(double x) {
  return x;
}
inline double least(const Lanes& x) {
  return std::min(std::min(x[0], x[1]), std::min(x[2], x[3]));
}

/// Of four rows the columns.
inline std::array<Lanes, lane_count> transposed(const std::array<Lanes, lane_count>& rows) {
  const Lanes even_low = __builtin_shufflevector(rows[0], rows[1], 0, 4, 2, 6);
  const Lanes odd_low = __builtin_shufflevector(rows[0], rows[1], 1, 5, 3, 7);
  const Lanes even_high = __builtin_shufflevector(rows[2], rows[3], 0, 4, 2, 6);
  const Lanes odd_high = __builtin_shufflevector(rows[2], rows[3], 1, 5, 3, 7);
  return {__builtin_shufflevector(even_low, even_high, 0, 1, 4, 5),
          __builtin_shufflevector(odd_low, odd_high, 0, 1, 4, 5),
          __builtin_shufflevector(even_low, even_high, 2, 3, 6, 7),
          __builtin_shufflevector(odd_low, odd_high, 2, 3, 6, 7)};
}

/// The same number in a Real, which is a double or lanes.
template <class Real>
Real broadcast(double value) {
  if constexpr (std::is_same_v<Real, double>) {
    return value;
  } else {
    return lanes_of(value);
  }
}

/// Numbers that are by lane already.
template <class Real>
Lanes broadcast(const Lanes& values) {
  return values;
}

/// A mask for a Real, of bits as mask_of() has them; of one number the first.
template <class Real>
auto lanes_of_mask(std::uint32_t bits) {
  if constexpr (std::is_same_v<Real, double>) {
    return (bits & 1u) != 0;
  } else {
    return lanes_with(bits);
  }
}

/// Of vectors by component, of doubles or of lanes.
template <class Real>
Real dot(const std::array<Real, 3>& a, const std::array<Real, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace crt::core
