// The truth about a line and a primitive: from the primitive's implicit equation, restricted to the line
// o + t d of exactly the doubles given, by the roots of polynomials in t whose coefficients are exact.
// Nothing here is shared with src/core/geometry.
//
// A solid is where polynomials of t are negative: all of them, but for the torus (see line_oracle.cpp).
// All have dyadic coefficients, so signs, tangencies, and roots that coincide are decided; two roots
// of these polynomials that 4096 bits cannot tell apart are taken as one.
#pragma once

#include <functional>
#include <vector>

#include "crt/primitives.hpp"
#include "oracle/interval_vec.hpp"
#include "oracle/roots.hpp"

namespace crt::test {

/// The line with t = shift + x: x is 0 near the primitive, which keeps the polynomials in x short.
struct ExactLine {
  ExactLine(const Vec3& origin, const Vec3& direction, const Vec3& near);

  IntervalVec at(const Interval& x) const;

  double shift;
  IntervalVec point;      ///< at x = 0
  IntervalVec direction;  ///< exactly the given one
};

struct TrueCrossing {
  Interval t;
  bool entering = false;
  /// |n . d| with d as given: t is conditioned by its inverse. Where several faces meet within their bounds,
  /// at an edge, the least of theirs.
  double approach = 0;
  bool at_edge = false;  ///< whether several do
  double reach = 0;      ///< R + |x|: the primitive's size, and the distance from its centre
};

struct TrueLine {
  bool inside_before = false;
  std::vector<TrueCrossing> crossings;
};

/// What of the line is inside the primitive, or for a surface where it crosses.
TrueLine true_crossings(const Primitive& primitive, const Vec3& origin, const Vec3& direction);

/// Where the line meets the plane of a surface, within the rim or not.
TrueLine true_plane_crossings(const Primitive& surface, const Vec3& origin, const Vec3& direction);

/// How far the point at t is outside of the solid (negative: inside), in lengths. For a surface: how far
/// the point where the line meets its plane is beyond its rim; t is of no matter there.
double true_distance(const Primitive& primitive, const Vec3& origin, const Vec3& direction, double t);

/// Where a polynomial-wise membership changes along a line, by exact roots; x of each change, and
/// whether it becomes a member. Used for trees of solids.
struct Change {
  Interval x;
  bool entering = false;
  std::vector<std::size_t> causes;  ///< the polynomials that have a root there
};

inline constexpr double unit_of_rounding = 0x1p-53;  ///< u
using Membership = std::function<bool(const Interval& x)>;
/// All places where polynomials have roots, in order.
std::vector<Change> places_of_roots(const std::vector<Polynomial>& polynomials);
std::vector<Change> changes(const std::vector<Change>& places, const Membership& inside, bool& inside_before);

/// The polynomials in x of a primitive (a surface has its plane's), and whether the point at x (no root of
/// them) is inside.
std::vector<Polynomial> polynomials_of(const Primitive& solid, const ExactLine& line);
bool is_inside(const Primitive& solid, const std::vector<Polynomial>& polynomials, const Interval& x);

/// The centre and the size (the radius of a ball that holds it, 0 if there is none) of a primitive.
Vec3 center_of(const Primitive& primitive);
double size_of(const Primitive& primitive);

}  // namespace crt::test
