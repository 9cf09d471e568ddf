// Every primitive must pass these checks, against an oracle in quadruple precision that shares
// nothing with the library. It takes candidate roots of the textbook equations. Of the spans
// between them those count whose middle is inside by the textbook inequality.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/geometry/shape.hpp"
#include "geometry/random.hpp"
#include "support/quad.hpp"

namespace crt::test {

using Real = Quad;

Real square_root(Real x);
inline Real magnitude(Real x) {
  return x < 0 ? -x : x;
}

struct RealVec {
  Real x = 0, y = 0, z = 0;
  RealVec() = default;
  RealVec(Real x_, Real y_, Real z_) : x(x_), y(y_), z(z_) {}
  explicit RealVec(const Vec3& v) : x(v.x), y(v.y), z(v.z) {}
  Real& operator[](int axis) { return axis == 0 ? x : (axis == 1 ? y : z); }
  Real operator[](int axis) const { return axis == 0 ? x : (axis == 1 ? y : z); }
};
inline RealVec operator+(const RealVec& a, const RealVec& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline RealVec operator-(const RealVec& a, const RealVec& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline RealVec operator*(Real s, const RealVec& v) {
  return {s * v.x, s * v.y, s * v.z};
}
inline Real dot(const RealVec& a, const RealVec& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline RealVec cross(const RealVec& a, const RealVec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Real length(const RealVec& v) {
  return square_root(dot(v, v));
}
inline RealVec normalized(const RealVec& v) {
  return (1 / length(v)) * v;
}

/// A RealRay is a ray without rounding.
struct RealRay {
  RealVec origin;
  RealVec direction;
  explicit RealRay(const core::ObjectRay& ray)
      : origin(RealVec(ray.origin) + RealVec(ray.origin_low)),
        direction(RealVec(ray.direction) + RealVec(ray.direction_low)) {}
  RealVec at(Real t) const { return origin + t * direction; }
};

/// Returns the real roots of a x^2 + 2 b x + c.
std::vector<Real> quadratic_roots(Real a, Real b, Real c);
/// Returns where the ray meets the plane, if it does.
std::vector<Real> plane_roots(const RealRay& ray, const RealVec& normal, const RealVec& position);

/// A Subject is a primitive with its oracle.
struct Subject {
  Primitive primitive;
  Vec3 center;  ///< rays are aimed near here
  double size;  ///< at about this distance from the center
  /// Returns all parameters at which the ray might go through the boundary.
  std::function<std::vector<Real>(const RealRay&)> candidates;
  /// Returns for solids the distance from the boundary, to first order, negative inside. For
  /// surfaces it is the height over the plane, out of which `on_surface` cuts the surface.
  std::function<Real(const RealVec&)> field;
  std::function<bool(const RealVec&)> on_surface = nullptr;
};
using MakeSubject = std::function<Subject(Random&)>;

/// Checks that crossings are those of the oracle within their error bounds, which are as tight as
/// promised. Like the checks below, it makes `count` random subjects and rays, and uses REQUIRE.
void check_against_oracle(const MakeSubject& make, int count);
/// Checks that scaling all lengths by a power of two gives the same bits.
void check_scaling(const MakeSubject& make, int count);
/// Checks that a ray turned round has the same crossings in reverse, within the bounds.
void check_reversal(const MakeSubject& make, int count);
/// Checks that points are on the surface and within the bounds, and that normals follow the
/// gradient. (u, v) must be finite, and in [0, 1] if `unit_square`.
void check_surface_points(const MakeSubject& make, int count, bool unit_square);
/// Checks that rays that start on the surface have a root at exactly 0 or graze, and agree with
/// their side. Rays must never meet convex solids and surfaces again from outside, and must always
/// leave solids from inside.
void check_starts(const MakeSubject& make, int count, bool convex);

/// Returns the primitive with all lengths times `factor`.
Primitive scaled(const Primitive& primitive, double factor);

}  // namespace crt::test
