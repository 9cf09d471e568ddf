// Angles about an axis as texture coordinates.
#pragma once

#include "crt/vec.hpp"

namespace crt::core {

/// The angle of (x, y) from x towards y as a share of a whole turn, in [0, 1); 0 for (0, 0).
double turn(double x, double y);

/// Unit vectors that make a frame with `along`, a unit vector. `zero`, where angles about the axis
/// start, is +z as far as that is across the axis (+x, if the axis is mostly along z); `quarter` is
/// along x zero, a quarter of a turn on. Exact for the coordinate axes.
struct AxisFrame {
  Vec3 zero;
  Vec3 quarter;
  Vec3 along;
};
AxisFrame frame_about(const Vec3& axis);

}  // namespace crt::core
