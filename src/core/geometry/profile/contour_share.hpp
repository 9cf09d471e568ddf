// Points of walls have a coordinate along the contour, for one point or for lanes.
#pragma once

#include "core/geometry/angles.hpp"
#include "core/geometry/profile/profile.hpp"
#include "core/math/vector_lanes.hpp"

namespace crt::core {

/// Returns the share of the contour's length before a point of a straight piece, or next to it.
template <class Real>
Real share_of_piece(const Profile::Piece& piece, const Vec3Of<Real>& position) {
  const Vec3 along = piece.to - piece.from;
  const Vec3Of<Real> from_corner = position - broadcast<Real>(piece.from);
  const double longer = largest_component(along);
  const Vec3Of<Real> scaled = from_corner / broadcast<Real>(longer);
  const Vec3 direction = along / longer;
  const Real way = (scaled.x * direction.x + scaled.y * direction.y) /
                   (direction.x * direction.x + direction.y * direction.y);
  const Real share = clamp(way, Real{}, broadcast<Real>(1));
  return piece.share_from + (piece.share_to - piece.share_from) * share;
}

/// Returns the share of the contour's length before the point of an arc in the direction of (x, y)
/// from its center. Rounding may have put it beyond a corner.
template <class Real>
Real share_of_arc(const Profile& profile, const Profile::Arc& arc, const Real& x, const Real& y) {
  const Profile::Piece& piece = profile.pieces()[arc.piece];
  // Angles are from the first corner, in the sense of the arc.
  const double sense = arc.is_right ? 1 : -1;
  const Vec3 zero = (piece.from - arc.center) / arc.radius;
  const Vec3 end = (piece.to - arc.center) / arc.radius;
  const auto turn_to = [&](const auto& along_x, const auto& along_y) {
    return turn(zero.x * along_x + zero.y * along_y, sense * (zero.x * along_y - zero.y * along_x));
  };
  const double whole = turn_to(end.x, end.y);
  const Real turned = turn_to(x, y);
  const Real share =
      select(turned > 0.5 + 0.5 * whole, Real{}, min(turned / whole, broadcast<Real>(1)));
  return piece.share_from + (piece.share_to - piece.share_from) * share;
}

}  // namespace crt::core
