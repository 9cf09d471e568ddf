// The side of a frustum as a ray meets it that starts on that side's surface, in both tiers.
#pragma once

#include "core/geometry/clipped_span.hpp"

namespace crt::core {

/// Signs of the equation a t^2 + 2 b t = 0 that is left when the root at the start is divided out
/// (see frustum.hpp), of the radius at the start (negative on the cone's other nappe), and of its
/// rate.
struct SideStart {
  int a = 0;
  int b = 0;
  int radius = 1;
  int radius_rate = 0;
  Crossing other;  ///< t and its error at -2 b / a, if a is not 0
};

void clip_side_from_surface(SideStart side, const RayStart& start, ClippedSpan& span);

inline int sign_of(double x) {
  return x > 0 ? 1 : (x < 0 ? -1 : 0);
}

}  // namespace crt::core
