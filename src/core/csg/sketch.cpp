#include "core/csg/sketch.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "core/csg/evaluate.hpp"
#include "core/csg/program.hpp"

namespace crt::core {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Relative, 512 roundings: far more than what the sums here are off by and the bounds on the errors of exact
/// crossings together.
constexpr double slack = 0x1p-44;
/// A start that was meant to be on a sphere is off it by less than so much of what is allowed for in all.
constexpr double share_of_start = 0x1p-4;

/// Squares of such sizes, and of what matters beside them, are normal numbers.
bool has_fair_size(double size) {
  return size > 0x1p-300 && size < 0x1p300;
}

/// Of a box.
constexpr bool is_upper(std::uint32_t face) {
  return face % 2 == 1;
}

constexpr std::uint32_t bit_of(std::size_t index) {
  return std::uint32_t{1} << index;
}

/// The index of the last bit that is set, which is taken away; there must be one.
std::uint32_t take_bit(std::uint32_t& bits) {
  const auto index = static_cast<std::uint32_t>(std::countr_zero(bits));
  bits &= bits - 1;
  return index;
}

}  // namespace

CsgSketch::Spheres CsgSketch::Spheres::nowhere() {
  const Lanes none = lanes_of(unknown);
  return {.center = {none, none, none}, .radius = none};
}

bool CsgSketch::Spheres::set(std::size_t lane, const Leaf& leaf) {
  const Surface surface = leaf.shape->surface(0);
  const std::optional<Vec3> place = leaf.placement->exactly_to_world(surface.position);
  if (surface.kind != SurfaceKind::sphere || !place || !has_fair_size(surface.sizes[0])) return false;
  for (std::size_t axis = 0; axis < 3; ++axis) center[axis][lane] = (*place)[static_cast<int>(axis)];
  radius[lane] = surface.sizes[0];
  return true;
}

CsgSketch::Boxes CsgSketch::Boxes::nowhere() {
  const Lanes none = lanes_of(unknown);
  return {.lower = {none, none, none}, .upper = {none, none, none}};
}

bool CsgSketch::Boxes::set(std::size_t lane, const Leaf& leaf) {
  // Of all shapes only the box has six faces, two across each axis.
  if (leaf.face_count != 6) return false;
  for (std::uint32_t face = 0; face < leaf.face_count; ++face) {
    const std::optional<Vec3> place = leaf.placement->exactly_to_world(leaf.shape->surface(face).position);
    if (!place) return false;
    const std::size_t axis = face / 2;
    (is_upper(face) ? upper : lower)[axis][lane] = (*place)[static_cast<int>(axis)];
  }
  return true;
}

/// What of a ray does not change from leaf to leaf.
class CsgSketch::Line {
 public:
  Line(const WorldRay& ray, double end)
      : begin(ray.t_min),
        certain_from(farthest_start(ray)),
        limit(std::min(end, std::numeric_limits<double>::max())),
        off_surface(ray.start.t_error) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      origin[axis] = ray.origin[static_cast<int>(axis)];
      direction[axis] = ray.direction[static_cast<int>(axis)];
      inverse[axis] = 1 / direction[axis];
    }
    squared_speed = dot(direction, direction);
    inverse_squared_speed = 1 / squared_speed;
    inverse_speed = std::sqrt(inverse_squared_speed);
  }

  /// Whether all of it can be squared and divided by.
  bool is_fair() const {
    constexpr double steepest = 0x1p500;
    bool fair = squared_speed > 1 / steepest && squared_speed < steepest;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      fair = fair && (direction[axis] == 0 || std::abs(inverse[axis]) < steepest);
    }
    return fair;
  }

  std::array<double, 3> origin;
  std::array<double, 3> direction;
  std::array<double, 3> inverse;
  double squared_speed;
  double inverse_squared_speed;
  double inverse_speed;
  double begin;
  double certain_from;  ///< what is at the start, and what ahead of it, is told by more than t up to there
  double limit;         ///< finite, unlike what never comes
  double off_surface;   ///< how far rounding may have put the start from the surface that it is on
};

