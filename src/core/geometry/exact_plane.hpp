// Flat primitives and faces of the exact tier have a plane in common.
#pragma once

#include "core/geometry/exact_ray.hpp"
#include "core/geometry/shape.hpp"
#include "core/math/dyadic_polynomial.hpp"
#include "core/math/precise_transform.hpp"

namespace crt::core {

/// Returns (b - a) x (c - a).
DyadicVector exact_normal(const Vec3& a, const Vec3& b, const Vec3& c);

/// Returns a direction to about 100 bits of each component, up to a power of two: the largest is
/// about 1. A vector of 0 stays that.
PreciseVec3 rounded_direction(const DyadicVector& direction);

class ExactPlane {
 public:
  /// Makes the plane through `position` across `normal`.
  ExactPlane(const Vec3& normal, const Vec3& position);
  /// Makes the plane through `position` across to - from, which is not rounded.
  static ExactPlane across_axis(const Vec3& from, const Vec3& to, const Vec3& position);
  /// Makes the plane through three points.
  static ExactPlane through(const Vec3& a, const Vec3& b, const Vec3& c);

  /// A Meeting is where a line meets the plane.
  struct Meeting {
    int side = 0;    ///< the sign of n . d: 1 if the line leaves the half-space behind the plane
    DoubleDouble t;  ///< if the line is not parallel
    double error = 0;
    bool behind = false;  ///< for parallel lines: whether they are behind the plane, and not on it

    /// Returns false if the line is parallel, or so nearly that t has no finite value.
    bool found() const { return side != 0; }
    Crossing crossing(std::uint32_t face = 0) const {
      return {.t = t.hi, .error = error, .t_low = t.lo, .face = face, .entering = side < 0};
    }
  };
  Meeting meet(const ExactRay& ray) const;

  /// Returns only the sign of n . d.
  int side(const ExactRay& ray) const;

  /// Returns what meet() does. But if the ray starts on this plane, t is exactly 0, and the side is
  /// the one that the ray is known to leave to.
  Meeting meet_surface(const ExactRay& ray) const;

  /// A Fraction is t without rounding: numerator / denominator, with denominator >= 0. For parallel
  /// lines the denominator is 0. The numerator then has the sign of the distance to the plane along
  /// the normal.
  struct Fraction {
    Dyadic numerator;
    Dyadic denominator;
    int side = 0;
  };
  Fraction meet_exactly(const ExactLine& line) const;

  /// Returns the equation whose root is t.
  DyadicPolynomial equation(const ExactLine& line) const {
    const Fraction t = meet_exactly(line);
    return DyadicPolynomial({-t.numerator, t.denominator});
  }

  /// Returns the normal, and its product with a point of the plane.
  std::vector<Dyadic> numbers() const {
    const auto& [x, y, z] = exact_normal_;
    return {x, y, z, dot(exact_normal_, exactly(position_))};
  }

  const Vec3& position() const { return position_; }

  /// Returns the bytes of memory it takes beside the object itself.
  std::size_t more_bytes() const {
    std::size_t bytes = 0;
    for (const Dyadic& component : exact_normal_) bytes += component.more_bytes();
    return bytes;
  }

 private:
  ExactPlane() = default;
  /// A Rate is n . d up to a positive factor, with a bound on its error.
  struct Rate {
    DoubleDouble value;
    double error;
    bool certain() const { return std::abs(value.hi) > error; }
    int sign() const { return value.hi > 0 ? 1 : -1; }
  };
  Rate rate(const ExactRay& ray) const;
  Meeting estimate(const ExactRay& ray) const;
  Meeting estimate_across_axis(const ExactRay& ray) const;
  Meeting settled(const ExactRay& ray, const Meeting& estimate) const;
  void take_normal(const DyadicVector& normal);

  int axis_ = -1;                      ///< the coordinate axis of the normal, or -1
  PreciseVec3 normal_{0.0, 0.0, 0.0};  ///< to 100 bits of each component, the largest about 1
  DyadicVector exact_normal_;
  Vec3 position_{0, 0, 0};
};

/// Returns the sign of the first t less the second, for the meetings of a ray with two planes.
int order(const ExactRay& ray, const ExactPlane& first_plane, const ExactPlane::Meeting& first,
          const ExactPlane& second_plane, const ExactPlane::Meeting& second);

/// An ExactPoint is a point of a line relative to a center, without rounding: offset / weight, with
/// weight > 0.
struct ExactPoint {
  DyadicVector offset;
  Dyadic weight;
};
ExactPoint exact_point(const ExactLine& line, const ExactPlane::Fraction& t, const Vec3& center);

}  // namespace crt::core
