// A VectorLanes holds four vectors side by side, by component. Each operation does to every one of
// them what it does to a Vec3, to the last bit.
#pragma once

#include <array>
#include <type_traits>
#include <utility>

#include "core/math/direction_and_length.hpp"
#include "core/math/lanes.hpp"
#include "crt/vec.hpp"

namespace crt::core {

struct VectorLanes {
  Lanes x{};
  Lanes y{};
  Lanes z{};

  /// Returns the component along an axis.
  Lanes& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  const Lanes& operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }

  Vec3 lane(std::size_t index) const { return {x[index], y[index], z[index]}; }
  void set(std::size_t lane, const Vec3& v) {
    x[lane] = v.x;
    y[lane] = v.y;
    z[lane] = v.z;
  }
};

/// Vec3Of<Real> is a Vec3 for a double, and as many of them side by side for lanes.
template <class Real>
using Vec3Of = std::conditional_t<std::is_same_v<Real, double>, Vec3, VectorLanes>;

/// RealOf names the Real of a Vec3Of<Real>.
template <class Vector>
using RealOf = std::decay_t<decltype(std::declval<Vector>().x)>;

/// Returns lanes that all hold the vector.
inline VectorLanes lanes_of(const Vec3& v) {
  return {lanes_of(v.x), lanes_of(v.y), lanes_of(v.z)};
}

/// Returns the vectors one after the other, each with 0 behind its components.
inline std::array<Lanes, lane_count> by_lane(const VectorLanes& v) {
  return transposed({v.x, v.y, v.z, Lanes{}});
}

/// Returns the vector itself, or lanes that all hold it.
template <class Real>
Vec3Of<Real> broadcast(const Vec3& v) {
  return {broadcast<Real>(v.x), broadcast<Real>(v.y), broadcast<Real>(v.z)};
}

inline VectorLanes operator-(const VectorLanes& v) {
  return {-v.x, -v.y, -v.z};
}
inline VectorLanes operator+(const VectorLanes& a, const VectorLanes& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline VectorLanes operator-(const VectorLanes& a, const VectorLanes& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline VectorLanes operator*(const VectorLanes& a, const VectorLanes& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline VectorLanes operator*(const Lanes& factor, const VectorLanes& v) {
  return {factor * v.x, factor * v.y, factor * v.z};
}
inline VectorLanes operator/(const VectorLanes& v, const Lanes& divisor) {
  return {v.x / divisor, v.y / divisor, v.z / divisor};
}

inline VectorLanes operator/(const VectorLanes& a, const VectorLanes& b) {
  return {a.x / b.x, a.y / b.y, a.z / b.z};
}

inline Lanes dot(const VectorLanes& a, const VectorLanes& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline VectorLanes cross(const VectorLanes& a, const VectorLanes& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

[[gnu::always_inline]] inline Lanes largest_component(const VectorLanes& v) {
  return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

// These two work by component.
inline VectorLanes min(const VectorLanes& a, const VectorLanes& b) {
  return {min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)};
}
inline VectorLanes max(const VectorLanes& a, const VectorLanes& b) {
  return {max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)};
}

inline VectorLanes clamp(const VectorLanes& v, const VectorLanes& low, const VectorLanes& high) {
  return min(high, max(v, low));
}

inline VectorLanes floor(const VectorLanes& v) {
  return {floor(v.x), floor(v.y), floor(v.z)};
}

/// Returns in each lane the first vector where the mask is true, else the second.
inline VectorLanes select(const LaneMask& first, const VectorLanes& a, const VectorLanes& b) {
  return {select(first, a.x, b.x), select(first, a.y, b.y), select(first, a.z, b.z)};
}

/// Returns the cross product of each pair, as core/math/vector.hpp computes it.
inline VectorLanes accurate_cross(const VectorLanes& a, const VectorLanes& b) {
  return {difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
          difference_of_products(a.x, b.y, a.y, b.x)};
}

/// Returns the dot product of each pair, as core/math/vector.hpp computes it.
inline DoubleDoubleLanes accurate_dot(const VectorLanes& a, const VectorLanes& b) {
  const DoubleDoubleLanes x = two_product(a.x, b.x);
  const DoubleDoubleLanes y = two_product(a.y, b.y);
  const DoubleDoubleLanes z = two_product(a.z, b.z);
  const DoubleDoubleLanes xy = two_sum(x.hi, y.hi);
  const DoubleDoubleLanes xyz = two_sum(xy.hi, z.hi);
  return two_sum(xyz.hi, xyz.lo + xy.lo + (x.lo + y.lo + z.lo));
}

inline VectorLanes unit_vector(const VectorLanes& v) {
  const VectorLanes scaled = 1.0 / power_of_two_below(largest_component(v)) * v;
  const DoubleDoubleLanes square = accurate_dot(scaled, scaled);
  return scaled / sqrt(square.hi + square.lo);
}

/// Splits four vectors as direction_and_length() splits each, and writes the results where they
/// stay. GCC copies structs by halves of these vectors. A read of a whole one that follows waits
/// until both halves have reached the cache.
inline void directions_and_lengths(const VectorLanes& v, VectorLanes& directions, Lanes& lengths) {
  const Lanes squares = dot(v, v);
  if (all((squares > safe_square_min) & (squares < safe_square_max))) {
    lengths = sqrt(squares);
    directions = v / lengths;
    return;
  }
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const DirectionAndLength one = direction_and_length(v.lane(lane));
    directions.set(lane, one.direction);
    lengths[lane] = one.length;
  }
}

}  // namespace crt::core
