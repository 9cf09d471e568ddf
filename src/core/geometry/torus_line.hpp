// A line seen from a torus: G along it, and the stretches where G < 0. See torus.hpp for what G is.
#pragma once

#include <array>
#include <limits>
#include <optional>

#include "core/geometry/object_ray.hpp"
#include "crt/vec.hpp"

namespace crt::core {

class TorusLine {
 public:
  /// `point` and `direction` in the torus's frame: z is along its axis, the center is 0. With
  /// `on_surface` the point is on the torus by definition, and x = 0 a root.
  TorusLine(const Vec3& point, const Vec3& direction, double ring, double tube, bool on_surface);

  /// From now on tells in Dips::certain whether rounding could have changed how many dips there are. `off`
  /// is what each component of a point near the torus may be off by, rounding included.
  void take_care(double off) { off_ = off; }

  /// The one root between two points of different sign.
  struct Bracket {
    double negative;
    double positive;
  };
  /// A stretch of the line inside the torus, by brackets around its ends.
  struct Stretches {
    struct Ends {
      Bracket enter;
      Bracket leave;
    };
    std::array<Ends, 2> stretch;
    std::size_t count = 0;
    bool certain = true;
  };
  /// In ascending order.
  Stretches stretches();
  double root(const Bracket& bracket) const;

  struct Dip {
    double enter;
    double leave;
  };
  struct Dips {
    std::array<Dip, 2> dip;
    std::size_t count = 0;
    bool certain = true;
  };
  /// The same with the ends themselves; those at x = 0 are exactly 0 if the point is on the surface. Those
  /// before `begin` are only told roughly.
  Dips dips(double begin = -std::numeric_limits<double>::infinity());

  double level_at_start() const;  ///< what G is at x = 0, by rounding, if the point is on the surface
  double half_slope(double x) const { return level(x).half_slope; }           ///< G' / 2
  double half_curvature(double x) const { return half_curvature(level(x)); }  ///< G'' / 2

 private:
  /// G at a point of the line; less what it is at x = 0, if the point there is on the surface.
  struct Level {
    double rho;
    double value;
    double half_slope;
  };
  Level level(double x) const;
  double value_from_start(double x, const Vec3& p, double rho) const;
  double half_curvature(const Level& here) const;

  struct Range {
    double low;
    double high;
  };
  std::optional<Range> range() const;
  Range concave_part(const Range& range) const;
  /// A point where a sign was found, and whether rounding cannot have hidden one.
  struct Search {
    std::optional<double> x = {};
    bool certain = true;
  };
  Search find_dip(double outer, double inner) const;
  Search find_rise(double low, double high) const;
  Search find_sign(double low, double high, double sign) const;
  double first_guess(const Bracket& bracket) const;
  bool is_last_step(double x, const Level& from, double step) const;
  double place(const Bracket& bracket, double begin) const;
  double value_error(double x) const;
  double slope_error() const;
  double margin(double value_error, double length) const;
  double inflection_error(const Range& concave) const;

  Vec3 point_;
  Vec3 direction_;
  double ring_;
  double tube_;
  double squared_speed_;
  double passing_;  ///< sqrt(D): the line's angular momentum about the axis
  double turning_;  ///< R D
  bool on_surface_;
  double off_ = 0;
  double inflection_error_ = 0;
};

/// Makes the dips of a ray that starts on the torus agree with the side it leaves to, where the direction is
/// at odds with it or grazes so closely that rounding decides. `bulging` tells that the surface turns away
/// from the line, `shortest` what is left of a dip that rounding would have end at once.
void obey_side(Side side, bool bulging, double shortest, TorusLine::Dips& dips);

}  // namespace crt::core