/// Where a line enters and leaves each leaf: at some t from `from` to `to`. Of a leaf that it misses these
/// are at infinity, so that it is in no such interval; where nothing is known they are not numbers, and all
/// comparing with them says no.
class CsgSketch::Ends {
 public:
  explicit Ends(const Line& line) : line_(line) {}

  /// With w the way to the center, the closest approach is at c = w . d / d^2, at a squared distance of q^2,
  /// and half the chord is h with h^2 = (r^2 - q^2) / d^2.
  ///
  /// Roundings change h^2 by less than 32 u (w^2 + r^2) / d^2. Let E be 16 times that, and a little more if
  /// the start was rounded: then the ends are between c +- (H - 2 E / H) and c +- H for H^2 = h^2 + E, and so
  /// are they with the error bounds of an exact test (standard_error(), grazing_error(): e = 16 u r^2 / (d^2
  /// h) at most and never more than sqrt(2 h e)), as (h + e)^2 <= h^2 + E/4 and (h - e) H >= h^2 - E/4. If
  /// the chord is as short as that, H - 2 E / H is negative, and the inside of the sphere is nowhere certain.
  void set(const Spheres& spheres, std::size_t group) {
    const std::array<Lanes, 3> way = way_to(spheres);
    const Lanes squared_radius = spheres.radius * spheres.radius;
    const Lanes closest = dot_with_direction(way) * line_.inverse_squared_speed;
    const std::array<Lanes, 3> across = {way[0] - closest * line_.direction[0],
                                         way[1] - closest * line_.direction[1],
                                         way[2] - closest * line_.direction[2]};
    const Lanes room_error = room_error_of(dot(way, way), squared_radius, spheres.radius);
    const Lanes room = squared_radius - dot(across, across) + room_error;
    const Lanes outer = sqrt(room * line_.inverse_squared_speed);
    const Lanes inner = outer - 2.0 * line_.inverse_squared_speed * room_error / outer;
    const Lanes error = slack * (size_of(closest) + spheres.radius * line_.inverse_speed);
    const LaneMask missed = room < 0.0;
    enter_from_[group] = missed ? lanes_of(infinity) : closest - outer - error;
    enter_to_[group] = closest - inner + error;
    leave_from_[group] = closest + inner - error;
    leave_to_[group] = missed ? lanes_of(-infinity) : closest + outer + error;
    finish(group);
  }

