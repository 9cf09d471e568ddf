#include "core/geometry/profile/near_walls.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <optional>
#include <span>

#include "core/geometry/cut_box.hpp"
#include "core/geometry/open_nodes.hpp"
#include "core/geometry/profile/joints.hpp"
#include "core/geometry/profile/plane_line.hpp"
#include "core/geometry/profile/wall_faces.hpp"
#include "core/math/vector.hpp"

namespace crt::core {

namespace {

/// Returns the sign of an interval whose ends may be 0, or 0 if it has both or is 0.
int sign_of(const Interval& a) {
  if (a.lo == 0 && a.hi == 0) return 0;
  return a.lo >= 0 ? 1 : (a.hi <= 0 ? -1 : 0);
}

bool contains(const PointOf<Interval>& rectangle, const Vec3& corner, double margin) {
  for (std::size_t i = 0; i < 2; ++i) {
    const double place = corner[static_cast<int>(i)];
    if (place < rectangle[i].lo - margin || place > rectangle[i].hi + margin) return false;
  }
  return true;
}

bool touches(const PointOf<Interval>& rectangle, const Bounds& box) {
  return rectangle[0].hi >= box.lower.x && rectangle[0].lo <= box.upper.x &&
         rectangle[1].hi >= box.lower.y && rectangle[1].lo <= box.upper.y;
}

/// Returns 1 if a rectangle is to the left of the line of a piece, -1 if to the right, and else 0.
int side_of_piece(const Profile::Piece& piece, const PointOf<Interval>& rectangle) {
  const PointOf<Interval> offset = relative_to(rectangle, piece.from);
  if (piece.from.x == piece.to.x)
    return piece.to.y > piece.from.y ? -sign_of(offset[0]) : sign_of(offset[0]);
  if (piece.from.y == piece.to.y)
    return piece.to.x > piece.from.x ? sign_of(offset[1]) : -sign_of(offset[1]);
  const PointOf<Interval> along = way_along(piece);
  return sign_of(along[0] * offset[1] - along[1] * offset[0]);
}

/// RegionLook looks at one rectangle.
class RegionLook {
 public:
  RegionLook(const Profile& profile, bool is_turned_about_axis, const PointOf<Interval>& rectangle)
      : profile_(profile), about_axis_(is_turned_about_axis), cut_box_(rectangle) {}

  void look(NearFaces& near);

 private:
  const PointOf<Interval>& rectangle() const { return cut_box_.box(); }
  void find_walls();
  /// These add a wall that is near. What is not plain makes the whole look fail.
  void add(std::uint32_t number);
  void add_flat(std::uint32_t number);
  void add_arc(std::uint32_t number);
  /// Returns the sign of the squared distance from an arc's circle, as sign_of().
  int side_of_circle(const Profile::Arc& arc) const;
  /// Returns whether a rectangle that the line of a chord passes through is between the chord's
  /// ends, so that no other part of the arc's circle passes. It may be for arcs that are short.
  bool is_between_ends(const Profile::Piece& chord, const Profile::Arc& arc) const;
  /// Returns whether two arcs that follow one another are the halves of a circle, whatever it is.
  bool are_whole(const Profile::Piece& one, const Profile::Piece& other) const;
  /// Returns the piece that has the rest of the circle of an arc, or else its own.
  std::uint32_t other_half(std::uint32_t piece) const;
  /// Lists the face of a straight line or a circle, which a key tells from others. Returns whether
  /// it is new.
  bool list(std::size_t key, std::uint32_t face);
  std::size_t line_key(const Profile::Piece& piece) const { return piece.first; }
  std::size_t circle_key(std::uint32_t number) const { return profile_.pieces().size() + number; }
  /// Adds a cut for a wall that is new. There may be too many.
  void add_cut(Cut cut, std::uint32_t wall);
  Cut flat_cut(const Profile::Piece& piece) const;
  Cut arc_cut(const Profile::Arc& arc) const;
  /// Takes down that a piece is near.
  void note(std::uint32_t piece);
  /// Looks at where one piece goes over into another, if no others are near.
  void look_at_joint(NearFaces& near) const;
  void look_at_joint(std::uint32_t piece, std::uint32_t next, NearFaces& near) const;
  Cut cut_of(std::uint32_t piece) const;
  /// Returns whether what is to the left of a piece is where its line's or circle's function is
  /// below 0.
  bool is_left_below(std::uint32_t piece) const;
  /// Returns the face of a piece that has the region to its left, or to its right.
  std::uint32_t face_beside(std::uint32_t piece, bool is_left) const;
  /// Returns on which side of two pieces the region is, if that is plain.
  std::optional<bool> is_region_left(std::uint32_t piece, std::uint32_t next,
                                     const Joint& joint) const;
  std::optional<bool> is_inside(const Vec3& point) const {
    const ObjectRay across{.origin = point};
    return PlaneLine(across).is_inside(profile_);
  }
  /// Returns whether a corner is in the rectangle. On an axis none counts.
  bool has_corner(const Profile::Piece& piece) const {
    const auto counts = [&](const Vec3& corner) {
      return !(about_axis_ && corner.x == 0) && contains(rectangle(), corner, 0);
    };
    return counts(piece.from) || counts(piece.to);
  }

