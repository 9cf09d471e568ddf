// In both tiers, a ray that starts on the side's surface clips the side of a frustum by these
// signs.
#pragma once

#include "core/geometry/clipped_span.hpp"

namespace crt::core {

/// A SideStart has the signs of the equation a t^2 + 2 b t = 0 that is left when the root at the
/// start is divided out (see frustum.hpp). It also has the signs of the radius at the start and of
/// its rate. The radius is negative on the cone's other nappe.
struct SideStart {
  int a = 0;
  int b = 0;
  int radius = 1;
  int radius_rate = 0;
  Crossing other;  ///< t and its error at -2 b / a, if a is not 0
};

void clip_side_from_surface(SideStart side, const FaceStart& start, ClippedSpan& span);

inline int sign_of(double x) {
  return x > 0 ? 1 : (x < 0 ? -1 : 0);
}

}  // namespace crt::core
