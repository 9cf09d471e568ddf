// A quadric along a line is a quadratic, whose coefficients both tiers compute in twice the
// precision, with bounds on their errors.
#pragma once

#include "core/geometry/exact_ray.hpp"
#include "core/geometry/quadric/form.hpp"
#include "core/geometry/shape.hpp"
#include "core/math/bounded.hpp"

namespace crt::core {

/// A QuadricLine is a x^2 + 2 b x + c, the form along a line, where t is `shift` at x = 0.
class QuadricLine {
 public:
  /// Puts x = 0 about where the line is closest to the origin, or to where the ray is at t = 0.
  static QuadricLine at_closest(const QuadricForm& form, const ExactRay& ray);
  static QuadricLine at_origin(const QuadricForm& form, const ExactRay& ray) {
    return {form, ray, 0.0};
  }

  /// Returns b^2 - a c.
  Bounded discriminant() const;

  /// Returns t of both roots in ascending order. The discriminant must be certain and above 0, and
  /// a must be certain.
  std::array<Bounded, 2> roots(const Bounded& discriminant) const;

  /// Returns t of the one root if a is 0. b must be certain.
  Bounded only_root() const;

  /// Returns t of the root beside x = 0 if c is taken as 0. a must be certain.
  Bounded root_beside_zero() const;

  Bounded a;
  Bounded b;
  Bounded c;

  /// Converts a difference of x to a difference of t.
  double to_t_length(double x) const { return x * unit_ * inverse_speed_; }

 private:
  QuadricLine(const QuadricForm& form, const ExactRay& ray, const DoubleDouble& shift);

  Bounded t_of(const Bounded& x) const;

  DoubleDouble shift_;
  double unit_;
  double inverse_speed_;  ///< a power of two that brings the direction's components to 2 at most
};

// These append what a line crosses, once the signs are known, and return whether the line is inside
// at t = -inf.

/// Appends both roots. `opens_up` says that the form is above 0 at both ends of the line.
bool emit_roots(bool opens_up, const std::array<Crossing, 2>& roots, CrossingList& out);

/// Appends the one root of a form that rises or falls along the line.
bool emit_only_root(bool rises, Crossing root, CrossingList& out);

/// Appends what is crossed by a ray that starts on the surface, at t = 0, and at another root if
/// there is one. `opens_up` is as above. Where the sign of t disagrees with the side to which the
/// ray leaves, it is `shortest` on the other side.
bool emit_from_surface(Side side, bool opens_up, Crossing other, double shortest,
                       CrossingList& out);

/// Appends that root alone.
bool emit_start(Side side, CrossingList& out);

/// Returns a length in t that is no more than the rounding of the ray's origin, but above 0.
double shortest_length(const ObjectRay& ray);

}  // namespace crt::core
