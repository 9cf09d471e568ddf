// The implicit equations of the primitives, restricted to a line: polynomials in x with exact
// coefficients. Nothing here is shared with src/core/geometry. Number is a Ball or an Interval.
#pragma once

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>

#include "crt/transform.hpp"
#include "oracle/number_vec.hpp"
#include "oracle/roots.hpp"
#include "oracle/rounded_box.hpp"
#include "oracle/without_oracle.hpp"

namespace crt::test {

template <class Number>
Polynomial<Number> operator+(const Polynomial<Number>& a, const Polynomial<Number>& b) {
  Polynomial<Number> result = a.size() >= b.size() ? a : b;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) result[i] = a[i] + b[i];
  return result;
}
template <class Number>
Polynomial<Number> operator*(const Number& a, const Polynomial<Number>& b) {
  Polynomial<Number> result;
  for (const Number& coefficient : b) result.push_back(a * coefficient);
  return result;
}
template <class Number>
Polynomial<Number> operator-(const Polynomial<Number>& a) {
  Polynomial<Number> result;
  for (const Number& coefficient : a) result.push_back(-coefficient);
  return result;
}
template <class Number>
Polynomial<Number> operator-(const Polynomial<Number>& a, const Polynomial<Number>& b) {
  return a + -b;
}
template <class Number>
Polynomial<Number> square(const Polynomial<Number>& a) {
  Polynomial<Number> result;
  for (std::size_t sum = 0; sum + 1 < 2 * a.size(); ++sum) {
    Number coefficient(0.0);
    const std::size_t first = sum < a.size() ? 0 : sum + 1 - a.size();
    for (std::size_t i = first; 2 * i < sum; ++i) coefficient = coefficient + a[i] * a[sum - i];
    coefficient = coefficient + coefficient;
    result.push_back(sum % 2 == 0 ? coefficient + square(a[sum / 2]) : coefficient);
  }
  return result;
}

/// An ExactLine is a line in the space of a primitive, without rounding, with t = shift + x. x is 0
/// near the primitive.
template <class Number>
struct ExactLine {
  /// The primitive is where `to_world` has it, and that where those around it have it, the
  /// innermost first. Inverses are taken by Cramer's rule.
  ExactLine(const Vec3& world_origin, const Vec3& world_direction, const Transform& to_world,
            const Vec3& near, std::span<const Transform> around = {})
      : origin(exactly<Number>(world_origin)), direction(exactly<Number>(world_direction)) {
    for (std::size_t i = around.size(); i-- > 0;) enter(around[i]);
    if (to_world != Transform{}) enter(to_world);
    const Vec3 d = rounded(direction);
    move_to(-glm::dot(rounded(origin - exactly<Number>(near)), d) / glm::dot(d, d));
  }

  void move_to(double t) {
    shift = t;
    offset = Number(t) * direction;
  }
  /// Returns the point at x = 0, relative to another.
  NumberVec<Number> from(const Vec3& position) const {
    return (origin - exactly<Number>(position)) + offset;
  }
  NumberVec<Number> at(const Number& x) const { return (origin + offset) + x * direction; }

  NumberVec<Number> origin;  ///< at t = 0
  NumberVec<Number> direction;
  double shift = 0;
  NumberVec<Number> offset;  ///< from there to x = 0

 private:
  void enter(const Transform& to_world) {
    const std::array rows = {exactly<Number>(to_world.row_x), exactly<Number>(to_world.row_y),
                             exactly<Number>(to_world.row_z)};
    const std::array columns = {cross(rows[1], rows[2]), cross(rows[2], rows[0]),
                                cross(rows[0], rows[1])};
    const Number determinant = dot(rows[0], columns[0]);
    const auto solve = [&](const NumberVec<Number>& v) {
      const NumberVec<Number> result = v[0] * columns[0] + v[1] * columns[1] + v[2] * columns[2];
      return NumberVec<Number>{result[0] / determinant, result[1] / determinant,
                               result[2] / determinant};
    };
    origin = solve(origin - exactly<Number>(to_world.translation));
    direction = solve(direction);
  }
};

/// Holds the line relative to a point, and its squared lengths as polynomials in x.
template <class Number>
struct Relative {
  Relative(const ExactLine<Number>& line, const Vec3& origin)
      : point(line.from(origin)), direction(line.direction) {}

  Polynomial<Number> along(const NumberVec<Number>& axis) const {
    return {dot(axis, point), dot(axis, direction)};
  }
  Polynomial<Number> squared_distance() const {
    return {squared(point), Number(2) * dot(point, direction), squared(direction)};
  }

  /// Returns the squared distance from the axis through the origin, times the squared length of
  /// `axis`.
  Polynomial<Number> squared_distance_from_axis(const NumberVec<Number>& axis) const {
    const NumberVec<Number> p = cross(point, axis);
    const NumberVec<Number> d = cross(direction, axis);
    return {squared(p), Number(2) * dot(p, d), squared(d)};
  }

