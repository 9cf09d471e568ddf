// A line seen from a torus: G along it, and the stretches where G < 0. See torus.hpp for what G is.
#pragma once

#include <array>
#include <optional>

#include "crt/vec.hpp"

namespace crt::core {

class TorusLine {
 public:
  /// `point` and `direction` in the torus's frame: z is along its axis, the center is 0. With
  /// `on_surface` the point is on the torus by definition, and x = 0 a root.
  TorusLine(const Vec3& point, const Vec3& direction, double ring, double tube, bool on_surface);

  /// A stretch of the line inside the torus.
  struct Dip {
    double enter;
    double leave;
  };
  struct Dips {
    std::array<Dip, 2> dip;
    std::size_t count = 0;
  };
  /// In ascending order. Ends at x = 0 are exactly 0 if the point is on the surface.
  Dips dips() const;

  double value(double x) const;  ///< G; less what it is at x = 0, if the point is on the surface
  double level_at_start() const { return level(point_); }  ///< what G is at x = 0 all the same, by rounding
  double half_slope(double x) const;                       ///< G' / 2
  double half_curvature(double x) const;                   ///< G'' / 2

 private:
  struct Range {
    double low;
    double high;
  };
  double level(const Vec3& p) const;
  std::optional<Range> range() const;
  Range concave_part(const Range& range) const;
  std::optional<double> find_sign(double low, double high, double sign) const;
  double root_between(double negative, double positive) const;

  Vec3 point_;
  Vec3 direction_;
  double ring_;
  double tube_;
  double squared_speed_;
  double passing_;  ///< sqrt(D): the line's angular momentum about the axis
  bool on_surface_;
};

}  // namespace crt::core
