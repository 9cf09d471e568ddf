// A ray of the exact tier is known nearly exactly at once, and exactly where that is not enough.
#pragma once

#include <array>
#include <limits>

#include "core/math/dyadic_vector.hpp"
#include "core/math/transform_chain.hpp"
#include "core/ray/object_ray.hpp"
#include "crt/transform.hpp"

namespace crt::core {

/// An ExactLine is a line in object space without any rounding: (origin + t direction) / weight,
/// with weight > 0. The division that the inverse of a transform needs is never carried out.
struct ExactLine {
  DyadicVector origin;
  DyadicVector direction;
  Dyadic weight = 1;
};

/// Returns the line that a ray's own numbers say.
inline ExactLine exact_line(const ObjectRay& ray) {
  return {.origin = exactly(ray.origin) + exactly(ray.origin_low),
          .direction = exactly(ray.direction) + exactly(ray.direction_low)};
}

/// t must be known so exactly for its rounding to be within 0.51 ulp.
inline constexpr double last_bit_tolerance = 0x1p-60;

struct ExactRay {
  /// This is the ray in object space, to about 100 bits. It must outlive the ExactRay.
  const ObjectRay& near;
  /// Each component of origin and direction has at most this error.
  double origin_error = 0;
  double direction_error = 0;
  // The ray is kept in the world, too, with the map from object space (none for the identity).
  Vec3 world_origin{0, 0, 0};
  Vec3 world_direction{0, 0, 1};
  const Transform* to_world = nullptr;
  const TransformChain* chain = nullptr;  ///< that map, if it is more than twelve doubles
  /// A ray that starts on a surface has a rounded origin. What it meets at |t| below this cannot be
  /// distinguished from the start.
  double start_error = 0;
  /// Counts the exact fallbacks: the calls of exact().
  std::uint64_t* escalations = nullptr;

  ExactLine exact() const;

  /// Returns the same ray with another `near`, which must outlive it: one that differs in where it
  /// starts, or in what is asked.
  ExactRay seen_as(const ObjectRay& other) const {
    return {.near = other,
            .origin_error = origin_error,
            .direction_error = direction_error,
            .world_origin = world_origin,
            .world_direction = world_direction,
            .to_world = to_world,
            .chain = chain,
            .start_error = start_error,
            .escalations = escalations};
  }

  /// Returns whether a t with at most this error is known well enough. That is to its last bit, or
  /// only to its side where it cannot be distinguished from the start.
  bool is_settled(double t, double error) const {
    constexpr double at_start_tolerance = 0x1p-20;
    const double size = std::abs(t);
    return error <= last_bit_tolerance * size ||
           (size < start_error && error <= at_start_tolerance * size);
  }

  /// Returns a bound on the error of each component of a point p(t) - center that is computed in
  /// double-double.
  double point_error(const Vec3& center, double t) const;
};

inline PreciseVec3 precise_direction(const ObjectRay& ray) {
  return {DoubleDouble(ray.direction.x, ray.direction_low.x),
          DoubleDouble(ray.direction.y, ray.direction_low.y),
          DoubleDouble(ray.direction.z, ray.direction_low.z)};
}

/// Returns p(t + t_low) - center to about 100 bits.
PreciseVec3 precise_from_center(const ObjectRay& ray, const Vec3& center, DoubleDouble t);

/// Returns a . b to about 100 bits of the largest product.
/// Source: Ogita, Rump, Oishi, Accurate sum and dot product, 2005 (Dot2), for factors of two
/// doubles each.
inline DoubleDouble precise_dot(const PreciseVec3& a, const PreciseVec3& b) {
  const DoubleDouble x = two_product(a[0].hi, b[0].hi);
  const DoubleDouble y = two_product(a[1].hi, b[1].hi);
  const DoubleDouble z = two_product(a[2].hi, b[2].hi);
  const DoubleDouble xy = two_sum(x.hi, y.hi);
  const DoubleDouble xyz = two_sum(xy.hi, z.hi);
  double low = xyz.lo + xy.lo + (x.lo + y.lo + z.lo);
  for (std::size_t i = 0; i < 3; ++i) low += std::fma(a[i].hi, b[i].lo, a[i].lo * b[i].hi);
  return two_sum(xyz.hi, low);
}

/// Returns a x b, each component to about 100 bits of the larger product.
inline PreciseVec3 precise_cross(const PreciseVec3& a, const PreciseVec3& b) {
  const auto component = [&](std::size_t i, std::size_t j) {
    const DoubleDouble x = two_product(a[i].hi, b[j].hi);
    const DoubleDouble y = two_product(a[j].hi, b[i].hi);
    const double low = std::fma(a[i].hi, b[j].lo, a[i].lo * b[j].hi) -
                       std::fma(a[j].hi, b[i].lo, a[j].lo * b[i].hi);
    const DoubleDouble difference = two_sum(x.hi, -y.hi);
    return two_sum(difference.hi, difference.lo + (x.lo - y.lo) + low);
  };
  return {component(1, 2), component(2, 0), component(0, 1)};
}

inline double sum_of_sizes(const PreciseVec3& v) {
  return std::abs(v[0].hi) + std::abs(v[1].hi) + std::abs(v[2].hi);
}

/// This is the relative error of results of double-double arithmetic: a few of its roundings of
/// 2^-105.
inline constexpr double precise_roundoff = 0x1p-100;

}  // namespace crt::core
