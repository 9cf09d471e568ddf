#include "core/geometry/extrusion/crossed_walls.hpp"

#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <vector>

#include "core/geometry/exact_plane.hpp"
#include "core/geometry/open_nodes.hpp"
#include "core/geometry/order_of_places.hpp"
#include "core/geometry/profile/agree_with_start.hpp"
#include "core/geometry/profile/errors_beside.hpp"
#include "core/math/vector.hpp"

namespace crt::core {

namespace {

/// A CrossedWall is a crossing of the line with a wall. Its face is not turned.
struct CrossedWall {
  Crossing crossing;
  ShiftMask shifts = 0;  ///< the lines that cross it
  bool along_normal = false;
  const Vec3* corner = nullptr;  ///< where the line passes exactly through an end of the wall
};

/// Returns the end of a piece that is exactly on the line, if there is just one.
const Vec3* corner_on_line(const Profile::Piece& piece, const CornerSide& from,
                           const CornerSide& to) {
  if (from.is_on_line() == to.is_on_line()) return nullptr;
  return from.is_on_line() ? &piece.from : &piece.to;
}

/// CrossedWalls makes one list of crossings.
class CrossedWalls {
 public:
  CrossedWalls(const Profile& profile, PlaneLine& line, const ExtrusionTier& tier, double shortest,
               CrossingList& out)
      : profile_(profile),
        line_(line),
        ray_(line.near()),
        tier_(tier),
        longest_error_(shortest),
        out_(out) {}

  void append();

 private:
  /// Returns whether the ray starts on the surface of a face.
  bool starts_on(std::uint32_t face) const {
    return ray_.start.face != invalid_index && are_on_one_surface(profile_, face, ray_.start.face);
  }
  void clip_at_end(std::uint32_t end);
  void find();
  void meet(std::uint32_t number);
  void add_flat(std::uint32_t wall, ShiftMask shifts, const CornerSide& from, const CornerSide& to);
  void add_round(std::uint32_t arc, const ArcCut& cut, const Vec3* corner);
  void unite_at_corners();
  bool meet_flat(const Profile::Piece& piece, Crossing& crossing);
  std::array<Crossing, 2> meet_circle(std::uint32_t arc);
  int order(const Crossing& a, const Crossing& b) const;
  using Walls = std::pmr::vector<CrossedWall>;

  void bound_by(const Crossing& other, Crossing& crossing) const {
    if (!starts_on(crossing.face)) core::bound_by(other, longest_error_, crossing);
  }
  void append_parts();
  void append_part(const Crossing& enter, const Crossing& leave);

