// A ray along z is a point of the profile's plane. It is in the profile if all points next to it
// are. Where walls pass through the point, parity is asked of the points that are moved by (e, e^2)
// and by (-e, -e^2), for an infinitely small e, and the walls must cancel in pairs.
#include <algorithm>
#include <limits>
#include <vector>

#include "core/geometry/open_nodes.hpp"
#include "core/geometry/profile/plane_line.hpp"
#include "core/math/vector.hpp"

namespace crt::core {

namespace {

/// These are the bits of the points that are moved forwards and backwards.
constexpr ShiftMask forwards = 1;
constexpr ShiftMask backwards = 2;

/// Returns whether one of the points is there and the other is not, as both are on what is asked.
bool is_on(ShiftMask mask) {
  return mask == forwards || mask == backwards;
}

/// A WallPart is what leaves the point in one direction of a straight line or a circle.
struct WallPart {
  bool is_arc;
  std::uint32_t first;  ///< the first piece on the line, or the first arc on the circle
  bool onwards;         ///< along that piece, or counterclockwise

  friend bool operator==(const WallPart&, const WallPart&) = default;
};

/// A MovedPoint asks where both points are, without rounding where that matters.
class MovedPoint {
 public:
  MovedPoint(const Profile& profile, PlaneLine& line)
      : profile_(profile), line_(line), near_(line.near().origin), error_(line.origin_error()) {}

  /// Counts a piece, with its arc if it has one.
  void meet(const Profile::Piece& piece);
  /// Returns whether the point is inside, when all pieces were counted that are to its right.
  bool is_inside() const { return inside_ == both_shifts && parts_.empty(); }

 private:
  /// Returns the sign of a coordinate of a corner less that of the point.
  int compare(const Vec3& corner, int axis);
  /// Returns the points that are below a corner.
  ShiftMask below(const Vec3& corner) { return mask_of_sign(compare(corner, 1), backwards); }
  ShiftMask left_of(const Profile::Piece& piece);
  ShiftMask within(const Profile::Arc& arc);
  void meet_arc(const Profile::Piece& piece, ShiftMask left);
  /// Adds a part of a wall, or takes an equal one away.
  void toggle(const WallPart& part);
  void toggle_line(const Profile::Piece& piece, bool along) {
    toggle({.is_arc = false, .first = piece.first, .onwards = along != piece.turned});
  }

  static constexpr double filter_rounding = 0x1p6 * unit_roundoff;
  static constexpr double least_size = 0x1p-450;

