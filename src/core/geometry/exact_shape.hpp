// The primitives of the exact tier (docs/numerics.md): hit or miss is right, and t is within
// 0.51 ulp.
//
// Each first computes as the standard tier does, in doubles or double-doubles with a bound on the
// error. Only where the bound leaves a sign open it asks for the ray without rounding
// (ExactRay::exact) and finds the sign of the polynomial in the inputs. Tests:
// tests/geometry/exact_*_test.cpp
#pragma once

#include <limits>
#include <memory>

#include "core/geometry/exact_ray.hpp"
#include "core/geometry/shape.hpp"
#include "core/math/real_root.hpp"

namespace crt::core {

/// A whole surface in object space by numbers that are not rounded: of planes a normal and its
/// product with any point of the plane, of others points and what does not change where these are
/// moved.
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

  /// As Shape::crossings, of the same primitive: the same faces, roots and promises.
  virtual bool crossings(const ExactRay& ray, CrossingList& out) const = 0;

  /// Where one of crossings() of this ray is, without rounding: what tells crossings apart however
  /// near they are. Nothing where the rounding of a start on the surface is all that there is to go
  /// by.
  virtual std::optional<RealRoot> place(const ExactRay& ray, const Crossing& crossing) const = 0;

  /// The surface that a face is a piece of.
  virtual ExactSurface surface(std::uint32_t face) const = 0;

  /// Of memory.
  virtual std::size_t bytes() const = 0;
};

/// Gives a crossing its t, if what it may be off by is little enough.
inline bool settle(const ExactRay& ray, const DoubleDouble& t, double error, Crossing& crossing) {
  if (!ray.is_settled(t.hi, error)) return false;
  crossing.t = t.hi;
  crossing.t_low = t.lo;
  crossing.error = error;
  return true;
}

/// One step of Newton's iteration for a root of g: from t to t - change, by rounded g and g'.
struct NewtonStep {
  double change;
  double value_error;     ///< of g
  double rate;            ///< g'
  double rate_error;      ///< of g'
  double half_curvature;  ///< at least |g''| / 2 between t and the root, and as far beyond

  /// What t may be off by after the step, before it is rounded. It is infinite where another root
  /// may be so near that the iteration cannot tell the two apart. (Taylor's series about t bounds
  /// the step's error by the square of the root's offset, which is the change and a little, where
  /// g' keeps its sign.)
  double error() const {
    const double least_rate = std::abs(rate) - rate_error;
    const double inaccuracy = rate_error + 2 * half_curvature * std::abs(change);
    const double off = (value_error + std::abs(change) * inaccuracy) / least_rate;
    const bool is_isolated =
        least_rate > 0 && 8 * half_curvature * (std::abs(change) + off) < least_rate;
    return is_isolated ? off : std::numeric_limits<double>::infinity();
  }
};

/// A crossing with a t that was rounded to about 100 bits.
inline Crossing exact_crossing(const DoubleDouble& t, Crossing crossing) {
  crossing.t = t.hi;
  crossing.t_low = t.lo;
  crossing.error = precise_roundoff * std::abs(t.hi);
  return crossing;
}

/// Whether a ray meets its own start there, which is at 0 by identity.
inline bool is_start(const ExactRay& ray, const Crossing& crossing) {
  return ray.near.start.face != no_face && crossing.t == 0 && crossing.error == 0;
}

/// The root of a polynomial in t that a crossing is.
inline std::optional<RealRoot> root_at(const ExactRay& ray, const Crossing& crossing,
                                       const DyadicPolynomial& polynomial) {
  const DoubleDouble t(crossing.t, crossing.t_low);
  std::optional<RealRoot> root = RealRoot::near(polynomial, t, crossing.error);
  // From a surface the line may be said to go on farther than it does.
  if (root || ray.near.start.face != no_face) return root;
  return RealRoot::of_index(polynomial, crossing.root);
}

}  // namespace crt::core
