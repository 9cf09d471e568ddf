#include "core/csg/interval_filter.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <optional>

#include "core/csg/evaluate.hpp"
#include "core/csg/leaf_intervals.hpp"
#include "core/csg/program.hpp"
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

/// A leaf in the world; none if it is no sphere, or not where doubles tell exactly.
std::optional<IntervalFilter::Sphere> sphere_of(const Leaf& leaf) {
  if (shape_as<SphereShape>(leaf.shape->typed()) == nullptr) return {};
  const Surface surface = leaf.shape->surface(0);
  const std::optional<Vec3> place = leaf.placement->exactly_to_world(surface.position);
  if (!place || !has_fair_size(surface.sizes[0])) return {};
  return IntervalFilter::Sphere{*place, surface.sizes[0]};
}

bool is_box(const Leaf& leaf) {
  return shape_as<BoxShape>(leaf.shape->typed()) != nullptr;
}

/// The same of a box, whose faces are two across each axis.
std::optional<IntervalFilter::Box> box_of(const Leaf& leaf) {
  IntervalFilter::Box box{};
  for (std::uint32_t face = 0; face < leaf.face_count; ++face) {
    const std::optional<Vec3> place =
        leaf.placement->exactly_to_world(leaf.shape->surface(face).position);
    if (!place) return {};
    const auto axis = static_cast<int>(face / 2);
    (is_upper(face) ? box.upper : box.lower)[axis] = (*place)[axis];
  }
  return box;
}

}  // namespace

IntervalFilter::IntervalFilter(const CsgProgram& program, std::span<const Leaf> leaves,
                               std::span<const FaceSurface> faces) {
  if (leaves.size() > most_places || program.nodes.size() > most_places) return;
  IntervalFilter filter;
  filter.first_leaf_ = program.first_leaf;
  filter.first_face_ = leaves.front().first_face;
  filter.end_face_ = leaves.back().first_face + leaves.back().face_count;
  if (!filter.place_leaves(leaves)) return;
  filter.place_nodes(program);
  for (std::uint32_t face = filter.first_face_; face < filter.end_face_; ++face) {
    if (faces[face].surface < filter.first_face_) filter.shares_surfaces_ = true;
  }
  *this = std::move(filter);
}

bool IntervalFilter::place_leaves(std::span<const Leaf> leaves) {
  for (const bool boxes : {false, true}) {
    for (std::uint32_t i = 0; i < leaves.size(); ++i) {
      if (is_box(leaves[i]) != boxes) continue;
      const std::optional<Sphere> sphere = boxes ? std::nullopt : sphere_of(leaves[i]);
      const std::optional<Box> box = boxes ? box_of(leaves[i]) : std::nullopt;
      if (!sphere && !box) return false;
      put(i, leaves[i], spheres_.size() + boxes_.size());
      if (sphere) spheres_.push_back(*sphere);
      if (box) boxes_.push_back(*box);
    }
  }
  return true;
}

void IntervalFilter::put(std::uint32_t index, const Leaf& leaf, std::size_t place) {
  place_of_[index] = static_cast<std::uint8_t>(place);
  leaf_at_[place] = static_cast<std::uint8_t>(index);
  used_ |= bit_of(place);
  if (leaf.complemented) complemented_ |= bit_of(place);
}

void IntervalFilter::place_nodes(const CsgProgram& program) {
  nodes_.resize(program.nodes.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    nodes_[i].all = program.nodes[i].needed > 1;
    if (i > 0) nodes_[program.nodes[i].parent].nodes |= bit_of(i);
  }
  for (std::size_t i = 0; i < program.leaf_count(); ++i) {
    nodes_[program.leaf_parents[i]].leaves |= bit_of(place_of_[i]);
  }
}

std::size_t IntervalFilter::bytes() const {
  return spheres_.capacity() * sizeof(Sphere) + boxes_.capacity() * sizeof(Box) +
         nodes_.capacity() * sizeof(Node);
}

const IntervalFilter::Sphere* IntervalFilter::sphere(std::uint32_t leaf) const {
  const std::size_t place = place_of_[leaf];
  return place < spheres_.size() ? &spheres_[place] : nullptr;
}

const IntervalFilter::Box* IntervalFilter::box(std::uint32_t leaf) const {
  const std::size_t place = place_of_[leaf];
  return place < spheres_.size() ? nullptr : &boxes_[place - spheres_.size()];
}

