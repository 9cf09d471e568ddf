// The parts of the oracle share this: vectors of numbers, and which primitives are what.
#pragma once

#include <algorithm>
#include <array>
#include <numbers>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "core/geometry/height_field/grid.hpp"
#include "core/geometry/mesh/triangles.hpp"
#include "core/geometry/profile/profile.hpp"
#include "core/geometry/revolution/turned_walls.hpp"
#include "core/math/double_double.hpp"
#include "crt/error.hpp"
#include "crt/primitives.hpp"
#include "oracle/interval.hpp"

namespace crt::test {

template <class Number>
using NumberVec = std::array<Number, 3>;
using IntervalVec = NumberVec<Interval>;

template <class Number>
NumberVec<Number> exactly(const Vec3& v) {
  return {Number(v.x), Number(v.y), Number(v.z)};
}
template <class Number>
NumberVec<Number> operator+(const NumberVec<Number>& a, const NumberVec<Number>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class Number>
NumberVec<Number> operator-(const NumberVec<Number>& a, const NumberVec<Number>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class Number>
NumberVec<Number> operator*(const Number& a, const NumberVec<Number>& b) {
  return {a * b[0], a * b[1], a * b[2]};
}
template <class Number>
Number dot(const NumberVec<Number>& a, const NumberVec<Number>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class Number>
Number squared(const NumberVec<Number>& a) {
  return square(a[0]) + square(a[1]) + square(a[2]);
}
template <class Number>
Number length(const NumberVec<Number>& a) {
  return sqrt(squared(a));
}
template <class Number>
NumberVec<Number> cross(const NumberVec<Number>& a, const NumberVec<Number>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class Number>
Ball<4> as_ball(const Number& number) {
  if constexpr (std::is_same_v<Number, Interval>) {
    return number.ball();
  } else {
    return Ball<4>(number);
  }
}

/// Returns the vector in doubles, for what need not be exact.
template <class Number>
Vec3 rounded(const NumberVec<Number>& v) {
  return {v[0].value(), v[1].value(), v[2].value()};
}

/// A Frustum is a truncated cone, or a cylinder.
struct Frustum {
  Vec3 from;
  Vec3 to;
  double radius;
  double radius2;
};

inline Frustum frustum_of(const Cylinder& c) {
  return {c.from, c.to, c.radius, c.radius};
}
inline Frustum frustum_of(const Capsule& c) {
  return {c.from, c.to, c.radius, c.radius};
}
inline Frustum frustum_of(const Cone& c) {
  return {c.from, c.to, c.radius, c.radius2};
}

template <class Number>
NumberVec<Number> normal_of(const Triangle& t) {
  const NumberVec<Number> a = exactly<Number>(t.a);
  return cross(exactly<Number>(t.b) - a, exactly<Number>(t.c) - a);
}

/// Returns the triangles of a mesh. Those of this oracle are tetrahedra, which are convex.
inline std::vector<Triangle> triangles_of(const Mesh& mesh) {
  std::vector<Triangle> result;
  for (std::uint32_t i = 0; i < mesh.triangles->size(); ++i) {
    result.push_back(mesh.triangles->triangle(i));
  }
  return result;
}
/// Returns a tetrahedron, or a mesh without triangles if one of its sides has no area.
inline Mesh tetrahedron(const std::array<Vec3, 4>& corners) {
  constexpr std::array<TriangleIndices, 4> sides = {
      TriangleIndices{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  try {
    const auto triangles = mesh_triangles(corners, sides);
    if (triangles->size() == sides.size()) return {.triangles = triangles};
  } catch (const Error&) {
    // No side has an area.
  }
  return {};
}

/// Returns a profile of a triangle whose last side is an arc, or none if that has no area or fewer
/// corners.
inline std::shared_ptr<const Profile> arched_triangle(const std::array<Vec3, 3>& corners,
                                                      double bulge) {
  const auto& [a, b, c] = corners;
  const Contour contour = {{a.x, a.y, bulge}, {b.x, b.y}, {c.x, c.y}};
  try {
    const auto profile = make_profile(std::array{contour});
    return profile->pieces().size() == corners.size() ? profile : nullptr;
  } catch (const Error&) {
    return nullptr;
  }
}

/// An ArchedTriangle is the profile of the extrusions and revolutions of this oracle: a triangle,
/// and the segment of a disc that is added to it or taken away.
struct ArchedTriangle {
  std::array<Vec3, 3> corners;
  Vec3 center;
  double radius;
  bool is_right;  ///< the segment is to the right of the side from the last corner to the first

  explicit ArchedTriangle(const Profile& profile)
      : center(profile.arcs()[0].center),
        radius(profile.arcs()[0].radius),
        is_right(profile.arcs()[0].is_right) {
    for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = profile.pieces()[i].from;
  }
  const Vec3& from(std::size_t side) const { return corners[side]; }
  const Vec3& to(std::size_t side) const { return corners[(side + 1) % 3]; }
  /// Returns the normal of a side to its right.
  template <class Number>
  NumberVec<Number> normal(std::size_t side) const {
    const NumberVec<Number> along = exactly<Number>(to(side)) - exactly<Number>(from(side));
    return {along[1], -along[0], Number(0.0)};
  }
};

/// A CornerField is a height field of this oracle: four heights, which two triangles join.
struct CornerField {
  Vec3 lower;
  Vec3 upper;
  /// The first and the second triangle have the diagonal from the first corner to the third.
  std::array<Vec3, 4> tops;

  explicit CornerField(const HeightField& field)
      : lower(glm::min(field.corner_a, field.corner_b)),
        upper(glm::max(field.corner_a, field.corner_b)) {
    const auto top = [&](std::uint32_t column, std::uint32_t row) {
      const double height = field.heights->height(column, row);
      const double y = std::min(lower.y + height * (upper.y - lower.y), upper.y);
      return Vec3(column == 0 ? lower.x : upper.x, height == 1 ? upper.y : y,
                  row == 0 ? lower.z : upper.z);
    };
    tops = {top(0, 0), top(0, 1), top(1, 1), top(1, 0)};
  }
  std::array<Triangle, 2> triangles() const {
    return {Triangle{.a = tops[0], .b = tops[1], .c = tops[2]},
            Triangle{.a = tops[0], .b = tops[2], .c = tops[3]}};
  }
  /// Returns whether the diagonal is above the other corners, or in one plane with them.
  bool is_ridge() const {
    const core::DoubleDouble diagonal = core::two_sum(tops[0].y, tops[2].y);
    const core::DoubleDouble other = core::two_sum(tops[1].y, tops[3].y);
    return diagonal.hi != other.hi ? diagonal.hi > other.hi : diagonal.lo >= other.lo;
  }
};

inline double lower_end(const Extrusion& e) {
  return std::min(e.from, e.to);
}
inline double upper_end(const Extrusion& e) {
  return std::max(e.from, e.to);
}

/// Returns the normals of the ends of a revolution, which point out of it. A whole turn has none.
/// They are rounded, and so a part of the description, as the circle of an arc is.
inline std::vector<Vec3> ends_of(const Revolution& r) {
  const core::TurnedProfile turned(r);
  return {turned.normals.begin(), turned.normals.begin() + turned.planes};
}
inline bool is_more_than_half(const Revolution& r) {
  return r.angle > std::numbers::pi;
}

/// Holds for the primitives without an inside.
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
