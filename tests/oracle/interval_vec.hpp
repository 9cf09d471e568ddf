// What the parts of the oracle share: vectors of intervals, and which primitives are what.
#pragma once

#include <array>
#include <type_traits>

#include "crt/primitives.hpp"
#include "oracle/interval.hpp"

namespace crt::test {

using IntervalVec = std::array<Interval, 3>;

inline IntervalVec exactly(const Vec3& v) {
  return {Interval(v.x), Interval(v.y), Interval(v.z)};
}
inline IntervalVec operator+(const IntervalVec& a, const IntervalVec& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline IntervalVec operator-(const IntervalVec& a, const IntervalVec& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline IntervalVec operator*(const Interval& a, const IntervalVec& b) {
  return {a * b[0], a * b[1], a * b[2]};
}
inline Interval dot(const IntervalVec& a, const IntervalVec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Interval squared(const IntervalVec& a) {
  return square(a[0]) + square(a[1]) + square(a[2]);
}
inline Interval length(const IntervalVec& a) {
  return sqrt(squared(a));
}
inline IntervalVec cross(const IntervalVec& a, const IntervalVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// A truncated cone, or a cylinder.
struct Frustum {
  Vec3 from;
  Vec3 to;
  double radius;
  double radius2;
};

inline Frustum frustum_of(const Cylinder& c) {
  return {c.from, c.to, c.radius, c.radius};
}
inline Frustum frustum_of(const Cone& c) {
  return {c.from, c.to, c.radius, c.radius2};
}

inline IntervalVec normal_of(const Triangle& t) {
  return cross(exactly(t.b) - exactly(t.a), exactly(t.c) - exactly(t.a));
}
/// The primitives without an inside.
template <class P>
constexpr bool is_surface =
    std::is_same_v<P, Disc> || std::is_same_v<P, HalfPlane> || std::is_same_v<P, Triangle>;

inline Vec3 position_of(const Disc& d) {
  return d.center;
}
inline Vec3 position_of(const HalfPlane& h) {
  return h.position;
}
inline Vec3 position_of(const Triangle& t) {
  return t.a;
}

}  // namespace crt::test
