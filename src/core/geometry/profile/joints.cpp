#include "core/geometry/profile/joints.hpp"

#include <glm/geometric.hpp>

namespace crt::core {

namespace {

/// Returns the unit vector along a piece at one of its ends.
Vec3 way_at(const Profile& profile, const Profile::Piece& piece, const Vec3& end) {
  if (piece.arc == invalid_index) return unit_vector(piece.to - piece.from);
  const Profile::Arc& arc = profile.arcs()[piece.arc];
  const Vec3 outwards = unit_vector(end - arc.center);
  // What bulges to the right goes about a center to the left.
  return arc.is_right ? Vec3(-outwards.y, outwards.x, 0) : Vec3(outwards.y, -outwards.x, 0);
}

}  // namespace

Joint joint_of(const Profile& profile, std::uint32_t piece, std::uint32_t next) {
  Joint joint;
  joint.place = profile.pieces()[piece].to;
  joint.before = way_at(profile, profile.pieces()[piece], joint.place);
  joint.after = way_at(profile, profile.pieces()[next], joint.place);
  const Vec3 sum = joint.before + joint.after;
  joint.along = glm::dot(sum, sum) > 0 ? unit_vector(sum) : joint.before;
  return joint;
}

Joint joint_of(const Profile& profile, std::uint32_t piece) {
  return joint_of(profile, piece, piece_after(profile, piece));
}

std::uint32_t piece_after(const Profile& profile, std::uint32_t piece) {
  const auto pieces = profile.pieces();
  if (piece + 1 < pieces.size() && pieces[piece + 1].from == pieces[piece].to) return piece + 1;
  // It is the last of its contour.
  while (piece > 0 && pieces[piece - 1].to == pieces[piece].from) --piece;
  return piece;
}

std::uint32_t piece_before(const Profile& profile, std::uint32_t piece) {
  const auto pieces = profile.pieces();
  if (piece > 0 && pieces[piece - 1].to == pieces[piece].from) return piece - 1;
  while (piece + 1 < pieces.size() && pieces[piece + 1].from == pieces[piece].to) ++piece;
  return piece;
}

}  // namespace crt::core
