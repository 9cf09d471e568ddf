#include "core/geometry/revolution/functions.hpp"

#include <algorithm>

namespace crt::core {

namespace {

bool is_cone(const Profile::Piece& piece) {
  return piece.from.x != piece.to.x && piece.from.y != piece.to.y;
}

}  // namespace

RevolutionFunctions::RevolutionFunctions(const TurnedProfile& turned)
    : turned_(turned), ends_{enclosed_unit(turned.normals[0]), enclosed_unit(turned.normals[1])} {
  for (const Profile::Arc& arc : turned_.profile->arcs()) {
    if (ring_of(arc) == 0) moved_ = std::max(moved_, std::abs(arc.center.x));
  }
}

int RevolutionFunctions::max_crossings(std::uint32_t face) const {
  if (face < end_count) return 1;
  if (is_joint(*turned_.profile, face)) return 2;
  const Profile::Wall wall = turned_.profile->wall(wall_of_face(face));
  if (wall.arc != invalid_index) return ring_of(turned_.profile->arcs()[wall.arc]) == 0 ? 2 : 4;
  const Profile::Piece& piece = turned_.profile->pieces()[wall.piece];
  return piece.from.y == piece.to.y ? 1 : 2;
}

void RevolutionFunctions::look(const PointOf<Interval>& box, NearFaces& near) const {
  Interval distance = root(square(box[0]) + square(box[2]));
  if (moved_ > 0) distance = distance + Interval{-moved_, moved_};
  const PointOf<Interval> rectangle = {Interval{std::max(distance.lo, 0.0), distance.hi}, box[1],
                                       Interval{0, 0}};
  look_at_region(*turned_.profile, true, rectangle, near);
  take_walls_of_bodies(rectangle, near);
  if (turned_.planes > 0) look_between_ends(box, near);
}

void RevolutionFunctions::take_walls_of_bodies(const PointOf<Interval>& rectangle,
                                               NearFaces& near) const {
  for (std::uint32_t& face : near.faces) {
    if (is_joint(*turned_.profile, face)) continue;
    const Profile::Wall wall = turned_.profile->wall(wall_of_face(face));
    if (wall.arc != invalid_index) continue;
    // What is to the right of a piece is above it, or away from the axis, or not.
    const Profile::Piece& piece = turned_.profile->pieces()[wall.piece];
    const bool is_level = piece.from.y == piece.to.y;
    const bool is_body = is_level ? piece.to.x < piece.from.x : piece.to.y > piece.from.y;
    if (!is_body) face = face_of_wall(wall_of_face(face), !is_turned(face));
    if (!is_cone(piece)) continue;
    const PointOf<Interval> along = way_along(piece);
    const Interval radius = Interval::of(piece.from.x) +
                            (rectangle[1] - Interval::of(piece.from.y)) * (along[0] / along[1]);
    if (!(radius.lo >= 0 || radius.lo + rectangle[0].lo > 0)) near.kind = NearFaces::Kind::unknown;
  }
}

void RevolutionFunctions::look_between_ends(const PointOf<Interval>& box, NearFaces& near) const {
  std::array<std::uint32_t, end_count> crossing{};
  std::uint32_t crossing_count = 0;
  bool is_in_one = false;
  bool is_in_all = true;
  for (std::uint32_t end = 0; end < turned_.planes; ++end) {
    const Interval beyond = value(end, box);
    if (beyond.hi < 0) {
      is_in_one = true;
      continue;
    }
    is_in_all = false;
    if (beyond.lo <= 0) {
      crossing[crossing_count++] = end;
    } else if (!turned_.is_union) {
      return near.say(NearFaces::Kind::outside);
    }
  }
  if (is_in_all || (turned_.is_union && is_in_one)) return;
  if (crossing_count == 0) return near.say(NearFaces::Kind::outside);
  if (crossing_count == 1 || !turned_.is_union) {
    for (std::uint32_t i = 0; i < crossing_count; ++i) near.keep_within(crossing[i]);
  } else if (near.kind == NearFaces::Kind::inside) {
    near.say(NearFaces::Kind::where_any_negative, {0, 1});
  } else {
    // It is cut by walls or nothing is known, and keeps its faces.
    for (const std::uint32_t end : crossing) near.keep_within(end);
    if (near.kind != NearFaces::Kind::outside) near.kind = NearFaces::Kind::unknown;
  }
}

}  // namespace crt::core