  const Profile& profile_;
  PlaneLine& line_;
  const ObjectRay& ray_;
  const ExtrusionTier& tier_;
  LongestError longest_error_;
  EndSpan ends_;
  CrossingList& out_;
  // The crossed walls of most lines fit here.
  std::array<std::byte, 64 * sizeof(CrossedWall)> buffer_;
  std::pmr::monotonic_buffer_resource memory_{buffer_.data(), buffer_.size()};
  Walls walls_{&memory_};
  double largest_error_ = 0;  ///< of the crossings with walls
};

void CrossedWalls::append() {
  for (std::uint32_t end = 0; end < end_count; ++end) clip_at_end(end);
  if (ends_.is_empty || ends_.enter.t > ends_.leave.t) return;
  if (line_.is_point()) {
    if (line_.is_inside(profile_)) append_part(ends_.enter, ends_.leave);
    return;
  }
  constexpr std::size_t max_at_first = 32;
  walls_.reserve(max_at_first);
  find();
  unite_at_corners();
  std::sort(walls_.begin(), walls_.end(), [this](const CrossedWall& a, const CrossedWall& b) {
    const int by_place = order(a.crossing, b.crossing);
    return by_place != 0 ? by_place < 0 : a.crossing.face < b.crossing.face;
  });
  append_parts();
}

void CrossedWalls::clip_at_end(std::uint32_t end) {
  const EndMeeting meeting = tier_.meet_end(end);
  Crossing crossing = meeting.crossing;
  crossing.face = end;
  if (ray_.start.face == end) {
    crossing = {.face = end};
    if (meeting.side > 0) {
      ends_.leave = crossing;
    } else if (ray_.start.side == Side::outside) {
      ends_.is_empty = true;
    } else if (meeting.side < 0) {
      ends_.enter = crossing;
    }
    return;
  }
  if (!meeting.found) {
    ends_.is_empty = ends_.is_empty || !meeting.behind;
    return;
  }
  // A ray that starts on another face starts between the ends, whatever rounding says.
  const bool is_between = ray_.start.face != invalid_index && ray_.start.on_face;
  const bool is_off = meeting.side < 0 ? crossing.t > 0 : crossing.t < 0;
  if (is_between && is_off) crossing = {.face = end};
  (meeting.side < 0 ? ends_.enter : ends_.leave) = crossing;
}

void CrossedWalls::find() {
  const auto in_plane = [](const Vec3& v) { return Vec3(v.x, v.y, 0); };
  const RaySlabs slabs(in_plane(ray_.origin), in_plane(ray_.direction), line_.origin_error());
  const LineSpan part{-infinity, ends_.leave.t + ends_.leave.error};
  for_leaves(profile_.tree(), slabs, part, [&](std::span<const std::uint32_t> pieces) {
    for (const std::uint32_t piece : pieces) meet(piece);
  });
}

void CrossedWalls::meet(std::uint32_t number) {
  const Profile::Piece& piece = profile_.pieces()[number];
  const CornerSide from = line_.side_of(piece.from);
  const CornerSide to = line_.side_of(piece.to);
  if (piece.arc == invalid_index) {
    const ShiftMask shifts = from.left ^ to.left;
    if (shifts != 0) add_flat(number, shifts, from, to);
    return;
  }
  const ArcCut cut = line_.cut(profile_.arcs()[piece.arc], piece, from, to);
  if (cut.chord != 0) add_flat(profile_.chord_of(piece.arc), cut.chord, from, to);
  if ((cut.enter | cut.leave) != 0) add_round(piece.arc, cut, corner_on_line(piece, from, to));
}

void CrossedWalls::add_flat(std::uint32_t wall, ShiftMask shifts, const CornerSide& from,
                            const CornerSide& to) {
  const Profile::Piece& piece = profile_.pieces()[profile_.wall(wall).piece];
  Crossing crossing{.face = face_of_wall(wall, false)};
  if (!starts_on(crossing.face) && !meet_flat(profile_.pieces()[piece.first], crossing)) {
    const Vec3 offset = piece.from - ray_.origin;
    const double ahead = offset.x * ray_.direction.x + offset.y * ray_.direction.y;
    crossing.t = std::copysign(infinity, ahead);
  }
  walls_.push_back(
      {crossing, shifts, PlaneLine::goes_right(from, to), corner_on_line(piece, from, to)});
  largest_error_ = std::max(largest_error_, crossing.error);
}

/// Finds where the line crosses the plane of a piece, which is the first in that plane. A line that
/// is all but parallel to it crosses it exactly there: rounding would not even leave the sign of t.
/// Returns false if t is beyond all doubles.
bool CrossedWalls::meet_flat(const Profile::Piece& piece, Crossing& crossing) {
  if (tier_.meet(piece.first, crossing) && !longest_error_.is_exceeded_by(crossing)) return true;
  const ExactPlane plane = ExactPlane::through(piece.from, piece.to, piece.from + Vec3(0, 0, 1));
  const ExactPlane::Fraction t = plane.meet_exactly(line_.exact());
  if (t.side == 0) return false;
  const DoubleDouble rounded = (t.numerator.rounded() / t.denominator.rounded()).unscaled();
  tier_.place(rounded, crossing);
  return std::isfinite(crossing.t);
}

void CrossedWalls::add_round(std::uint32_t arc, const ArcCut& cut, const Vec3* corner) {
  const std::uint32_t face = face_of_wall(profile_.arcs()[arc].piece, false);
  const std::array<Crossing, 2> met = meet_circle(arc);
  const auto add = [&](const Crossing& crossing, ShiftMask shifts, bool leaves) {
    if (shifts == 0) return;
    // Only one of both lines crosses an arc where the corner is exactly on its circle.
    walls_.push_back({crossing, shifts, leaves, shifts != both_shifts ? corner : nullptr});
    walls_.back().crossing.face = face;
    walls_.back().crossing.root = leaves ? 1 : 0;
    largest_error_ = std::max(largest_error_, crossing.error);
  };
  add(met[0], cut.enter, false);
  add(met[1], cut.leave, true);
}

std::array<Crossing, 2> CrossedWalls::meet_circle(std::uint32_t arc_number) {
  const Profile::Arc& arc = profile_.arcs()[arc_number];
  if (starts_on(face_of_wall(arc.piece, false))) {
    const Crossing here;
    Crossing other = tier_.meet_circle_again(arc.first);
    const bool goes_in = (ray_.start.side == Side::inside) != is_turned(ray_.start.face);
    other.t = goes_in ? std::max(other.t, 0.0) : std::min(other.t, 0.0);
    if (other.t == 0) other.t_low = 0;
    return goes_in ? std::array{here, other} : std::array{other, here};
  }
  const PlaneLine::ChordOfLine chord = line_.rough_chord(arc);
  const double scale = line_.direction_scale();
  const double error = scale * chord.error;
  const Crossing enter{.t = scale * (chord.middle - chord.half), .error = error};
  const Crossing leave{.t = scale * (chord.middle + chord.half), .error = error};
  if (leave.t + error < ends_.enter.t - ends_.enter.error ||
      enter.t - error > ends_.leave.t + ends_.leave.error) {
    return {enter, leave};
  }
  std::array<Crossing, 2> met = tier_.meet_circle(arc.first, ends_);
  const bool is_long = std::any_of(met.begin(), met.end(), [this](const Crossing& crossing) {
    return longest_error_.is_exceeded_by(crossing);
  });
  if (!is_long && met[0].t < met[1].t) return met;
  // The line is all but along the wall, or touches it but for rounding.
  const ExactQuadratic circle = line_.equation(arc);
  if (circle.discriminant().sign() <= 0) return {enter, leave};
  const std::array<DoubleDouble, 2> roots = circle.roots();
  for (std::size_t i = 0; i < met.size(); ++i) tier_.place(roots[i], met[i]);
  if (!std::isfinite(met[0].t)) met[0] = enter;
  if (!std::isfinite(met[1].t)) met[1] = leave;
  return met;
}

/// Gives walls that the line crosses in one corner one place there, whatever rounding says.
void CrossedWalls::unite_at_corners() {
  for (auto wall = walls_.begin(); wall != walls_.end(); ++wall) {
    if (wall->corner == nullptr) continue;
    const auto first = std::find_if(walls_.begin(), wall, [&](const CrossedWall& earlier) {
      return earlier.corner != nullptr && *earlier.corner == *wall->corner;
    });
    if (first == wall || starts_on(wall->crossing.face)) continue;
    const double error = std::max(first->crossing.error, wall->crossing.error);
    wall->crossing.t = first->crossing.t;
    wall->crossing.t_low = first->crossing.t_low;
    if (!starts_on(first->crossing.face)) wall->crossing.error = error;
  }
}

int CrossedWalls::order(const Crossing& a, const Crossing& b) const {
  return order_of_places(
      a, b, [this](std::uint32_t face) { return starts_on(face); },
      [this](const Crossing& one, const Crossing& other) { return tier_.order(one, other); });
}

/// Follows the line from wall to wall. It is in the profile where both lines are, that next to its
/// right and that next to its left. What they cross in one place changes it at once.
void CrossedWalls::append_parts() {
  ShiftMask inside = 0;
  Crossing enter;
  for (auto group = walls_.begin(); group != walls_.end();) {
    const bool was_inside = inside == both_shifts;
    auto chosen = group;
    auto end = group;
    for (; end != walls_.end() && order(group->crossing, end->crossing) == 0; ++end) {
      inside ^= end->shifts;
      if (starts_on(end->crossing.face) && !starts_on(chosen->crossing.face)) chosen = end;
    }
    const bool is_inside = inside == both_shifts;
    if (is_inside != was_inside) {
      Crossing crossing = chosen->crossing;
      crossing.entering = is_inside;
      if (!starts_on(crossing.face)) {
        bound_beside(walls_, group, end, largest_error_, longest_error_, crossing);
      }
      if (chosen->along_normal == is_inside) ++crossing.face;
      if (is_inside) {
        enter = crossing;
      } else {
        append_part(enter, crossing);
      }
    }
    group = end;
  }
  if (inside == both_shifts) append_part(enter, ends_.leave);
}

/// Appends what of a part of the line in the profile is between the ends.
void CrossedWalls::append_part(const Crossing& enter, const Crossing& leave) {
  const bool begins_at_end = order(ends_.enter, enter) > 0;
  const bool ends_at_end = order(ends_.leave, leave) < 0;
  Crossing first = begins_at_end ? ends_.enter : enter;
  Crossing last = ends_at_end ? ends_.leave : leave;
  bound_by(begins_at_end ? enter : ends_.enter, first);
  bound_by(ends_at_end ? leave : ends_.leave, last);
  if (!(order(first, last) < 0) || !std::isfinite(first.t) || !std::isfinite(last.t)) return;
  first.entering = true;
  last.entering = false;
  out_.push_back(first);
  out_.push_back(last);
}

}  // namespace

void append_crossings(const Profile& profile, PlaneLine& line, const ExtrusionTier& tier,
                      double shortest, CrossingList& out) {
  const std::size_t begin = out.size();
  CrossedWalls(profile, line, tier, shortest, out).append();
  const FaceStart& start = line.near().start;
  if (start.face != invalid_index && start.on_face) {
    const bool is_round =
        start.face >= end_count && profile.wall(wall_of_face(start.face)).arc != invalid_index;
    const bool goes_into_circle = (start.side == Side::inside) != is_turned(start.face);
    agree_with_start(line.near(), is_round && !goes_into_circle ? 1 : 0,
                     profile.bounds().farthest(), shortest, begin, out);
  }
}

}  // namespace crt::core
