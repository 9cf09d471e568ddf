#include "core/geometry/frustum/start.hpp"

#include "core/geometry/frustum/frustum.hpp"

namespace crt::core {
namespace {

/// Clips the span of a ray that starts on the cone's other nappe, on some other primitive. From
/// within that nappe it meets this one once or never.
void clip_side_from_other_nappe(SideStart& side, ClippedSpan& span) {
  if (side.a >= 0) return span.clear();
  if (side.radius_rate > 0) {
    side.other.root = 1;
    span.enter(side.other);
  } else {
    span.leave(side.other);
  }
}

}  // namespace

void clip_side_from_surface(SideStart side, const FaceStart& start, ClippedSpan& span) {
  constexpr std::uint32_t face = FrustumShape::side_face;
  if (side.radius < 0) return clip_side_from_other_nappe(side, span);
  if (side.a > 0) {
    const bool leaving = side.b >= 0;
    side.other.root = leaving ? 0 : 1;
    const Crossing here{.face = face, .root = static_cast<std::uint8_t>(leaving ? 1 : 0)};
    if (!leaving && start.side == Side::outside) return span.clear();
    span.enter(leaving ? side.other : here);
    span.leave(leaving ? here : side.other);
    return;
  }
  // The ray is steeper than the side, so on its path to the wider end it enters for good.
  if (side.radius_rate < 0) return span.leave({.face = face});
  if (start.side == Side::outside) return span.clear();
  if (side.radius_rate > 0) {
    span.enter({.face = face, .root = static_cast<std::uint8_t>(side.a < 0 ? 1 : 0)});
  }
}

}  // namespace crt::core