  /// By slabs; three roundings go into each t. A line along a face's plane is told nothing.
  void set(const Boxes& boxes, std::size_t group) {
    Lanes enter_from = lanes_of(-infinity);
    Lanes enter_to = lanes_of(-infinity);
    Lanes leave_from = lanes_of(infinity);
    Lanes leave_to = lanes_of(infinity);
    LaneMask known = enter_from < leave_from;
    constexpr double less = 1 - slack;
    constexpr double more = 1 + slack;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Lanes first = (boxes.lower[axis] - line_.origin[axis]) * line_.inverse[axis];
      const Lanes second = (boxes.upper[axis] - line_.origin[axis]) * line_.inverse[axis];
      const Lanes low = min(first, second);
      const Lanes high = max(first, second);
      known &= (first <= second) | (first > second);
      enter_from = max(enter_from, min(low * less, low * more));
      enter_to = max(enter_to, max(low * less, low * more));
      leave_from = min(leave_from, min(high * less, high * more));
      leave_to = min(leave_to, max(high * less, high * more));
    }
    const LaneMask missed = enter_from > leave_to;
    enter_from_[group] = known ? (missed ? lanes_of(infinity) : enter_from) : lanes_of(unknown);
    enter_to_[group] = known ? enter_to : lanes_of(unknown);
    leave_from_[group] = known ? leave_from : lanes_of(unknown);
    leave_to_[group] = known ? (missed ? lanes_of(-infinity) : leave_to) : lanes_of(unknown);
    finish(group);
  }

  /// A leaf that the ray starts on and leaves for good.
  void set_left(std::size_t place) {
    for (PerGroup* enter : {&enter_from_, &enter_to_}) set(*enter, place, infinity);
    for (PerGroup* leave : {&leave_from_, &leave_to_}) set(*leave, place, -infinity);
    outside_ |= bit_of(place);
  }
  /// A leaf that the ray starts on and goes into; false if it is not plain that it does.
  bool set_entered(std::size_t place) {
    for (PerGroup* enter : {&enter_from_, &enter_to_}) set(*enter, place, -infinity);
    return leave_from(place) > line_.certain_from;
  }

  /// Whether the distance of the start from a sphere's surface is what rounding makes of 0.
  bool starts_on(const Spheres& spheres, std::size_t lane) const {
    const std::array<Lanes, 3> way = way_to(spheres);
    const Lanes squared_way = dot(way, way);
    const Lanes squared_radius = spheres.radius * spheres.radius;
    const Lanes off = size_of(squared_way - squared_radius);
    return off[lane] < share_of_start * room_error_of(squared_way, squared_radius, spheres.radius)[lane];
  }

  /// The leaves that the line surely is outside of as long as it matters.
  Places outside() const { return outside_; }
  double enter_from(std::size_t place) const { return at(enter_from_, place); }
  double enter_to(std::size_t place) const { return at(enter_to_, place); }
  double leave_from(std::size_t place) const { return at(leave_from_, place); }
  double leave_to(std::size_t place) const { return at(leave_to_, place); }

  /// The first t not before this one at which the line may be inside of a leaf, and outside of it.
  double inside_from(std::size_t place, double t) const {
    return t > leave_to(place) ? infinity : std::max(t, enter_from(place));
  }
  double outside_from(std::size_t place, double t) const {
    return t > enter_to(place) && t < leave_from(place) ? leave_from(place) : t;
  }

  /// The leaves of a group that the line surely is inside of from one t to another, and outside of.
  Places inside(std::size_t group, double from, double to) const {
    return bits((enter_to_[group] < from) & (leave_from_[group] > to), group);
  }
  Places outside(std::size_t group, double from, double to) const {
    return bits((enter_from_[group] > to) | (leave_to_[group] < from), group);
  }

 private:
  using PerGroup = std::array<Lanes, most_places / lane_count>;

  static void set(PerGroup& ends, std::size_t place, double t) {
    ends[place / lane_count][place % lane_count] = t;
  }
  static double at(const PerGroup& ends, std::size_t place) {
    return ends[place / lane_count][place % lane_count];
  }
  static Places bits(const LaneMask& mask, std::size_t group) {
    return mask_of(mask) << (group * lane_count);
  }

  std::array<Lanes, 3> way_to(const Spheres& spheres) const {
    return {spheres.center[0] - line_.origin[0], spheres.center[1] - line_.origin[1],
            spheres.center[2] - line_.origin[2]};
  }
  Lanes dot_with_direction(const std::array<Lanes, 3>& v) const {
    return v[0] * line_.direction[0] + v[1] * line_.direction[1] + v[2] * line_.direction[2];
  }
  /// E d^2, see above.
  Lanes room_error_of(const Lanes& squared_way, const Lanes& squared_radius, const Lanes& radius) const {
    constexpr double surfaces_off = 32;
    return slack * (squared_way + squared_radius) + (surfaces_off * line_.off_surface) * radius;
  }

  /// What may be at the start may be before it as well.
  void finish(std::size_t group) {
    const auto widen = [&](Lanes& from) {
      from = from <= line_.certain_from ? min(from, lanes_of(line_.begin)) : from;
    };
    widen(enter_from_[group]);
    widen(leave_from_[group]);
    outside_ |= outside(group, line_.begin, line_.limit);
  }

  const Line& line_;
  PerGroup enter_from_;
  PerGroup enter_to_;
  PerGroup leave_from_;
  PerGroup leave_to_;
  Places outside_ = 0;
};

