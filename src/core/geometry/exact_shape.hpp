// Primitives of the exact tier answer hit or miss rightly, and t is within 0.51 ulp
// (docs/numerics.md).
//
// Each first computes as the standard tier does, in doubles or double-doubles with a bound on the
// error. Only where the bound leaves a sign undecided, it asks for the ray without rounding
// (ExactRay::exact) and finds the sign of the polynomial in the inputs.
//
// Tests: tests/geometry/exact_*_test.cpp
#pragma once

#include <limits>
#include <memory>

#include "core/geometry/exact_ray.hpp"
#include "core/geometry/shape.hpp"
#include "core/math/real_root.hpp"

namespace crt::core {

/// An ExactSurface is a whole surface in object space by numbers that are not rounded. A plane has
/// its normal and the product of that with any point of the plane. Other surfaces have points, and
/// numbers that do not change where these points are moved.
struct ExactSurface {
  bool is_plane = false;
  std::vector<DyadicVector> points;
  std::vector<Dyadic> numbers;
};

class ExactShape {
 public:
  ExactShape() = default;
  ExactShape(const ExactShape&) = delete;
  ExactShape& operator=(const ExactShape&) = delete;
  virtual ~ExactShape() = default;

  /// Appends the crossings of the primitive, as Shape::crossings does: with the same faces, roots
  /// and promises.
  virtual bool crossings(const ExactRay& ray, CrossingList& out) const = 0;

  /// Returns where one of the crossings() of this ray is, without rounding. This separates
  /// crossings however close they are. Returns nothing where only the rounding of a start on the
  /// surface decides.
  virtual std::optional<RealRoot> place(const ExactRay& ray, const Crossing& crossing) const = 0;

  /// Returns the surface that a face is a piece of.
  virtual ExactSurface surface(std::uint32_t face) const = 0;

  /// Returns the bytes of memory it takes.
  virtual std::size_t bytes() const = 0;
};

/// Gives a crossing its t, if the bound on its error is small enough. Returns whether it is.
inline bool settle(const ExactRay& ray, const DoubleDouble& t, double error, Crossing& crossing) {
  if (!ray.is_settled(t.hi, error)) return false;
  crossing.t = t.hi;
  crossing.t_low = t.lo;
  crossing.error = error;
  return true;
}

/// A NewtonStep is one step of Newton's iteration for a root of g: from t to t - change, by rounded
/// g and g'.
struct NewtonStep {
  double change;
  double value_error;     ///< of g
  double rate;            ///< g'
  double rate_error;      ///< of g'
  double half_curvature;  ///< at least |g''| / 2 between t and the root, and as far beyond

  /// Returns a bound on the error of t after the step, before it is rounded. It is infinite where
  /// another root may be so near that the iteration cannot separate the two. Taylor's series about
  /// t bounds the error of the step by the square of the root's offset, where g' keeps its sign.
  /// The offset is the change and a little more.
  double error() const {
    const double least_rate = std::abs(rate) - rate_error;
    const double inaccuracy = rate_error + 2 * half_curvature * std::abs(change);
    const double off = (value_error + std::abs(change) * inaccuracy) / least_rate;
    const bool is_isolated =
        least_rate > 0 && 8 * half_curvature * (std::abs(change) + off) < least_rate;
    return is_isolated ? off : std::numeric_limits<double>::infinity();
  }
};

/// Returns a crossing with a t that was rounded to about 100 bits.
inline Crossing exact_crossing(const DoubleDouble& t, Crossing crossing) {
  crossing.t = t.hi;
  crossing.t_low = t.lo;
  crossing.error = precise_roundoff * std::abs(t.hi);
  return crossing;
}

/// Returns whether the crossing is the ray's own start, which is at 0 by identity.
inline bool is_start(const ExactRay& ray, const Crossing& crossing) {
  return ray.near.start.face != invalid_index && crossing.t == 0 && crossing.error == 0;
}

/// Returns the root of a polynomial in t that a crossing is.
inline std::optional<RealRoot> root_at(const ExactRay& ray, const Crossing& crossing,
                                       const DyadicPolynomial& polynomial) {
  const DoubleDouble t(crossing.t, crossing.t_low);
  std::optional<RealRoot> root = RealRoot::near(polynomial, t, crossing.error);
  // For a ray from a surface, crossings may be reported that the exact line does not have.
  if (root || ray.near.start.face != invalid_index) return root;
  return RealRoot::of_index(polynomial, crossing.root);
}

}  // namespace crt::core
