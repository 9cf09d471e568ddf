// The truth about a line and a primitive: from the primitive's implicit equation, restricted to the
// line o + t d of exactly the doubles given, by the roots of polynomials in t whose coefficients
// are exact (equations.hpp). Nothing here is shared with src/core/geometry.
//
// Sums of two doubles with a bound on their error do for most lines, sums of three for nearly all
// others, and MPFR for the rest: signs, tangencies, and roots that coincide are decided. Two roots
// that 4096 bits cannot distinguish are taken as one.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "crt/primitives.hpp"
#include "crt/transform.hpp"
#include "oracle/interval.hpp"

namespace crt::test {

struct TrueCrossing {
  Ball<4> t;  ///< to some 20 bits more than a double has
  bool entering = false;
  /// This is |n . d| with d as given: t is conditioned by its inverse. Where several faces meet
  /// within their bounds, at an edge, it is the least of theirs.
  double approach = 0;
  bool at_edge = false;  ///< whether several do
  double reach = 0;      ///< R + |x|: the primitive's size, and the distance from its centre
};

struct TrueLine {
  bool inside_before = false;
  std::vector<TrueCrossing> crossings;
};

/// A Question is a primitive in its place, and a line.
struct Question {
  Primitive primitive;
  Vec3 origin{0};
  Vec3 direction{0};
  Transform to_world{};
  std::vector<Transform> around{};  ///< what that is in, the innermost first
};

/// Returns what of the line is inside the primitive, or for a surface where it crosses.
TrueLine true_crossings(const Question& question, FirstTry first = FirstTry::two_doubles);

/// Returns where the line meets the plane of a surface, within the edge or not.
TrueLine true_plane_crossings(const Question& question);

/// Returns how far the point at t is outside of the solid (negative: inside), in lengths of the
/// primitive's space. For a surface it is how far the point where the line meets its plane is
/// beyond its edge, and t is not used.
double true_distance(const Question& question, double t);

/// Holds the point at t in the primitive's space, rounded, and the length of the direction there.
struct PointAndSpeed {
  Vec3 point;
  double speed = 0;
};
PointAndSpeed point_and_speed(const Question& question, double t);

inline constexpr double unit_of_rounding = 0x1p-53;  ///< u

/// Returns the distance to the next double, away from 0.
inline double ulp(double t) {
  return std::nextafter(std::abs(t), std::numeric_limits<double>::infinity()) - std::abs(t);
}

/// Return the centre and the size of a primitive. The size is the radius of a ball that holds it,
/// or 0 if there is none.
Vec3 center_of(const Primitive& primitive);
double size_of(const Primitive& primitive);

}  // namespace crt::test
