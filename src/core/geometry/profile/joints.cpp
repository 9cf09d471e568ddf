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
  const auto pieces = profile.pieces();
  std::uint32_t next = piece + 1;
  if (next == pieces.size() || pieces[next].from != pieces[piece].to) {
    // It is the last of its contour.
    next = piece;
    while (next > 0 && pieces[next - 1].to == pieces[next].from) --next;
  }
  return joint_of(profile, piece, next);
}

}  // namespace crt::core