  const Profile& profile_;
  PlaneLine& line_;
  const Vec3& near_;
  double error_;
  /// Bits are 1 for the points from which a line in the direction of x crosses an odd number of
  /// walls.
  ShiftMask inside_ = 0;
  std::vector<WallPart> parts_;
};

int MovedPoint::compare(const Vec3& corner, int axis) {
  const double distance = corner[axis] - near_[axis];
  if (std::abs(distance) > filter_rounding * size_in_plane(near_) + error_) {
    return distance > 0 ? 1 : -1;
  }
  const ExactLine& line = line_.exact();
  return (line.weight * Dyadic(corner[axis]) - line.origin[static_cast<std::size_t>(axis)]).sign();
}

/// Returns the points that are to the left of a piece.
ShiftMask MovedPoint::left_of(const Profile::Piece& piece) {
  const Vec3 along = piece.to - piece.from;
  const Vec3 offset = near_ - piece.from;
  const double left = cross_in_plane(along, offset);
  const double error =
      size_in_plane(along) * (filter_rounding * size_in_plane(offset) + 4 * error_);
  if (size_in_plane(along) > least_size && size_in_plane(offset) > least_size &&
      std::abs(left) > error) {
    return left > 0 ? both_shifts : 0U;
  }
  const ExactLine& line = line_.exact();
  const DyadicVector exact_along = exactly(piece.to) - exactly(piece.from);
  const DyadicVector exact_offset = line.origin - line.weight * exactly(piece.from);
  const bool rises = along.y > 0 || (along.y == 0 && along.x < 0);
  return mask_of_sign(cross_in_plane(exact_along, exact_offset).sign(),
                      rises ? backwards : forwards);
}

/// Returns the points that are within the circle of an arc.
ShiftMask MovedPoint::within(const Profile::Arc& arc) {
  const Vec3 offset = near_ - arc.center;
  const double distance = std::sqrt(offset.x * offset.x + offset.y * offset.y);
  const double error = filter_rounding * (distance + arc.radius) + 4 * error_;
  if (arc.radius > least_size && std::abs(distance - arc.radius) > error) {
    return distance < arc.radius ? both_shifts : 0U;
  }
  const ExactLine& line = line_.exact();
  const DyadicVector exact = line.origin - line.weight * exactly(arc.center);
  const Dyadic height =
      square(line.weight * Dyadic(arc.radius)) - square(exact[0]) - square(exact[1]);
  const int outwards = exact[0].sign() != 0 ? exact[0].sign() : exact[1].sign();
  return mask_of_sign(height.sign(), outwards > 0 ? backwards : forwards);
}

void MovedPoint::meet(const Profile::Piece& piece) {
  const ShiftMask across = below(piece.from) ^ below(piece.to);
  const bool is_level = compare(piece.from, 1) == 0 && compare(piece.to, 1) == 0;
  ShiftMask left = 0;
  if (across != 0 || is_level || piece.arc != invalid_index) left = left_of(piece);
  const bool rises = piece.to.y > piece.from.y;
  inside_ ^= across & (rises ? left : complement(left));
  if (is_on(left)) {
    const int axis = piece.from.y != piece.to.y ? 1 : 0;
    const int from = compare(piece.from, axis);
    const int to = compare(piece.to, axis);
    if (from != to) {
      if (from != 0) toggle_line(piece, false);
      if (to != 0) toggle_line(piece, true);
    }
  }
  if (piece.arc != invalid_index) meet_arc(piece, left);
}

void MovedPoint::meet_arc(const Profile::Piece& piece, ShiftMask left) {
  const Profile::Arc& arc = profile_.arcs()[piece.arc];
  const ShiftMask disc = within(arc);
  const ShiftMask beyond = arc.is_right ? complement(left) : left;
  inside_ ^= beyond & disc;
  if (is_on(left) && disc == both_shifts) {
    toggle_line(piece, false);
    toggle_line(piece, true);
  }
  if (!is_on(disc) || beyond == 0) return;
  WallPart part{.is_arc = true, .first = arc.first, .onwards = true};
  if (!is_on(left)) {
    toggle(part);
    part.onwards = false;
    return toggle(part);
  }
  // The point is where the line of the chord meets the circle: chord and arc begin there.
  const ExactLine& line = line_.exact();
  const DyadicVector along = exactly(piece.to) - exactly(piece.from);
  const DyadicVector outwards = line.origin - line.weight * exactly(arc.center);
  const int ahead = (along[0] * outwards[0] + along[1] * outwards[1]).sign();
  toggle_line(piece, ahead < 0);
  // Counterclockwise is to the left of the chord where that points outwards.
  part.onwards = (ahead > 0) != arc.is_right;
  toggle(part);
}

void MovedPoint::toggle(const WallPart& part) {
  const auto found = std::find(parts_.begin(), parts_.end(), part);
  if (found == parts_.end()) {
    parts_.push_back(part);
  } else {
    parts_.erase(found);
  }
}

}  // namespace

bool PlaneLine::is_inside(const Profile& profile) {
  MovedPoint point(profile, *this);
  const Vec3 origin(near_.origin.x, near_.origin.y, 0);
  const RaySlabs slabs(origin, Vec3(1, 0, 0), origin_error_);
  constexpr double rounding = 0x1p-40;
  const double begin = -rounding * (size_in_plane(origin) + profile.bounds().farthest());
  const LineSpan part{begin - origin_error_, std::numeric_limits<double>::infinity()};
  for_leaves(profile.tree(), slabs, part, [&](std::span<const std::uint32_t> pieces) {
    for (const std::uint32_t piece : pieces) point.meet(profile.pieces()[piece]);
  });
  return point.is_inside();
}

}  // namespace crt::core