  NumberVec<Number> point;
  const NumberVec<Number>& direction;
};

/// A primitive has at most so many equations.
inline constexpr std::size_t max_equations = 32;
template <class Number>
using Equations = Few<Polynomial<Number>, max_equations>;

/// A cylinder has the equations of its side and of its caps.
inline constexpr std::ptrdiff_t cylinder_equations = 3;

// A solid is where all its polynomials are negative, except the torus, the capsule, the extrusion,
// the revolution, the height field and the rounded box.

// A truncated cone about `axis` = to - from, A = axis . axis, k = radius2 - radius, w = p - from,
// h = w . axis: F = |w x axis|^2 A - (radius A + k h)^2 < 0 and 0 < h < A.
template <class Number>
Equations<Number> equations(const Frustum& c, const ExactLine<Number>& line) {
  const Relative relative(line, c.from);
  const NumberVec<Number> axis = exactly<Number>(c.to) - exactly<Number>(c.from);
  const Number a = squared(axis);
  const Polynomial<Number> h = relative.along(axis);
  const Number growth = Number(c.radius2) - Number(c.radius);
  const Polynomial<Number> radius = Polynomial<Number>{Number(c.radius) * a} + growth * h;
  return {a * relative.squared_distance_from_axis(axis) - square(radius), -h,
          h - Polynomial<Number>{a}};
}
template <class Number>
Equations<Number> equations(const Cylinder& c, const ExactLine<Number>& line) {
  return equations(frustum_of(c), line);
}
template <class Number>
Equations<Number> equations(const Cone& c, const ExactLine<Number>& line) {
  return equations(frustum_of(c), line);
}

template <class Number>
Equations<Number> equations(const Sphere& s, const ExactLine<Number>& line) {
  return {Relative(line, s.center).squared_distance() -
          Polynomial<Number>{square(Number(s.radius))}};
}

// The three equations of the cylinder are first, then those of the spheres about its ends.
template <class Number>
Equations<Number> equations(const Capsule& c, const ExactLine<Number>& line) {
  Equations<Number> result = equations(frustum_of(c), line);
  for (const Vec3& center : {c.from, c.to})
    result.push_back(equations(Sphere{.center = center, .radius = c.radius}, line)[0]);
  return result;
}

template <class Number>
Equations<Number> equations(const Box& b, const ExactLine<Number>& line) {
  Equations<Number> result;
  const Relative lower(line, glm::min(b.corner_a, b.corner_b));
  const Relative upper(line, glm::max(b.corner_a, b.corner_b));
  for (std::size_t i = 0; i < 3; ++i) {
    result.push_back({-lower.point[i], -lower.direction[i]});
    result.push_back({upper.point[i], upper.direction[i]});
  }
  return result;
}

template <class Number>
Equations<Number> equations(const Plane& p, const ExactLine<Number>& line) {
  return {Relative(line, p.position).along(exactly<Number>(p.normal))};
}

// With S = |p|^2 + R^2 - r^2, inside means S < 2 R rho: S < 0 or Q = |axis|^2 (S^2 - 4 R^2 rho^2) <
// 0. So the lemon within a spindle torus, where Q > 0 and S < 0, is filled.
template <class Number>
Equations<Number> equations(const Torus& torus, const ExactLine<Number>& line) {
  const Relative relative(line, torus.center);
  const NumberVec<Number> axis = exactly<Number>(torus.axis);
  const Number ring = square(Number(torus.radius));
  const Polynomial<Number> s =
      relative.squared_distance() + Polynomial<Number>{ring - square(Number(torus.thickness))};
  const Number a = squared(axis);
  return {a * square(s) - (Number(4) * ring) * relative.squared_distance_from_axis(axis), s};
}

/// Returns the equation of a surface's plane.
template <class Number>
Equations<Number> equations(const Disc& d, const ExactLine<Number>& line) {
  return {Relative(line, d.center).along(exactly<Number>(d.normal))};
}
template <class Number>
Equations<Number> equations(const HalfPlane& h, const ExactLine<Number>& line) {
  return {Relative(line, h.position).along(exactly<Number>(h.normal))};
}
template <class Number>
Equations<Number> equations(const Triangle& t, const ExactLine<Number>& line) {
  return {Relative(line, t.a).along(normal_of<Number>(t))};
}

/// Returns the equations of all planes, of which the tetrahedron is behind.
template <class Number>
Equations<Number> equations(const Mesh& mesh, const ExactLine<Number>& line) {
  Equations<Number> result;
  for (const Triangle& triangle : triangles_of(mesh)) {
    result.push_back(Relative(line, triangle.a).along(normal_of<Number>(triangle)));
  }
  return result;
}