template <class Real>
BoundaryChanges<Real> IntervalFilter::first_changes(const IntervalFilterRays<Real>& rays,
                                                    std::span<const Leaf> leaves,
                                                    std::span<const FaceSurface> faces) const {
  using Mask = MaskOf<Real>;
  BoundaryChanges<Real> changes;
  Ends<Real> ends(rays.lines, rays.limits, lanes_of_mask<Real>(rays.asked));
  Mask asked = ends.asked();
  for (std::size_t i = 0; i < spheres_.size(); ++i) ends.set(i, spheres_[i]);
  for (std::size_t i = 0; i < boxes_.size(); ++i) ends.set(spheres_.size() + i, boxes_[i]);
  for (std::uint32_t starting = rays.on_surface & rays.asked; starting != 0;) {
    const std::uint32_t lane = take_bit(starting);
    if (!set_start(rays.starts[lane], lane, leaves, faces, ends)) {
      asked = without(asked, lanes_of_mask<Real>(bit_of(lane)));
    }
  }

  const Real& begin = rays.lines.begin;
  const Real from = possible_from(ends, 0, begin, true);
  const Mask may_be_inside = both(asked, from == begin);
  if (any(may_be_inside))
    advance(ends, false, possible_from(ends, 0, begin, false), may_be_inside, changes);
  const Mask outside = without(asked, may_be_inside);
  if (any(outside)) advance(ends, true, from, outside, changes);
  return changes;
}

/// Goes from where the root may have a value to where it has it, of those rays that are going.
template <class Real>
void IntervalFilter::advance(const Ends<Real>& ends, bool value, Real from, MaskOf<Real> going,
                             BoundaryChanges<Real>& changes) const {
  while (true) {
    const auto beyond = without(going, from <= ends.limits());
    changes.none = either(changes.none, beyond);
    going = without(going, beyond);
    if (!any(going)) return;
    const Real next = possible_from(ends, 0, from, value);
    const auto there = both(going, next == from);
    if (any(there)) set_change(ends, value, from, there, changes);
    going = without(going, there);
    from = next;
  }
}

/// The changes at the ends of leaves that begin at `from`, where there is just one and it is
/// certain.
template <class Real>
void IntervalFilter::set_change(const Ends<Real>& ends, bool value, const Real& from,
                                MaskOf<Real> rays, BoundaryChanges<Real>& changes) const {
  rays = both(rays, from > ends.lines().certain_from);
  const Places turned = turned_for(value);
  for (Places places = used_ & ~ends.outside(); places != 0 && any(rays);) {
    const std::uint32_t place = take_bit(places);
    const auto& of_leaf = ends[place];
    const bool leaving = (turned & bit_of(place)) != 0;
    const auto here = both(rays, (leaving ? of_leaf.leave_from : of_leaf.enter_from) == from);
    if (!any(here)) continue;
    rays = without(rays, here);
    const Real to = leaving ? of_leaf.leave_to : of_leaf.enter_to;
    // Next to grazing it, the leaf may not be met at all.
    const auto is_isolated = leaving ? of_leaf.enter_to < from : of_leaf.leave_from > to;
    const auto sure =
        both(both(here, to < ends.limits()), both(is_isolated, depends_on(place, ends, from, to)));
    changes.one = either(changes.one, sure);
    if (value) changes.into_object = either(changes.into_object, sure);
    if (!leaving) changes.into_leaf = either(changes.into_leaf, sure);
    changes.leaf = sure ? broadcast<Real>(leaf_at_[place]) : changes.leaf;
    changes.from = sure ? from : changes.from;
    changes.to = sure ? to : changes.to;
  }
}

/// Of the surface at the start it is known otherwise where the ray meets it; false if not by all
/// that is told here.
template <class Real>
bool IntervalFilter::set_start(const StartPoint& start, std::size_t lane,
                               std::span<const Leaf> leaves, std::span<const FaceSurface> faces,
                               Ends<Real>& ends) const {
  const std::uint32_t index = start.leaf - first_leaf_;
  const bool is_named_here = start.surface >= first_face_ && start.surface < end_face_;
  if (index >= leaves.size()) return !is_named_here && !shares_surfaces_;
  const Leaf& leaf = leaves[index];
  const bool is_shared = faces[leaf.first_face + start.face].shared != FaceSurface::not_shared;
  if (is_shared || !ends.starts_at_0(lane)) return false;
  const std::size_t place = place_of_[index];
  if (start_on_leaf(leaf, start.leaf, faces, start).side == Side::outside) {
    ends.set_left(place, lane);
    return true;
  }
  return goes_into(place, start.face, lane, ends) && ends.set_entered(place, lane);
}

