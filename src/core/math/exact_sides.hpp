// On which side of a line or a plane a point is, is decided exactly: by intervals where these tell,
// and else by dyadic numbers.
#pragma once

#include "core/math/dyadic_vector.hpp"
#include "core/math/interval.hpp"

namespace crt::core {

/// Returns 1 if a point of the plane of x and y is to the left of a line, -1 if it is to the right,
/// and 0 if it is on it.
inline int side_of(const Vec3& point, const Vec3& from, const Vec3& to) {
  const auto side = [&](const auto& along, const auto& offset) {
    return along[0] * offset[1] - along[1] * offset[0];
  };
  const auto enclosed = [&](const Vec3& a) {
    return std::array<Interval, 2>{Interval::of(a.x) - Interval::of(from.x),
                                   Interval::of(a.y) - Interval::of(from.y)};
  };
  const Interval about = side(enclosed(to), enclosed(point));
  if (about.lo > 0) return 1;
  if (about.hi < 0) return -1;
  return side(exactly(to) - exactly(from), exactly(point) - exactly(from)).sign();
}

/// Returns 1 if a point is on the side of the plane through a, b and c to which (b - a) x (c - a)
/// points, -1 if it is on the other, and 0 if it is on the plane.
inline int side_of_plane(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto enclosed = [&](const Vec3& p) {
    return std::array<Interval, 3>{Interval::of(p.x) - Interval::of(a.x),
                                   Interval::of(p.y) - Interval::of(a.y),
                                   Interval::of(p.z) - Interval::of(a.z)};
  };
  const auto side = [](const auto& u, const auto& v, const auto& w) {
    return w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) +
           w[2] * (u[0] * v[1] - u[1] * v[0]);
  };
  const Interval about = side(enclosed(b), enclosed(c), enclosed(point));
  if (about.lo > 0) return 1;
  if (about.hi < 0) return -1;
  return side(exactly(b) - exactly(a), exactly(c) - exactly(a), exactly(point) - exactly(a)).sign();
}

}  // namespace crt::core