CsgSketch::CsgSketch(const CsgProgram& program, std::span<const Leaf> leaves,
                     std::span<const FaceSurface> faces) {
  if (leaves.size() > most_places || program.nodes.size() > most_places) return;
  CsgSketch sketch;
  sketch.first_leaf_ = program.first_leaf;
  sketch.first_face_ = leaves.front().first_face;
  sketch.end_face_ = leaves.back().first_face + leaves.back().face_count;
  if (!sketch.place_leaves(leaves)) return;
  sketch.place_nodes(program);
  for (std::uint32_t face = sketch.first_face_; face < sketch.end_face_; ++face) {
    if (faces[face].surface < sketch.first_face_) sketch.shares_surfaces_ = true;
  }
  *this = std::move(sketch);
}

bool CsgSketch::place_leaves(std::span<const Leaf> leaves) {
  std::vector<std::uint32_t> boxes;
  std::size_t place = 0;
  for (std::uint32_t i = 0; i < leaves.size(); ++i) {
    if (leaves[i].face_count != 1) {
      boxes.push_back(i);
      continue;
    }
    if (place % lane_count == 0) spheres_.push_back(Spheres::nowhere());
    if (!spheres_.back().set(place % lane_count, leaves[i])) return false;
    put(i, leaves[i], place++);
  }
  place = spheres_.size() * lane_count;
  for (const std::uint32_t i : boxes) {
    if (place == most_places) return false;
    if (place % lane_count == 0) boxes_.push_back(Boxes::nowhere());
    if (!boxes_.back().set(place % lane_count, leaves[i])) return false;
    put(i, leaves[i], place++);
  }
  return true;
}

void CsgSketch::put(std::uint32_t index, const Leaf& leaf, std::size_t place) {
  place_of_[index] = static_cast<std::uint8_t>(place);
  leaf_at_[place] = static_cast<std::uint8_t>(index);
  used_ |= bit_of(place);
  if (leaf.complemented) complemented_ |= bit_of(place);
}

void CsgSketch::place_nodes(const CsgProgram& program) {
  nodes_.resize(program.nodes.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    nodes_[i].all = program.nodes[i].needed > 1;
    if (i > 0) nodes_[program.nodes[i].parent].nodes |= bit_of(i);
  }
  for (std::size_t i = 0; i < program.leaf_count(); ++i) {
    nodes_[program.leaf_parents[i]].leaves |= bit_of(place_of_[i]);
  }
}

std::size_t CsgSketch::bytes() const {
  return spheres_.capacity() * sizeof(Spheres) + boxes_.capacity() * sizeof(Boxes) +
         nodes_.capacity() * sizeof(Node);
}

SketchedChange CsgSketch::first_change(const WorldRay& ray, double limit, std::span<const Leaf> leaves,
                                       std::span<const FaceSurface> faces) const {
  const Line line(ray, limit);
  if (!line.is_fair()) return {};
  Ends ends(line);
  for (std::size_t i = 0; i < spheres_.size(); ++i) ends.set(spheres_[i], i);
  for (std::size_t i = 0; i < boxes_.size(); ++i) ends.set(boxes_[i], spheres_.size() + i);
  if (ray.start.surface != nothing && !set_start(ray.start, line, leaves, faces, ends)) return {};

  bool value = true;
  double from = possible_from(ends, 0, line.begin, value);
  if (from == line.begin) {
    value = false;
    from = possible_from(ends, 0, line.begin, value);
  }
  while (from <= line.limit) {
    const double next = possible_from(ends, 0, from, value);
    if (next == from) return change_at(from, value, line, ends);
    from = next;
  }
  return {.kind = SketchedChange::Kind::none};
}

/// The change at the end of a leaf that begins at `from`, if there is just one and it is certain.
SketchedChange CsgSketch::change_at(double from, bool value, const Line& line, const Ends& ends) const {
  if (!(from > line.certain_from)) return {};
  const Places turned = turned_for(value);
  for (Places places = used_; places != 0;) {
    const std::uint32_t place = take_bit(places);
    const bool leaving = (turned & bit_of(place)) != 0;
    if ((leaving ? ends.leave_from(place) : ends.enter_from(place)) != from) continue;
    const double to = leaving ? ends.leave_to(place) : ends.enter_to(place);
    // Next to grazing it, the leaf may not be met at all.
    const bool is_apart = leaving ? ends.enter_to(place) < from : ends.leave_from(place) > to;
    if (!(to < line.limit) || !is_apart || !hangs_on(place, ends, from, to)) return {};
    return {.kind = SketchedChange::Kind::one,
            .into_object = value,
            .into_leaf = !leaving,
            .leaf = leaf_at_[place],
            .from = from,
            .to = to};
  }
  return {};
}

