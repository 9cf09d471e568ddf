// On which side of a line or a plane a point is, is decided exactly: by intervals where these tell,
// and else by dyadic numbers.
#pragma once

#include "core/geometry/face_functions.hpp"
#include "core/math/dyadic_vector.hpp"

namespace crt::core {

/// Returns the sign of a polynomial of the ways from one point to others.
template <class Polynomial, class... Points>
int exact_sign(const Polynomial& polynomial, const Vec3& origin, const Points&... points) {
  const Interval about = polynomial(relative_to(known_point(points), origin)...);
  if (about.lo > 0) return 1;
  if (about.hi < 0) return -1;
  return polynomial((exactly(points) - exactly(origin))...).sign();
}

/// Returns 1 if a point of the plane of x and y is to the left of a line, -1 if it is to the right,
/// and 0 if it is on it.
inline int side_of(const Vec3& point, const Vec3& from, const Vec3& to) {
  return exact_sign([](const auto& along,
                       const auto& offset) { return along[0] * offset[1] - along[1] * offset[0]; },
                    from, to, point);
}

/// Returns 1 if a point is on the side of the plane through a, b and c to which (b - a) x (c - a)
/// points, -1 if it is on the other, and 0 if it is on the plane.
inline int side_of_plane(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c) {
  return exact_sign(
      [](const auto& u, const auto& v, const auto& w) {
        return w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) +
               w[2] * (u[0] * v[1] - u[1] * v[0]);
      },
      a, b, c, point);
}

}  // namespace crt::core
