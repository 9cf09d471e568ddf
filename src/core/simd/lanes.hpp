// One instruction works at once on numbers side by side: four doubles, floats or integers, or eight
// floats. Each lane has the bits that it would have alone, on every target.
//
// The lanes are those of std::experimental::simd (ISO/IEC TS 19570:2018), for the instruction set
// that the compiler targets. Comparing two of them gives a mask, with a bool for each lane. Masks
// are combined by && || ! (or & |), as bools are.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <experimental/simd>
#include <type_traits>

#ifdef __AVX__
#include <immintrin.h>
#endif

namespace crt::core {

namespace stdx = std::experimental;

// GCC takes much of what follows for too large to be inlined, and does not see that its fma's are
// one instruction. Attributes and intrinsics help it along.

/// SideBySide is `count` numbers side by side.
template <class Number, std::size_t count>
using SideBySide = stdx::simd<Number, stdx::simd_abi::deduce_t<Number, count>>;

inline constexpr std::size_t lane_count = 4;
using Lanes = SideBySide<double, lane_count>;
using LaneMask = Lanes::mask_type;
using WordLanes = SideBySide<std::uint64_t, lane_count>;
using FloatLanes = SideBySide<float, lane_count>;
using IntLanes = SideBySide<std::int32_t, lane_count>;

inline constexpr std::size_t octet_size = 8;
using IntOctet = SideBySide<std::int32_t, octet_size>;
using BitOctet = SideBySide<std::uint32_t, octet_size>;

// ---- masks ----------------------------------------------------------------------------------

/// Returns the lanes of a mask as bits, the first lane's in the lowest bit.
template <class Number, class Abi>
[[gnu::always_inline]] inline std::uint32_t mask_of(const stdx::simd_mask<Number, Abi>& mask) {
  return static_cast<std::uint32_t>(mask.__to_bitset().to_ulong());
}
#if defined(__AVX__) && !defined(__AVX512F__)
[[gnu::always_inline]] inline std::uint32_t mask_of(const LaneMask& mask) {
  return static_cast<std::uint32_t>(_mm256_movemask_pd(std::bit_cast<__m256d>(mask)));
}
#endif

inline std::uint32_t mask_of(bool mask) {
  return mask ? 1 : 0;
}

/// Returns the mask with those bits. Bits above the number of lanes do not count.
template <class Mask>
[[gnu::always_inline]] inline Mask mask_with(std::uint32_t bits) {
  return Mask::__from_bitset(bits);
}
[[gnu::always_inline]] inline LaneMask lanes_with(std::uint32_t bits) {
  return mask_with<LaneMask>(bits);
}

/// Returns the mask for lanes of other numbers of the same size.
template <class Mask, class Number, class Abi>
Mask mask_cast(const stdx::simd_mask<Number, Abi>& mask) {
  if constexpr (std::is_trivially_copyable_v<Mask>) {
    return std::bit_cast<Mask>(mask);
  } else {
    return mask_with<Mask>(mask_of(mask));
  }
}

/// Returns whether a mask is true in all of its lanes, or in any. A bool counts as a mask of one
/// lane.
template <class Number, class Abi>
[[gnu::always_inline]] inline bool all(const stdx::simd_mask<Number, Abi>& mask) {
  return stdx::all_of(mask);
}
template <class Number, class Abi>
[[gnu::always_inline]] inline bool any(const stdx::simd_mask<Number, Abi>& mask) {
  return stdx::any_of(mask);
}
inline bool all(bool a) {
  return a;
}
inline bool any(bool a) {
  return a;
}

/// Returns in each lane the first value where the mask is true, else the second.
template <class Number, class Abi>
[[gnu::always_inline]] inline stdx::simd<Number, Abi> select(
    const stdx::simd_mask<Number, Abi>& mask,
    const std::type_identity_t<stdx::simd<Number, Abi>>& a,
    const std::type_identity_t<stdx::simd<Number, Abi>>& b) {
  stdx::simd<Number, Abi> result = b;
  stdx::where(mask, result) = a;
  return result;
}
template <class Number, class Abi>
[[gnu::always_inline]] inline stdx::simd_mask<Number, Abi> select(
    const stdx::simd_mask<Number, Abi>& mask, const stdx::simd_mask<Number, Abi>& a,
    const stdx::simd_mask<Number, Abi>& b) {
  return (mask && a) || (!mask && b);
}
template <class Value>
Value select(bool first, const Value& a, const std::type_identity_t<Value>& b) {
  return first ? a : b;
}

// ---- numbers --------------------------------------------------------------------------------

inline Lanes lanes_of(double value) {
  return value;
}
/// Returns lanes with a number each.
template <class Result = Lanes, class... Numbers>
requires(sizeof...(Numbers) == lane_count) Result lanes_of(const Numbers&... numbers) {
  using Value = typename Result::value_type;
  const std::array<Value, lane_count> row = {static_cast<Value>(numbers)...};
  return Result(row.data(), stdx::element_aligned);
}

/// Returns -1, which has all bits, in the lanes that have their bit, and 0 in the others.
inline IntLanes int_lanes_with(std::uint32_t bits) {
  return select(mask_with<IntLanes::mask_type>(bits), -1, 0);
}

/// Writes lanes into a column of numbers, from place `first` on.
template <class Numbers, class Column>
void put_lanes(const Numbers& lanes, Column& column, std::size_t first) {
  lanes.copy_to(&column[first], stdx::element_aligned);
}
/// Returns as many numbers of a column as there are lanes.
template <class Numbers, class Number>
Numbers lanes_at(const Number* column) {
  return Numbers(column, stdx::element_aligned);
}

/// Returns the number or the lanes with the same bits.
template <class To, class From>
[[gnu::always_inline]] inline To bits_as(const From& from) {
  if constexpr (std::is_trivially_copyable_v<To> && std::is_trivially_copyable_v<From>) {
    return std::bit_cast<To>(from);
  } else {
    // These are more lanes than the machine has side by side.
    std::array<typename From::value_type, From::size()> numbers;
    from.copy_to(numbers.data(), stdx::element_aligned);
    const auto bits = std::bit_cast<std::array<typename To::value_type, To::size()>>(numbers);
    return To(bits.data(), stdx::element_aligned);
  }
}

/// Returns each number rounded to the nearest float.
inline FloatLanes to_floats(const Lanes& a) {
  return stdx::static_simd_cast<FloatLanes>(a);
}
inline Lanes to_doubles(const FloatLanes& a) {
  return stdx::static_simd_cast<Lanes>(a);
}

/// Returns as bits which of eight numbers in a row are equal to `one`.
[[gnu::always_inline]] inline std::uint32_t which_of_eight(const std::uint32_t* numbers,
                                                           std::uint32_t one) {
  return mask_of(lanes_at<BitOctet>(numbers) == one);
}

/// Returns the columns of four rows.
[[gnu::always_inline]] inline std::array<Lanes, lane_count> transposed(
    const std::array<Lanes, lane_count>& rows) {
  using Row = double __attribute__((vector_size(sizeof(double) * lane_count)));  // to be shuffled
  Row a, b, c, d;
  std::memcpy(&a, &rows[0], sizeof a);
  std::memcpy(&b, &rows[1], sizeof b);
  std::memcpy(&c, &rows[2], sizeof c);
  std::memcpy(&d, &rows[3], sizeof d);
  const Row even_low = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Row odd_low = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Row even_high = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Row odd_high = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  a = __builtin_shufflevector(even_low, even_high, 0, 1, 4, 5);
  b = __builtin_shufflevector(odd_low, odd_high, 0, 1, 4, 5);
  c = __builtin_shufflevector(even_low, even_high, 2, 3, 6, 7);
  d = __builtin_shufflevector(odd_low, odd_high, 2, 3, 6, 7);
  const auto lanes = [](const Row& row) {
    return Lanes(reinterpret_cast<const double*>(&row), stdx::vector_aligned);
  };
  return {lanes(a), lanes(b), lanes(c), lanes(d)};
}

// ---- formulas for one double or for lanes: templates over a Real, which is either ------------

/// MaskOf is what comparing two Reals gives.
template <class Real>
using MaskOf = decltype(Real{} < Real{});

/// The number of lanes that a Real has.
template <class Real>
inline constexpr std::size_t lanes_in = std::is_same_v<Real, double> ? 1 : lane_count;

/// Returns one lane of numbers or of a mask; one number has one lane.
inline double lane_of(double x, std::size_t /*lane*/) {
  return x;
}
inline bool lane_of(bool x, std::size_t /*lane*/) {
  return x;
}
inline double lane_of(const Lanes& x, std::size_t lane) {
  return x[lane];
}
inline bool lane_of(const LaneMask& x, std::size_t lane) {
  return x[lane];
}

/// Sets one lane of numbers; one number has one lane.
inline void set_lane(double& x, std::size_t /*lane*/, double value) {
  x = value;
}
inline void set_lane(Lanes& x, std::size_t lane, double value) {
  x[lane] = value;
}

// Argument-dependent lookup finds those of lanes.
using std::abs;
using std::floor;
using std::sqrt;

using std::clamp;
using std::fma;
using std::max;
using std::min;

// If one of two doubles is NaN, max() returns the first, as std::max() does, and min() the second.
// If one of two floats is NaN, both return the first. Where a minimum and a maximum of the same
// numbers are asked for, GCC would have one comparison and two selections instead of two
// instructions.
#ifdef __AVX__
[[gnu::always_inline]] inline Lanes min(const Lanes& a, const Lanes& b) {
  return std::bit_cast<Lanes>(_mm256_min_pd(std::bit_cast<__m256d>(a), std::bit_cast<__m256d>(b)));
}
[[gnu::always_inline]] inline Lanes max(const Lanes& a, const Lanes& b) {
  return std::bit_cast<Lanes>(_mm256_max_pd(std::bit_cast<__m256d>(b), std::bit_cast<__m256d>(a)));
}
#else
[[gnu::always_inline]] inline Lanes min(const Lanes& a, const Lanes& b) {
  return select(a < b, a, b);
}
[[gnu::always_inline]] inline Lanes max(const Lanes& a, const Lanes& b) {
  return select(a < b, b, a);
}
#endif
[[gnu::always_inline]] inline FloatLanes min(const FloatLanes& a, const FloatLanes& b) {
  return select(b < a, b, a);
}
[[gnu::always_inline]] inline FloatLanes max(const FloatLanes& a, const FloatLanes& b) {
  return select(a < b, b, a);
}
[[gnu::always_inline]] inline Lanes clamp(const Lanes& v, const Lanes& low, const Lanes& high) {
  return min(high, max(v, low));
}

[[gnu::always_inline]] inline Lanes fma(const Lanes& a, const Lanes& b, const Lanes& c) {
#ifdef __FMA__
  return std::bit_cast<Lanes>(_mm256_fmadd_pd(std::bit_cast<__m256d>(a), std::bit_cast<__m256d>(b),
                                              std::bit_cast<__m256d>(c)));
#else
  return Lanes([&](auto i) { return std::fma(a[i], b[i], c[i]); });
#endif
}

/// Returns a b + c, rounded once or twice, whichever is faster. It is of use where a bound on the
/// error covers both.
template <class Real>
[[gnu::always_inline]] inline Real multiply_add(const Real& a, const Real& b, const Real& c) {
#ifdef __FMA__
  return fma(a, b, c);
#else
  return a * b + c;
#endif
}

/// BitsOf has whole numbers of as many bits as a Real's numbers have, by lane.
template <class Real>
using BitsOf = std::conditional_t<std::is_same_v<Real, double>, std::uint64_t, WordLanes>;

/// Returns 1 / x or up to an eighth more, without a quotient, which takes long. x is not negative;
/// above 2^100 the result is that of 2^100. The bits of a number are nearly its logarithm (Blinn,
/// Floating-point tricks, IEEE Computer Graphics and Applications 17(4), 1997).
template <class Real>
[[gnu::always_inline]] inline Real inverse_or_more(const Real& x) {
  using Bits = BitsOf<Real>;
  constexpr std::uint64_t bits_of_one_twice = 0x7fe0000000000000;
  const Real within = min(x, Real(0x1p100));
  return bits_as<Real>(Bits(bits_of_one_twice - bits_as<Bits>(within)));
}

/// Returns the least of all lanes.
inline double least(double x) {
  return x;
}
inline double least(const Lanes& x) {
  return std::min(std::min<double>(x[0], x[1]), std::min<double>(x[2], x[3]));
}

/// Returns a Real whose lanes all hold the number. Numbers that are by lane already stay as they
/// are.
template <class Real>
Real broadcast(double value) {
  return value;
}
template <class Real>
Lanes broadcast(const Lanes& values) {
  return values;
}

/// Returns a mask for a Real from bits in the order of mask_of(). For one number the first bit
/// counts.
template <class Real>
MaskOf<Real> lanes_of_mask(std::uint32_t bits) {
  if constexpr (std::is_same_v<Real, double>) {
    return (bits & 1u) != 0;
  } else {
    return lanes_with(bits);
  }
}

/// Returns the scalar product of vectors by component, of doubles or of lanes, as multiply_add()
/// rounds it.
template <class Real>
[[gnu::always_inline]] inline Real fused_dot(const std::array<Real, 3>& a,
                                             const std::array<Real, 3>& b) {
  return multiply_add(a[2], b[2], multiply_add(a[1], b[1], a[0] * b[0]));
}

/// Returns the scalar product of vectors by component, of doubles or of lanes.
template <class Real>
Real dot(const std::array<Real, 3>& a, const std::array<Real, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace crt::core
