// A torus sees a line as G along it, and as the intervals where G < 0. torus.hpp says what G is.
#pragma once

#include <cmath>

#include "core/math/vector_lanes.hpp"

namespace crt::core {

/// A TorusLineOf is one line, or as many side by side as a Real has lanes. Each line gets what it
/// would get alone, to the last bit.
template <class Real>
class TorusLineOf {
 public:
  using Mask = decltype(Real{} < Real{});

  /// Takes `point` and `direction` in the torus's frame: z is along its axis, and the center is 0.
  /// With `on_surface` the point is on the torus by definition, and x = 0 is a root. A negative
  /// ring makes the inner lemon of the torus (torus.hpp).
  TorusLineOf(const Vec3Of<Real>& point, const Vec3Of<Real>& direction, double ring, double tube,
              bool on_surface)
      : point_(point),
        direction_(direction),
        ring_(ring),
        tube_(tube),
        reach_(ring < 0 ? std::sqrt((tube - ring) * (tube + ring)) : ring + tube),
        squared_length_(dot(direction, direction)),
        passing_(without_what_vanishes(
            abs(difference_of_products(point.x, direction.y, point.y, direction.x)))),
        turning_(ring * passing_ * passing_),
        on_surface_(on_surface) {}

  /// A Level is G at a point of the line. If the point at x = 0 is on the surface, it is less the G
  /// there.
  struct Level {
    Real rho;
    Real value;
    Real half_slope;

    /// Chooses for each line the level of `a` or that of `b`.
    static Level chosen(const Mask& first, const Level& a, const Level& b) {
      return {select(first, a.rho, b.rho), select(first, a.value, b.value),
              select(first, a.half_slope, b.half_slope)};
    }
  };
  Level level(const Real& x) const;

  /// A Bracket has the one root between two points of different sign.
  struct Bracket {
    Real negative{};
    Real positive{};
    Level inside{};  ///< at `negative`
  };
  /// Returns the root in the bracket of wanted lines.
  Real root(const Bracket& bracket, const Mask& wanted) const;

  struct Entry {
    Mask found{};  ///< if not, the line is nowhere inside
    Bracket bracket;
  };
  /// Finds where wanted lines that do not start on the surface first enter the torus, as
  /// intervals() does.
  Entry first_entry(const Mask& wanted) const;

  /// Returns which of the wanted lines are inside somewhere at x > 0. They start on the surface and
  /// leave outwards. For the others spans() surely has nothing there.
  Mask reenters(const Mask& wanted) const;

  Real half_slope(const Real& x) const { return level(x).half_slope; }           ///< G' / 2
  Real half_curvature(const Real& x) const { return half_curvature(level(x)); }  ///< G'' / 2

 protected:
  struct Range {
    Real low{};
    Real high{};
  };
  /// Finds where wanted lines can be inside. Returns for which there is such a part.
  Mask range(const Mask& wanted, Range& result) const;
  Range concave_part(const Range& range) const;
  /// A Search is a point where a sign was found, and whether rounding cannot have hidden one.
  struct Search {
    Real x{};
    Mask found{};
    Mask certain{};
    Level level{};  ///< at x
  };
  Search find_dip(const Real& outer, const Real& inner, const Mask& wanted) const;
  Search find_sign(const Real& from, const Real& to, double sign, const Mask& wanted) const;
  Real value_error(const Real& x) const;

  Vec3Of<Real> point_;
  Vec3Of<Real> direction_;
  double ring_;
  double tube_;
  double reach_;  ///< no point inside is farther from the center
  Real squared_length_;
  Real passing_;  ///< sqrt(D): the line's angular momentum about the axis
  Real turning_;  ///< R D
  bool on_surface_;
  double off_ = 0;
  double inflection_error_ = 0;

 private:
  /// Takes a line so near to the axis as one through it, as its square would underflow.
  static Real without_what_vanishes(const Real& passing) {
    constexpr double smallest = 0x1p-500;
    return select(passing > smallest, passing, Real{});
  }
  Real value_from_start(const Real& x, const Vec3Of<Real>& p, const Real& rho) const;
  Real half_curvature(const Level& here) const;
  Real first_guess(const Bracket& bracket) const;
  Mask is_last_step(const Real& x, const Level& from, const Real& step) const;
  Real slope_error() const;
  Real margin(const Real& value_error, const Real& length) const;
};

}  // namespace crt::core
