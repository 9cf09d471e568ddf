// Where lines surely pass by something long.
#pragma once

#include <array>
#include <limits>

#include "core/ray/enclosure.hpp"

namespace crt::core {

/// A cylinder without ends. What it encloses is somewhere in it.
struct EndlessCylinder {
  Vec3 place{0, 0, 0};  ///< a point of the axis
  Vec3 axis{0, 0, 0};   ///< unit length
  double radius = 0;
};

/// Returns false if none of the lines that are asked for comes into an endless cylinder. Of the
/// others nothing is known.
///
/// With m = d x n for the axis n, the two lines are |w . m| / |m| apart. Roundings change w . m and
/// r |m| by less than 16 u (|w| + r) |d|; and whatever they make of the axis, it passes the
/// cylinder as near as the radius says.
template <class Real>
bool enclose(const EndlessCylinder& cylinder, const FilterLine<Real>& line,
             const MaskOf<Real>& asked, Enclosure<Real>& part) {
  const std::array<Real, 3> offset = offset_to(line, cylinder.place);
  const std::array<Real, 3>& d = line.direction;
  const Vec3& n = cylinder.axis;
  const std::array<Real, 3> across = {d[1] * n.z - d[2] * n.y, d[2] * n.x - d[0] * n.z,
                                      d[0] * n.y - d[1] * n.x};
  const Real speed = line.squared_length * line.inverse_length;
  const Real error = enclosing_slack *
                     (abs(offset[0]) + abs(offset[1]) + abs(offset[2]) + cylinder.radius) * speed;
  const Real distance = abs(dot(offset, across)) - error;
  const double squared_radius = cylinder.radius * cylinder.radius;
  const MaskOf<Real> misses =
      distance > 0.0 && distance * distance > squared_radius * dot(across, across);
  if (!any(asked && !misses)) return false;
  const Real nothing_known = broadcast<Real>(std::numeric_limits<double>::quiet_NaN());
  part = {nothing_known, nothing_known, nothing_known, nothing_known};
  if (any(misses)) part.set_outside(misses);
  return true;
}

}  // namespace crt::core
