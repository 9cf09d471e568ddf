// The tests of the exact tier share rays through a placement, and whole-number geometry to compare
// with.
#pragma once

#include <array>
#include <cstdint>

#include "core/geometry/exact_shape.hpp"
#include "core/geometry/placement.hpp"
#include "geometry/oracle.hpp"

namespace crt::test {

__extension__ using Whole = __int128;
using WholeVec = std::array<Whole, 3>;

inline WholeVec operator-(const WholeVec& a, const WholeVec& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline WholeVec operator*(Whole s, const WholeVec& v) {
  return {s * v[0], s * v[1], s * v[2]};
}
inline Whole dot(const WholeVec& a, const WholeVec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline WholeVec cross(const WholeVec& a, const WholeVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Vec3 as_vec3(const WholeVec& v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

/// A WholeRay is a ray of small whole numbers in the space of a map of small whole numbers. It is
/// the line (origin + t direction) / weight of object space, all whole.
struct WholeRay {
  WholeVec world_origin, world_direction;
  std::array<WholeVec, 3> rows{WholeVec{1, 0, 0}, WholeVec{0, 1, 0}, WholeVec{0, 0, 1}};
  WholeVec translation{0, 0, 0};

  WholeVec origin{}, direction{};
  Whole weight = 1;  ///< > 0

  void to_object_space() {
    const WholeVec x = cross(rows[1], rows[2]);
    const WholeVec y = cross(rows[2], rows[0]);
    const WholeVec z = cross(rows[0], rows[1]);
    weight = dot(rows[0], x);
    const Whole sign = weight < 0 ? -1 : 1;
    weight *= sign;
    const auto solve = [&](const WholeVec& v) {
      WholeVec result;
      for (std::size_t i = 0; i < 3; ++i)
        result[i] = sign * (x[i] * v[0] + y[i] * v[1] + z[i] * v[2]);
      return result;
    };
    origin = solve(world_origin - translation);
    direction = solve(world_direction);
  }

  Transform transform() const {
    return {as_vec3(rows[0]), as_vec3(rows[1]), as_vec3(rows[2]), as_vec3(translation)};
  }
};

/// Returns numbers so small that much of what they describe touches, meets in edges or coincides.
inline WholeVec small_vector(Random& random, int most) {
  const auto next = [&] {
    return static_cast<Whole>(random.bits() % static_cast<unsigned>(2 * most + 1)) - most;
  };
  const Whole x = next();
  const Whole y = next();
  return {x, y, next()};
}

inline WholeRay small_ray(Random& random) {
  WholeRay ray;
  ray.world_origin = small_vector(random, 6);
  do ray.world_direction = small_vector(random, 3);
  while (dot(ray.world_direction, ray.world_direction) == 0);
  if (!random.one_in(3)) ray.translation = small_vector(random, 4);
  if (random.one_in(3)) {
    do {
      for (WholeVec& row : ray.rows) row = small_vector(random, 2);
    } while (dot(ray.rows[0], cross(ray.rows[1], ray.rows[2])) == 0);
  }
  ray.to_object_space();
  return ray;
}

/// Returns the crossings of the exact tier with a ray in the world.
inline core::CrossingList exact_crossings(const Primitive& primitive, const Transform& to_world,
                                          const Vec3& origin, const Vec3& direction,
                                          const core::FaceStart& start = {}) {
  const core::Placement placement{core::PreciseTransform(to_world)};
  std::uint64_t escalations = 0;
  core::ObjectRay object_ray = placement.to_object(origin, direction);
  object_ray.start = start;
  core::ExactRay ray = placement.to_object_exactly(origin, direction, object_ray);
  ray.escalations = &escalations;
  core::CrossingList result;
  core::make_exact_shape(primitive)->crossings(ray, result);
  return result;
}
inline core::CrossingList exact_crossings(const Primitive& primitive, const WholeRay& ray) {
  return exact_crossings(primitive, ray.transform(), as_vec3(ray.world_origin),
                         as_vec3(ray.world_direction));
}

/// Returns whether t is within 0.51 ulp of the true value, and t + t_low within its error bound.
inline bool is_last_bit(const core::Crossing& crossing, Real truth) {
  const Real ulp = std::nextafter(std::abs(crossing.t), HUGE_VAL) - std::abs(crossing.t);
  const Real tolerance =
      magnitude(truth) * 0x1p-105;  // the error of the truth itself, in quadruple precision
  return magnitude(Real{crossing.t} - truth) <= 0.51 * ulp + tolerance &&
         magnitude(Real{crossing.t} + Real{crossing.t_low} - truth) <=
             Real{crossing.error} + tolerance;
}

}  // namespace crt::test
