// Vector arithmetic that is accurate where cancellation matters, and exact scaling by powers of
// two, are here.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>

#include "core/math/double_double.hpp"
#include "crt/vec.hpp"

namespace crt::core {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// This is the largest relative error of one rounding, u in the comments.
inline constexpr double unit_roundoff = 0x1p-53;

/// Returns at least half an ulp of x.
inline double rounding_of(double x) {
  return unit_roundoff * std::abs(x);
}

/// Returns whether squares of such sizes, and of what matters beside them, are normal numbers.
inline bool has_fair_size(double size) {
  constexpr double smallest = 0x1p-300;
  constexpr double largest = 0x1p300;
  return size > smallest && size < largest;
}

inline double largest_component(const Vec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Returns the power of two with 1 <= x / power < 2, for finite x > 0. Where x is smaller than
/// 2^-1022 it returns 2^-1022, so that the inverse is always finite.
inline double power_of_two_below(double x) {
  constexpr std::uint64_t exponent_bits = 0x7ff0000000000000u;
  constexpr std::uint64_t smallest = 0x0010000000000000u;
  return std::bit_cast<double>(std::max(std::bit_cast<std::uint64_t>(x) & exponent_bits, smallest));
}

/// Returns 1 / x for a power of two whose inverse is a normal number. It avoids a division, which
/// is slow.
inline double inverse_of_power(double x) {
  constexpr std::uint64_t inverse_of_one = 0x7fe0000000000000u;  // twice the bits of 1
  return std::bit_cast<double>(inverse_of_one - std::bit_cast<std::uint64_t>(x));
}

/// Returns a b - c d with about one rounding of the result, however much cancels.
/// Source: Jeannerod, Louvet, Muller, Further analysis of Kahan's algorithm, 2013.
inline double difference_of_products(double a, double b, double c, double d) {
  const double product = c * d;
  const double rest = std::fma(-c, d, product);
  return std::fma(a, b, -product) + rest;
}

/// Returns the cross product, each component with about one rounding. So small angles keep all
/// their digits.
inline Vec3 accurate_cross(const Vec3& a, const Vec3& b) {
  return {difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
          difference_of_products(a.x, b.y, a.y, b.x)};
}

/// Returns the dot product as if computed in twice the precision.
/// Source: Ogita, Rump, Oishi, Accurate sum and dot product, 2005 (Dot2).
inline DoubleDouble accurate_dot(const Vec3& a, const Vec3& b) {
  const DoubleDouble x = two_product(a.x, b.x);
  const DoubleDouble y = two_product(a.y, b.y);
  const DoubleDouble z = two_product(a.z, b.z);
  const DoubleDouble xy = two_sum(x.hi, y.hi);
  const DoubleDouble xyz = two_sum(xy.hi, z.hi);
  return two_sum(xyz.hi, xyz.lo + xy.lo + (x.lo + y.lo + z.lo));
}

/// Returns the axis that v runs along, 0 to 2, or -1 if more than one component is not 0.
inline int coordinate_axis(const Vec3& v) {
  if (v.y == 0 && v.z == 0) return 0;
  if (v.x == 0 && v.z == 0) return 1;
  if (v.x == 0 && v.y == 0) return 2;
  return -1;
}

/// Returns v times the power of two that brings its largest component into [1, 2). The result is
/// exact, but for components that are 2^-1000 of the largest.
inline Vec3 scaled_to_one(const Vec3& v) {
  return v * (1 / power_of_two_below(largest_component(v)));
}

/// Returns v, which is not 0, scaled to length 1. The result is exact for a coordinate axis.
inline Vec3 unit_vector(const Vec3& v) {
  const Vec3 scaled = scaled_to_one(v);
  const double length = std::sqrt(accurate_dot(scaled, scaled).value());
  return {scaled.x / length, scaled.y / length, scaled.z / length};
}

}  // namespace crt::core