/// Of the surface at the start it is known otherwise where the ray meets it; false if not by all that is
/// told here.
bool CsgSketch::set_start(const StartPoint& start, const Line& line, std::span<const Leaf> leaves,
                          std::span<const FaceSurface> faces, Ends& ends) const {
  const std::uint32_t index = start.leaf - first_leaf_;
  const bool is_named_here = start.surface >= first_face_ && start.surface < end_face_;
  if (index >= leaves.size()) return !is_named_here && !shares_surfaces_;
  const Leaf& leaf = leaves[index];
  if (faces[leaf.first_face + start.face].shared != FaceSurface::not_shared || line.begin != 0) return false;
  const std::size_t place = place_of_[index];
  if (start_on_leaf(leaf, start.leaf, faces, start).side == Side::outside) {
    ends.set_left(place);
    return true;
  }
  return goes_into(place, start.face, line, ends) && ends.set_entered(place);
}

bool CsgSketch::goes_into(std::size_t place, std::uint32_t face, const Line& line, const Ends& ends) const {
  const std::size_t group = place / lane_count;
  if (group < spheres_.size()) return ends.starts_on(spheres_[group], place % lane_count);
  // So plainly that rounding cannot have put the start beside the leaf's box for longer than is told apart
  // there.
  constexpr double flattest = 16 / flattest_start;
  const double speed = is_upper(face) ? -line.direction[face / 2] : line.direction[face / 2];
  return speed * line.inverse_speed > flattest;
}

/// The first t not before this one at which a node may have a value.
double CsgSketch::possible_from(const Ends& ends, std::uint32_t node_index, double t, bool value) const {
  const Node& node = nodes_[node_index];
  const Places turned = turned_for(value);
  std::uint32_t children = node.nodes;
  if (node.all == value) {
    // What is turned and not come into has the value everywhere.
    for (Places places = node.leaves & ~(ends.outside() & turned); places != 0;) {
      const std::uint32_t place = take_bit(places);
      t = (turned & bit_of(place)) != 0 ? ends.outside_from(place, t) : ends.inside_from(place, t);
    }
    while (children != 0) t = possible_from(ends, take_bit(children), t, value);
    return t;
  }
  double first = infinity;
  for (Places places = node.leaves & (~ends.outside() | turned); places != 0;) {
    const std::uint32_t place = take_bit(places);
    const bool is_turned = (turned & bit_of(place)) != 0;
    first = std::min(first, is_turned ? ends.outside_from(place, t) : ends.inside_from(place, t));
  }
  while (children != 0) first = std::min(first, possible_from(ends, take_bit(children), t, value));
  return first;
}

/// Whether a node is true where those leaves are.
bool CsgSketch::holds(Places values, std::uint32_t node_index) const {
  const Node& node = nodes_[node_index];
  std::uint32_t children = node.nodes;
  if (node.all) {
    if ((values & node.leaves) != node.leaves) return false;
    while (children != 0) {
      if (!holds(values, take_bit(children))) return false;
    }
    return true;
  }
  if ((values & node.leaves) != 0) return true;
  while (children != 0) {
    if (holds(values, take_bit(children))) return true;
  }
  return false;
}

/// Whether all leaves but one are certain between two t, and the root hangs on that one.
bool CsgSketch::hangs_on(std::size_t place, const Ends& ends, double from, double to) const {
  Places inside = 0;
  Places outside = 0;
  for (std::size_t group = 0; group < spheres_.size() + boxes_.size(); ++group) {
    inside |= ends.inside(group, from, to);
    outside |= ends.outside(group, from, to);
  }
  const Places one = bit_of(place);
  if (((inside | outside | one) & used_) != used_) return false;
  const Places values = (inside & ~complemented_) | (outside & complemented_);
  return !holds(values & ~one, 0) && holds(values | one, 0);
}

}  // namespace crt::core