template <class Real>
bool IntervalFilter::goes_into(std::size_t place, std::uint32_t face, std::size_t lane,
                               const Ends<Real>& ends) const {
  if (place < spheres_.size()) return ends.starts_on(spheres_[place], lane);
  return ends.goes_into_box(face / 2, is_upper(face), lane);
}

/// The first t not before this one at which a node may have a value.
template <class Real>
Real IntervalFilter::possible_from(const Ends<Real>& ends, std::uint32_t node_index, Real t,
                                   bool value) const {
  const Node& node = nodes_[node_index];
  const Places turned = turned_for(value);
  const Places open = node.leaves & ~ends.outside();
  std::uint32_t children = node.nodes;
  const auto leaf_from = [&](std::uint32_t place) {
    return (turned & bit_of(place)) != 0 ? ends[place].outside_from(t) : ends[place].inside_from(t);
  };
  // What is turned and not come into has the value everywhere, what is not turned nowhere.
  if (node.all == value) {
    if ((node.leaves & ends.outside() & ~turned) != 0) return broadcast<Real>(infinity);
    for (Places places = open; places != 0;) t = leaf_from(take_bit(places));
    while (children != 0) t = possible_from(ends, take_bit(children), t, value);
    return t;
  }
  if ((node.leaves & ends.outside() & turned) != 0) return t;
  Real first = broadcast<Real>(infinity);
  for (Places places = open; places != 0;) first = min(first, leaf_from(take_bit(places)));
  while (children != 0) first = min(first, possible_from(ends, take_bit(children), t, value));
  return first;
}

/// Whether leaves are true, of those in `mixed` by ray; of the others for all of them.
template <class Real>
struct IntervalFilter::Values {
  Places all = 0;
  Places mixed = 0;
  std::array<MaskOf<Real>, most_places> by_ray;
};

/// Where a node is true.
template <class Real>
MaskOf<Real> IntervalFilter::holds(const Values<Real>& values, std::uint32_t node_index) const {
  using Mask = MaskOf<Real>;
  const Node& node = nodes_[node_index];
  const Mask nowhere{};
  const Mask everywhere = lanes_of_mask<Real>(~std::uint32_t{0});
  std::uint32_t children = node.nodes;
  Places mixed = node.leaves & values.mixed;
  const Places fixed = node.leaves & ~values.mixed;
  if (node.all) {
    Mask result = (fixed & ~values.all) == 0 ? everywhere : nowhere;
    while (mixed != 0 && any(result)) result = both(result, values.by_ray[take_bit(mixed)]);
    while (children != 0 && any(result)) result = both(result, holds(values, take_bit(children)));
    return result;
  }
  if ((fixed & values.all) != 0) return everywhere;
  Mask result = nowhere;
  while (mixed != 0) result = either(result, values.by_ray[take_bit(mixed)]);
  while (children != 0) result = either(result, holds(values, take_bit(children)));
  return result;
}

/// Whether all leaves but one are certain between two t, and the root hangs on that one.
template <class Real>
MaskOf<Real> IntervalFilter::depends_on(std::size_t place, const Ends<Real>& ends, const Real& from,
                                        const Real& to) const {
  using Mask = MaskOf<Real>;
  Values<Real> values;
  values.all = ends.outside() & complemented_;
  values.mixed = used_ & ~(ends.outside() | bit_of(place));
  Mask certain = lanes_of_mask<Real>(~std::uint32_t{0});
  for (Places others = values.mixed; others != 0;) {
    const std::uint32_t other = take_bit(others);
    const Mask inside = ends[other].is_inside(from, to);
    const Mask outside = ends[other].is_outside(from, to);
    certain = both(certain, either(inside, outside));
    values.by_ray[other] = (complemented_ & bit_of(other)) != 0 ? outside : inside;
  }
  const Mask without_it = holds(values, 0);
  values.all |= bit_of(place);
  return both(certain, without(holds(values, 0), without_it));
}

template BoundaryChanges<double> IntervalFilter::first_changes(const IntervalFilterRays<double>&,
                                                               std::span<const Leaf>,
                                                               std::span<const FaceSurface>) const;
template BoundaryChanges<Lanes> IntervalFilter::first_changes(const IntervalFilterRays<Lanes>&,
                                                              std::span<const Leaf>,
                                                              std::span<const FaceSurface>) const;

}  // namespace crt::core