  const Profile& profile_;
  bool about_axis_;
  CutBox cut_box_;
  static constexpr std::size_t most_listed = 16;
  std::array<std::size_t, most_listed> keys_{};
  std::array<std::uint32_t, most_listed> faces_{};
  std::size_t listed_ = 0;
  bool has_more_ = false;  ///< walls than are listed
  std::array<std::uint32_t, 2> near_{};
  std::size_t near_count_ = 0;  ///< of pieces, at most one more than there is room for
  bool has_arcs_ = false;
  bool has_repeats_ = false;  ///< straight walls on one line
  bool has_corners_ = false;  ///< of straight walls
  bool failed_ = false;       ///< what the walls do here is not plain
};

int RegionLook::side_of_circle(const Profile::Arc& arc) const {
  const Interval x = rectangle()[0] - center_across_axis(arc, about_axis_);
  const Interval y = rectangle()[1] - Interval::of(arc.center.y);
  return sign_of(square(x) + square(y) - square(Interval::of(arc.radius)));
}

bool RegionLook::are_whole(const Profile::Piece& one, const Profile::Piece& other) const {
  if (one.arc == invalid_index || other.arc == invalid_index) return false;
  const Profile::Arc& a = profile_.arcs()[one.arc];
  const Profile::Arc& b = profile_.arcs()[other.arc];
  return a.first == b.first && a.is_right == b.is_right && one.from == other.to &&
         one.to == other.from;
}

bool RegionLook::is_between_ends(const Profile::Piece& chord, const Profile::Arc& arc) const {
  const PointOf<Interval> across = rectangle();
  const PointOf<Interval> along = way_along(chord);
  const PointOf<Interval> to_center = relative_to(known_point(arc.center), chord.from);
  const Interval center_is_left = along[0] * to_center[1] - along[1] * to_center[0];
  const bool is_less_than_half = arc.is_right ? center_is_left.lo > 0 : center_is_left.hi < 0;
  const double length = distance(chord.from, chord.to).hi;
  const double size = across[0].width() + across[1].width();
  // The chord is then at most that of a sixth of the circle, and what else of the circle is between
  // the ends of the chord is farther away than the radius.
  if (!is_less_than_half || !(length <= arc.radius) || !(size < arc.radius)) return false;
  const auto place_after = [&](const Vec3& corner) {
    const PointOf<Interval> offset = relative_to(across, corner);
    return along[0] * offset[0] + along[1] * offset[1];
  };
  constexpr double safety = 4;
  const double margin = safety * arc.margin * length;
  return place_after(chord.from).lo > margin && place_after(chord.to).hi < -margin;
}

std::uint32_t RegionLook::other_half(std::uint32_t piece) const {
  const auto pieces = profile_.pieces();
  if (piece > 0 && are_whole(pieces[piece], pieces[piece - 1])) return piece - 1;
  if (piece + 1 < pieces.size() && are_whole(pieces[piece], pieces[piece + 1])) return piece + 1;
  return piece;
}

bool RegionLook::list(std::size_t key, std::uint32_t face) {
  const std::span<const std::size_t> known = std::span(keys_).first(listed_);
  if (std::find(known.begin(), known.end(), key) != known.end()) return false;
  if (listed_ == most_listed) {
    has_more_ = true;
    return false;
  }
  keys_[listed_] = key;
  faces_[listed_++] = face;
  return true;
}

void RegionLook::add_cut(Cut cut, std::uint32_t wall) {
  failed_ = failed_ || listed_ > CutBox::most_cuts;
  if (failed_) return;
  cut.face = face_of_wall(wall, false);
  cut.flipped = face_of_wall(wall, true);
  cut_box_.add(cut);
}

Cut RegionLook::flat_cut(const Profile::Piece& piece) const {
  const PointOf<Interval> along = unit_vector(piece.from, piece.to);
  Cut cut{.slope = {along[1], -along[0], Interval{0, 0}}};
  cut.at_middle =
      component_along(relative_to(known_point(cut_box_.middle()), piece.from), cut.slope);
  return cut;
}

Cut RegionLook::arc_cut(const Profile::Arc& arc) const {
  const Interval radius = Interval::of(arc.radius);
  const Interval x = Interval::of(cut_box_.middle().x) - center_across_axis(arc, about_axis_);
  const Interval y = Interval::of(cut_box_.middle().y) - Interval::of(arc.center.y);
  const Interval curving = Interval::of(0.5) / radius;
  return {.curving = curving,
          .slope = {x / radius, y / radius, Interval{0, 0}},
          .at_middle = (square(x) + square(y) - square(radius)) * curving};
}

void RegionLook::note(std::uint32_t piece) {
  if (near_count_ < near_.size()) near_[near_count_] = piece;
  near_count_ = std::min(near_count_ + 1, near_.size() + 1);
}

Cut RegionLook::cut_of(std::uint32_t piece) const {
  const std::uint32_t arc = profile_.pieces()[piece].arc;
  Cut cut =
      arc == invalid_index ? flat_cut(profile_.pieces()[piece]) : arc_cut(profile_.arcs()[arc]);
  cut.face = face_of_wall(piece, false);
  cut.flipped = face_of_wall(piece, true);
  return cut;
}

void RegionLook::look_at_joint(NearFaces& near) const {
  const auto pieces = profile_.pieces();
  const auto try_at = [&](std::uint32_t piece, std::uint32_t next) {
    if (near.kind == NearFaces::Kind::unknown && pieces[piece].to == pieces[next].from)
      look_at_joint(piece, next, near);
  };
  // Of two pieces that make a contour by themselves, or of one beside a corner, one end may be far
  // enough.
  if (near_count_ == 1) {
    try_at(near_[0], piece_after(profile_, near_[0]));
    try_at(piece_before(profile_, near_[0]), near_[0]);
  } else if (near_count_ == 2) {
    try_at(near_[0], near_[1]);
    try_at(near_[1], near_[0]);
  }
}

void RegionLook::look_at_joint(std::uint32_t piece, std::uint32_t next, NearFaces& near) const {
  const Joint joint = joint_of(profile_, piece, next);
  if (about_axis_ && joint.place.x == 0) return;
  // Both pieces go through the rectangle, so that their ends are beyond it, and arcs are no more
  // than a sixth of their circles there.
  const Interval x = rectangle()[0] - Interval::of(joint.place.x);
  const Interval y = rectangle()[1] - Interval::of(joint.place.y);
  const double farthest = root(square(x) + square(y)).hi;
  for (const std::uint32_t number : {piece, next}) {
    const Profile::Piece& part = profile_.pieces()[number];
    if (!(distance(part.from, part.to).lo > farthest)) return;
    if (part.arc != invalid_index && !(profile_.arcs()[part.arc].radius > 2 * farthest)) return;
  }
  const double cosine = glm::dot(joint.before, joint.after);
  constexpr double of_30_degrees = 0.86;
  if (cosine < -of_30_degrees) return;
  const std::optional<bool> is_left = is_region_left(piece, next, joint);
  if (!is_left) return;
  const std::uint32_t before = face_beside(piece, *is_left);
  const std::uint32_t after = face_beside(next, *is_left);
  if (cosine < of_30_degrees) {
    // The lines or circles cross there alone.
    const bool turns_left = joint.before.x * joint.after.y > joint.before.y * joint.after.x;
    return near.say(turns_left == *is_left ? NearFaces::Kind::where_all_negative
                                           : NearFaces::Kind::where_any_negative,
                    {before, after});
  }
  // Bits 0 and 1 are those of the pieces, and bit 2 says that the first of them counts.
  constexpr std::uint32_t first_or_second = 0xac;
  near.say_by_signs({before, after, face_of_joint(profile_, piece)}, first_or_second);
}

bool RegionLook::is_left_below(std::uint32_t piece) const {
  const std::uint32_t arc = profile_.pieces()[piece].arc;
  return arc == invalid_index || profile_.arcs()[arc].is_right;
}

std::uint32_t RegionLook::face_beside(std::uint32_t piece, bool is_left) const {
  return face_of_wall(piece, is_left != is_left_below(piece));
}

std::optional<bool> RegionLook::is_region_left(std::uint32_t piece, std::uint32_t next,
                                               const Joint& joint) const {
  // As in CutBox, points of round numbers would often be level with corners.
  constexpr std::array<double, 3> shares = {0.4871, 0.0213, 0.9829};
  double farthest = 0;
  Vec3 best(0, 0, 0);
  bool is_left = false;
  for (const double s : shares) {
    for (const double t : shares) {
      const Vec3 point(rectangle()[0].lo + s * rectangle()[0].width(),
                       rectangle()[1].lo + t * rectangle()[1].width(), 0);
      const std::uint32_t beside = glm::dot(point - joint.place, joint.along) < 0 ? piece : next;
      const Interval value =
          cut_of(beside).value(relative_to(known_point(point), cut_box_.middle()));
      const double distance = std::max(value.lo, -value.hi);
      if (!(distance > farthest)) continue;
      farthest = distance;
      best = point;
      is_left = (value.hi < 0) == is_left_below(beside);
    }
  }
  if (farthest == 0) return {};
  const std::optional<bool> inside = is_inside(best);
  if (!inside) return {};
  return *inside == is_left;
}

void RegionLook::add_flat(std::uint32_t number) {
  const Profile::Piece& piece = profile_.pieces()[number];
  note(number);
  has_corners_ = has_corners_ || has_corner(piece);
  if (list(line_key(piece), face_of_wall(number, false))) {
    add_cut(flat_cut(piece), number);
  } else {
    has_repeats_ = true;
  }
}

void RegionLook::add_arc(std::uint32_t number) {
  has_arcs_ = true;
  note(number);
  if (list(circle_key(number), face_of_wall(number, false)))
    add_cut(arc_cut(profile_.arcs()[profile_.pieces()[number].arc]), number);
}

void RegionLook::add(std::uint32_t number) {
  const Profile::Piece& piece = profile_.pieces()[number];
  if (about_axis_ && piece.arc == invalid_index && piece.from.x == 0 && piece.to.x == 0) return;
  if (!touches(rectangle(), profile_.bounds_of(number))) return;
  if (piece.arc == invalid_index) {
    if (side_of_piece(piece, rectangle()) == 0) add_flat(number);
    return;
  }
  const Profile::Arc& arc = profile_.arcs()[piece.arc];
  const int of_circle = side_of_circle(arc);
  if (const std::uint32_t other = other_half(number); other != number) {
    // Both chords are one, and no boundary.
    if (of_circle == 0) add_arc(std::min(number, other));
    return;
  }
  const int side = side_of_piece(piece, rectangle());
  if (side != 0) {
    if (of_circle == 0 && (side < 0) == arc.is_right) add_arc(number);
    return;
  }
  if (of_circle == 0 && is_between_ends(piece, arc)) return add_arc(number);
  // The line of the chord passes. Within the circle it is no boundary but next to the corners.
  constexpr double safety = 4;
  const double margin = safety * arc.margin * glm::length(piece.to - piece.from);
  if (of_circle != 0 && !contains(rectangle(), piece.from, margin) &&
      !contains(rectangle(), piece.to, margin))
    return;
  failed_ = true;
  note(number);
  list(circle_key(number), face_of_wall(number, false));
  list(line_key(piece), face_of_wall(profile_.chord_of(piece.arc), false));
}

void RegionLook::find_walls() {
  OpenNodes<std::uint32_t, 128> open;
  open.push(0);
  while (!open.empty() && !has_more_) {
    profile_.tree().for_each_child(open.pop(), [&](Bvh::Child child, const Bounds& box) {
      if (!touches(rectangle(), box)) return;
      if (!child.is_leaf()) return open.push(child.index());
      for (const std::uint32_t piece :
           profile_.tree().order().subspan(child.index(), child.count()))
        add(piece);
    });
  }
}

void RegionLook::look(NearFaces& near) {
  find_walls();
  near.say(NearFaces::Kind::unknown);
  if (has_more_) return;
  // Walls without ends here go all the way through, and the region is on one side of each.
  const bool takes_turns = !has_corners_ && !has_repeats_;
  if (!failed_ && (takes_turns || !has_arcs_)) {
    const auto is_point_inside = [&](const Vec3& point) { return is_inside(point); };
    if (takes_turns) {
      cut_box_.look_by_turns(is_point_inside, near);
    } else {
      cut_box_.look(is_point_inside, near);
    }
  }
  if (near.kind == NearFaces::Kind::unknown) look_at_joint(near);
  if (near.kind == NearFaces::Kind::unknown) near.faces.assign(&faces_[0], &faces_[listed_]);
}

}  // namespace

PointOf<Interval> way_along(const Profile::Piece& piece) {
  const double unit = power_of_two_below(largest_component(piece.to - piece.from));
  return scaled(relative_to(known_point(piece.to), piece.from), inverse_of_power(unit));
}

Interval center_across_axis(const Profile::Arc& arc, bool is_turned_about_axis) {
  constexpr double nearly = 0x1p-48;
  if (!is_turned_about_axis || std::abs(arc.center.x) > nearly * arc.radius)
    return Interval::of(arc.center.x);
  return {std::min(arc.center.x, 0.0), std::max(arc.center.x, 0.0)};
}

void look_at_region(const Profile& profile, bool is_turned_about_axis,
                    const PointOf<Interval>& rectangle, NearFaces& near) {
  const Bounds& bounds = profile.bounds();
  const bool is_beyond = rectangle[0].hi < bounds.lower.x || rectangle[0].lo > bounds.upper.x ||
                         rectangle[1].hi < bounds.lower.y || rectangle[1].lo > bounds.upper.y;
  if (is_beyond) return near.say(NearFaces::Kind::outside);
  if (!(rectangle[0].width() < infinity && rectangle[1].width() < infinity))
    return near.say(NearFaces::Kind::unknown);
  RegionLook(profile, is_turned_about_axis, rectangle).look(near);
}

}  // namespace crt::core
