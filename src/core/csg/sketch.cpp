#include "core/csg/sketch.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <optional>

#include "core/csg/evaluate.hpp"
#include "core/csg/program.hpp"
#include "core/csg/sketch_ends.hpp"
#include "core/math/vector.hpp"

namespace crt::core {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Of a box.
constexpr bool is_upper(std::uint32_t face) {
  return face % 2 == 1;
}

/// The index of the last bit that is set, which is taken away; there must be one.
std::uint32_t take_bit(std::uint32_t& bits) {
  const auto index = static_cast<std::uint32_t>(std::countr_zero(bits));
  bits &= bits - 1;
  return index;
}

}  // namespace

bool CsgSketch::Spheres::set_from(std::size_t first_lane, const Leaf& leaf) {
  const Surface surface = leaf.shape->surface(0);
  const std::optional<Vec3> place = leaf.placement->exactly_to_world(surface.position);
  if (surface.kind != SurfaceKind::sphere || !place || !has_fair_size(surface.sizes[0])) return false;
  for (std::size_t lane = first_lane; lane < lane_count; ++lane) {
    for (std::size_t axis = 0; axis < 3; ++axis) center[axis][lane] = (*place)[static_cast<int>(axis)];
    radius[lane] = surface.sizes[0];
  }
  return true;
}

bool CsgSketch::Boxes::set_from(std::size_t first_lane, const Leaf& leaf) {
  // Of all shapes only the box has six faces, two across each axis.
  if (leaf.face_count != 6) return false;
  for (std::uint32_t face = 0; face < leaf.face_count; ++face) {
    const std::optional<Vec3> place = leaf.placement->exactly_to_world(leaf.shape->surface(face).position);
    if (!place) return false;
    const std::size_t axis = face / 2;
    for (std::size_t lane = first_lane; lane < lane_count; ++lane) {
      (is_upper(face) ? upper : lower)[axis][lane] = (*place)[static_cast<int>(axis)];
    }
  }
  return true;
}

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
    if (place % lane_count == 0) spheres_.emplace_back();
    if (!spheres_.back().set_from(place % lane_count, leaves[i])) return false;
    put(i, leaves[i], place++);
  }
  place = spheres_.size() * lane_count;
  for (const std::uint32_t i : boxes) {
    if (place == most_places) return false;
    if (place % lane_count == 0) boxes_.emplace_back();
    if (!boxes_.back().set_from(place % lane_count, leaves[i])) return false;
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
  for (Places places = used_ & ~ends.outside(); places != 0;) {
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
  const double speed = line.direction[face / 2];
  return is_upper(face) ? speed < 0 : speed > 0;
}

/// The first t not before this one at which a node may have a value.
double CsgSketch::possible_from(const Ends& ends, std::uint32_t node_index, double t, bool value) const {
  const Node& node = nodes_[node_index];
  const Places turned = turned_for(value);
  const Places open = node.leaves & ~ends.outside();
  std::uint32_t children = node.nodes;
  const auto leaf_from = [&](std::uint32_t place) {
    return (turned & bit_of(place)) != 0 ? ends.outside_from(place, t) : ends.inside_from(place, t);
  };
  // What is turned and not come into has the value everywhere, what is not turned nowhere.
  if (node.all == value) {
    if ((node.leaves & ends.outside() & ~turned) != 0) return infinity;
    for (Places places = open; places != 0;) t = leaf_from(take_bit(places));
    while (children != 0) t = possible_from(ends, take_bit(children), t, value);
    return t;
  }
  if ((node.leaves & ends.outside() & turned) != 0) return t;
  double first = infinity;
  for (Places places = open; places != 0;) first = std::min(first, leaf_from(take_bit(places)));
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
  const Places one = bit_of(place);
  Places inside = 0;
  Places outside = ends.outside();
  for (std::size_t group = 0; group < spheres_.size() + boxes_.size(); ++group) {
    const Places open = used_ & ~(outside | one) & places_of(group);
    if (open == 0) continue;
    inside |= ends.inside(group, from, to);
    outside |= ends.outside(group, from, to);
    if (((inside | outside) & open) != open) return false;
  }
  const Places values = (inside & ~complemented_) | (outside & complemented_);
  return !holds(values & ~one, 0) && holds(values | one, 0);
}

}  // namespace crt::core