// An extrusion has the equations of the sides, which are positive to the right, of the disc and of
// both ends.
template <class Number>
Equations<Number> equations(const Extrusion& extrusion, const ExactLine<Number>& line) {
  const ArchedTriangle profile(*extrusion.profile);
  Equations<Number> result;
  for (std::size_t side = 0; side < 3; ++side) {
    result.push_back(
        Relative(line, profile.from(side)).along(profile.template normal<Number>(side)));
  }
  const NumberVec<Number> z = exactly<Number>(Vec3(0, 0, 1));
  result.push_back(Relative(line, profile.center).squared_distance_from_axis(z) -
                   Polynomial<Number>{square(Number(profile.radius))});
  result.push_back(-Relative(line, Vec3(0, 0, lower_end(extrusion))).along(z));
  result.push_back(Relative(line, Vec3(0, 0, upper_end(extrusion))).along(z));
  return result;
}

// A point of a revolution is at (rho, y) of the profile. A side from (a, b) has it on the left if
// dx (y - b) + dy a > dy rho. With u for the left side there are the equations u^2 - dy^2 rho^2 and
// u of each side. Then come Q and S of the torus that the arc makes, and the planes of the ends.
inline constexpr std::size_t equations_of_sides = 6;
template <class Number>
Equations<Number> equations(const Revolution& revolution, const ExactLine<Number>& line) {
  const ArchedTriangle profile(*revolution.profile);
  const NumberVec<Number> up = exactly<Number>(Vec3(0, 1, 0));
  Equations<Number> result;
  for (std::size_t side = 0; side < 3; ++side) {
    const Vec3& from = profile.from(side);
    const NumberVec<Number> along = exactly<Number>(profile.to(side)) - exactly<Number>(from);
    const Relative relative(line, Vec3(0, from.y, 0));
    const Polynomial<Number> u =
        along[0] * relative.along(up) + Polynomial<Number>{along[1] * Number(from.x)};
    result.push_back(square(u) - square(along[1]) * relative.squared_distance_from_axis(up));
    result.push_back(u);
  }
  const Torus torus{
      .center = {0, profile.center.y, 0}, .radius = profile.center.x, .thickness = profile.radius};
  for (const Polynomial<Number>& equation : equations(torus, line)) result.push_back(equation);
  for (const Vec3& normal : ends_of(revolution)) {
    result.push_back(Relative(line, Vec3(0)).along(exactly<Number>(normal)));
  }
  return result;
}

template <class Number>
Equations<Number> equations(const WithoutOracle auto&, const ExactLine<Number>&) {
  has_no_oracle();
}

// A height field has the equations of its sides, of its bottom and of two triangles on top.
template <class Number>
Equations<Number> equations(const HeightField& field, const ExactLine<Number>& line) {
  const CornerField corners(field);
  Equations<Number> result;
  for (const int axis : {0, 2, 1}) {
    Vec3 normal(0);
    normal[axis] = 1;
    const NumberVec<Number> across = exactly<Number>(normal);
    result.push_back(-Relative(line, corners.lower).along(across));
    if (axis != 1) result.push_back(Relative(line, corners.upper).along(across));
  }
  for (const Triangle& triangle : corners.triangles()) {
    result.push_back(Relative(line, triangle.a).along(normal_of<Number>(triangle)));
  }
  return result;
}

/// Returns the matrix of second derivatives of a quadric's sum times a vector.
template <class Number>
NumberVec<Number> curved(const Quadric& q, const NumberVec<Number>& v) {
  const Number xy(q.products.x);
  const Number xz(q.products.y);
  const Number yz(q.products.z);
  const auto twice = [](double x) { return Number(2) * Number(x); };
  return {twice(q.squares.x) * v[0] + xy * v[1] + xz * v[2],
          xy * v[0] + twice(q.squares.y) * v[1] + yz * v[2],
          xz * v[0] + yz * v[1] + twice(q.squares.z) * v[2]};
}

/// Returns the gradient of a quadric's sum at a point.
template <class Number>
NumberVec<Number> slope_at(const Quadric& q, const NumberVec<Number>& p) {
  return curved(q, p) + exactly<Number>(q.linear);
}

// A quadric has the equation of twice its sum.
template <class Number>
Equations<Number> equations(const Quadric& q, const ExactLine<Number>& line) {
  const Relative relative(line, Vec3(0));
  const NumberVec<Number>& p = relative.point;
  const NumberVec<Number>& d = relative.direction;
  const NumberVec<Number> slope = slope_at(q, p);
  const Number constant = Number(2) * Number(q.constant);
  return {{dot(p, slope + exactly<Number>(q.linear)) + constant, Number(2) * dot(d, slope),
           dot(d, curved(q, d))}};
}

