#include <array>
#include <cmath>
#include <crt/elementary.hpp>
#include <limits>
#include <numbers>

#include "core/geometry/revolution/turned_walls.hpp"
#include "core/math/vector.hpp"

namespace crt::core {

namespace {

constexpr double half_turn = std::numbers::pi;

struct Direction {
  double z = 1;
  double x = 0;
};

/// Returns the direction at an angle from z towards x. That at a multiple of a quarter of a turn,
/// as near as doubles have it, is exact.
Direction direction_at(double angle) {
  int quarters = 0;
  constexpr double rounding = 0x1p-50;
  if (std::abs(std::remquo(angle, half_turn / 2, &quarters)) > rounding) {
    return {elementary::cos(angle), elementary::sin(angle)};
  }
  constexpr std::array<Direction, 4> axes = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  return axes[static_cast<std::size_t>(quarters & 3)];
}

}  // namespace

TurnedProfile::TurnedProfile(const Revolution& revolution)
    : profile(revolution.profile), angle_(revolution.angle) {
  constexpr double nearly = 1 - 0x1p-50;
  if (angle_ >= 2 * half_turn * nearly) return;
  const Direction last = direction_at(angle_);
  normals = {Vec3(-1, 0, 0), Vec3(last.z, 0, -last.x) + Vec3(0.0)};
  planes = normals[0] == normals[1] ? 1 : end_count;
  is_union = angle_ > half_turn;
}

Primitive TurnedProfile::body(std::uint32_t number) const {
  if (number < end_count) return Plane{.normal = normals[number], .position = {0, 0, 0}};
  const Profile::Wall wall = profile->wall(number - end_count);
  const Profile::Piece& piece = profile->pieces()[wall.piece];
  if (wall.arc != invalid_index) {
    const Profile::Arc& arc = profile->arcs()[wall.arc];
    const Vec3 center(0, arc.center.y, 0);
    const double ring = ring_of(arc);
    if (ring == 0) return Sphere{.center = center, .radius = arc.radius};
    return Torus{.center = center, .radius = ring, .thickness = arc.radius};
  }
  if (is_on_axis(piece)) return Plane{.normal = normals[0], .position = {0, 0, 0}};
  if (piece.from.y == piece.to.y)
    return Plane{.normal = {0, 1, 0}, .position = {0, piece.from.y, 0}};
  // An apex is at the end of a cone. Else it goes upwards.
  const bool turned = piece.from.x == 0 || (piece.to.x != 0 && piece.to.y < piece.from.y);
  const Vec3& from = turned ? piece.to : piece.from;
  const Vec3& to = turned ? piece.from : piece.to;
  return Cone{.from = {0, from.y, 0}, .to = {0, to.y, 0}, .radius = from.x, .radius2 = to.x};
}

std::uint32_t TurnedProfile::body_of_surface(std::uint32_t face) const {
  if (face < end_count) return plane_of_end(face);
  const Profile::Wall wall = profile->wall(wall_of_face(face));
  if (wall.arc == invalid_index) {
    // An arc's own number is that of its chord.
    const std::uint32_t first = profile->pieces()[wall.piece].first;
    const std::uint32_t arc = profile->pieces()[first].arc;
    return end_count + (arc == invalid_index ? first : profile->chord_of(arc));
  }
  return end_count + profile->arcs()[profile->arcs()[wall.arc].first].piece;
}

double TurnedProfile::size() const {
  const Bounds& box = profile->bounds();
  return std::max(2 * box.upper.x, box.upper.y - box.lower.y);
}

Bounds TurnedProfile::bounds() const {
  const Bounds& box = profile->bounds();
  constexpr double rounding = 1 + 0x1p-50;
  const double radius = rounding * box.upper.x;
  const bool is_whole = planes == 0;
  Bounds result;
  const auto include = [&](const Direction& direction, double reach) {
    for (const double y : {box.lower.y, box.upper.y}) {
      const Vec3 point(reach * direction.x, y, reach * direction.z);
      result.include({point, point});
    }
  };
  include({}, 0);
  if (!is_whole) {
    include(direction_at(0), radius);
    include(direction_at(angle_), radius);
  }
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double angle = quarter * half_turn / 2;
    if (is_whole || angle <= angle_) include(direction_at(angle), radius);
  }
  return result;
}

FaceStart TurnedProfile::start_on(std::uint32_t body, const FaceStart& start) const {
  if (start.face == invalid_index) return {};
  FaceStart result{.face = 0, .side = start.side, .on_face = start.on_face};
  if (start.face < end_count || body < end_count) {
    const bool is_on_end = start.face < end_count && plane_of_end(start.face) == body;
    return is_on_end ? result : FaceStart{};
  }
  const std::uint32_t wall = body - end_count;
  if (!are_on_one_surface(*profile, face_of_wall(wall, false), start.face)) return {};
  if (is_turned(start.face)) result.side = opposite(start.side);
  result.on_face = start.on_face && wall == wall_of_face(start.face);
  return result;
}

}  // namespace crt::core