// A rounded box has the equations of its flat faces, as a box, and then others (rounded_box.hpp).
template <class Number>
Equations<Number> equations(const RoundedBox& b, const ExactLine<Number>& line) {
  Equations<Number> result = equations(Box{.corner_a = b.corner_a, .corner_b = b.corner_b}, line);
  append_rounding(b, line, result);
  return result;
}

template <class Number>
Equations<Number> equations(const Primitive& primitive, const ExactLine<Number>& line) {
  return std::visit([&](const auto& p) { return equations(p, line); }, primitive);
}

/// Says whether an arched triangle is all around a point. Signs are 1 to the right of a side, and
/// -1 in the disc. Where one is 0, that is both sides of it.
inline bool is_around(bool segment_is_right, std::array<int, 4> signs) {
  for (std::size_t i = 0; i < signs.size(); ++i) {
    if (signs[i] != 0) continue;
    std::array<int, 4> other = signs;
    signs[i] = 1;
    other[i] = -1;
    return is_around(segment_is_right, signs) && is_around(segment_is_right, other);
  }
  const bool in_triangle = signs[0] == signs[1] && signs[1] == signs[2];
  const bool in_segment = signs[3] < 0 && (signs[2] > 0) == segment_is_right;
  return in_triangle != in_segment;
}

/// Says whether a point is inside a revolution, by the signs of its equations there.
template <class Signs>
bool is_inside_revolution(const Revolution& revolution, const Signs& signs) {
  const ArchedTriangle profile(*revolution.profile);
  std::array<int, 4> of_profile{};
  for (std::size_t side = 0; side < 3; ++side) {
    const double rise = profile.to(side).y - profile.from(side).y;
    const int up = rise > 0 ? 1 : (rise < 0 ? -1 : 0);
    const int u = signs[2 * side + 1];
    const int left = up == 0 ? u : (u == up ? u * signs[2 * side] : -up);
    of_profile[side] = -left;
  }
  const bool squares = signs[equations_of_sides] < 0;
  const bool sum = signs[equations_of_sides + 1] < 0;
  const bool in_disc = profile.center.x < 0 ? sum && !squares : sum || squares;
  of_profile[3] = in_disc ? -1 : 1;
  if (!is_around(profile.is_right, of_profile)) return false;
  if (ends_of(revolution).empty()) return true;
  const bool first = signs[equations_of_sides + 2] < 0;
  const bool last = signs[equations_of_sides + 3] < 0;
  return is_more_than_half(revolution) ? first || last : first && last;
}

/// Says whether a point is in a height field, by the signs of its equations. The sign is 0 of a
/// plane that the line is in, which then is moved to larger x, or else to larger y.
template <class Signs>
bool is_in_field(const CornerField& field, const Signs& signs) {
  constexpr std::array<int, 5> moved = {-1, 1, -1, 1, -1};
  for (std::size_t i = 0; i < moved.size(); ++i) {
    if ((signs[i] != 0 ? signs[i] : moved[i]) > 0) return false;
  }
  const auto& tops = field.tops;
  const std::array<double, 2> drops = {tops[1].y - tops[2].y, tops[0].y - tops[3].y};
  const auto is_below = [&](std::size_t triangle) {
    const int sign = signs[moved.size() + triangle];
    return sign != 0 ? sign < 0 : drops[triangle] < 0;
  };
  return field.is_ridge() ? is_below(0) && is_below(1) : is_below(0) || is_below(1);
}

/// Says whether a point is inside a solid, by the signs of its equations there.
template <class Signs>
bool is_inside(const Primitive& solid, const Signs& signs) {
  const auto negative = [](int sign) { return sign < 0; };
  if (std::holds_alternative<Torus>(solid))
    return std::any_of(signs.begin(), signs.end(), negative);
  if (std::holds_alternative<Capsule>(solid)) {
    const auto spheres = signs.begin() + cylinder_equations;
    return std::all_of(signs.begin(), spheres, negative) ||
           std::any_of(spheres, signs.end(), negative);
  }
  if (const auto* extrusion = std::get_if<Extrusion>(&solid)) {
    return signs[4] < 0 && signs[5] < 0 &&
           is_around(ArchedTriangle(*extrusion->profile).is_right,
                     {signs[0], signs[1], signs[2], signs[3]});
  }
  if (const auto* revolution = std::get_if<Revolution>(&solid)) {
    return is_inside_revolution(*revolution, signs);
  }
  if (const auto* field = std::get_if<HeightField>(&solid)) {
    return is_in_field(CornerField(*field), signs);
  }
  if (std::holds_alternative<RoundedBox>(solid)) return is_inside_rounded_box(signs);
  return std::all_of(signs.begin(), signs.end(), negative);
}

}  // namespace crt::test
