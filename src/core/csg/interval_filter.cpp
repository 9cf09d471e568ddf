#include "core/csg/interval_filter.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "core/csg/evaluate.hpp"
#include "core/csg/near_leaves.hpp"
#include "core/csg/program.hpp"
#include "core/ray/coincidence_tolerance.hpp"

namespace crt::core {

namespace {

/// Returns what encloses a leaf that has no formula.
std::unique_ptr<const PlacedSolid> enclosed(const Leaf& leaf) {
  // The exact tier may find a crossing where the standard one does not.
  return leaf.shape->is_convex() && !leaf.exact ? place_by_crossings(*leaf.shape, *leaf.placement)
                                                : place_box(*leaf.shape, *leaf.placement);
}

}  // namespace

IntervalFilter::IntervalFilter(const CsgProgram& program, std::span<const Leaf> leaves) {
  if (!program.paths.empty()) return;
  std::vector<EnclosedLeaf> enclosed_leaves;
  enclosed_leaves.reserve(leaves.size());
  // What is enclosed vaguely, or at the cost of solving for it, rarely leaves one crossing to be
  // solved. So a filter pays where rays mostly pass such leaves by.
  constexpr std::size_t leaves_a_vague_one = 8;
  std::size_t vague = 0;
  for (const Leaf& leaf : leaves) {
    auto solid = leaf.shape->placed(*leaf.placement);
    if (solid == nullptr || !leaf.shape->is_convex()) ++vague;
    if (vague * leaves_a_vague_one > leaves.size()) return;
    if (solid == nullptr) solid = enclosed(leaf);
    enclosed_leaves.push_back({std::move(solid), leaf.complemented});
  }
  leaves_ = std::move(enclosed_leaves);
}

std::size_t IntervalFilter::bytes() const {
  std::size_t bytes = leaves_.capacity() * sizeof(EnclosedLeaf);
  for (const EnclosedLeaf& leaf : leaves_) bytes += leaf.solid->bytes();
  return bytes;
}

/// A Search finds the first changes of some rays.
template <class Real>
class IntervalFilter::Search {
 public:
  using Mask = MaskOf<Real>;

  Search(const IntervalFilter& filter, const IntervalFilterRays<Real>& rays,
         const CsgObject& object, NearLeavesWorkspace& workspace, const RaySteps& steps)
      : filter_(filter),
        rays_(rays),
        lines_(rays.lines, rays.limits, lanes_of_mask<Real>(rays.asked)),
        near_(filter, object.program, lines_, rays.asked, workspace, steps),
        object_(object),
        steps_(steps) {}

  [[gnu::always_inline]] BoundaryTransitions<Real> find() {
    gather(-least(select(lines_.asked(), -lines_.lines().certain_from, broadcast<Real>(infinity))));
    if (is_too_much()) return changes_;
    Mask asked = lines_.asked();
    for (std::uint32_t starting = rays_.on_surface & rays_.asked; starting != 0;
         starting &= starting - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(starting));
      if (!set_start(rays_.starts[lane], lane)) {
        asked = asked && !(EnclosedLines<Real>::lane_bit(lane));
      }
    }
    const Real& begin = rays_.lines.begin;
    const Real from = root_possible_from(begin, true);
    const Mask may_be_inside = asked && from == begin;
    if (any(may_be_inside)) advance(false, root_possible_from(begin, false), may_be_inside);
    const Mask outside = asked && !may_be_inside;
    if (any(outside)) advance(true, from, outside);
    return changes_;
  }

 private:
  /// Gathers more and more leaves at a time, so that to look at all anew adds up to little.
  void gather(double t) {
    near_.gather(batch_, t);
    batch_ *= 2;
  }
  Real horizon() const { return broadcast<Real>(near_.horizon()); }

  /// Returns a t before which the root surely does not have a value, if it does not before the
  /// given one. It is the first t at which the root may have it, or the horizon.
  Real root_possible_from(const Real& t, bool value) {
    return min(possible_from(near_.node(0), t, value), horizon());
  }

  /// Advances the active rays, from a t before which the root surely does not have a value
  /// to where it has it.
  void advance(bool value, Real t, Mask active) {
    while (true) {
      const Mask beyond = active && !(t <= lines_.limits());
      changes_.none = changes_.none || beyond;
      active = active && !beyond;
      if (!any(active) || is_too_much()) return;
      if (any(active && t >= horizon())) {
        gather(-infinity);
      } else {
        const Real next = root_possible_from(t, value);
        const Mask there = active && next == t;
        if (any(there)) {
          const Mask unseen = set_transition(value, t, there);
          active = (active && !there) || unseen;
          if (any(unseen)) gather(-infinity);
        }
        t = next;
      }
    }
  }

  Real tolerance(const Real& t) const {
    return coincidence_tolerance(plain_ray(lines_.lines()), t, Real{});
  }

  /// Notes the changes at the ends of leaves that begin at `from`, where there is just one and it
  /// is certain. Returns the rays of which that end reaches beyond the horizon.
  Mask set_transition(bool value, const Real& from, Mask rays) {
    Mask unseen{};
    rays = rays && from > lines_.lines().certain_from;
    for (const NearLeaf<Real>& leaf : near_.leaves()) {
      if (!any(rays)) break;
      const Enclosure<Real>& interval = leaf.interval;
      const bool leaving = wants_outside(leaf, value);
      Mask here = rays && (leaving ? interval.leave_from : interval.enter_from) == from;
      if (!any(here)) continue;
      rays = rays && !here;
      const Real to = leaving ? interval.leave_to : interval.enter_to;
      // Ends that are near to this one may be at one place with it.
      const Real near_from = from - tolerance(from);
      const Real near_to = to + tolerance(to);
      const Mask is_seen = near_to < horizon() || near_to >= lines_.limits();
      unseen = unseen || (here && !is_seen);
      here = here && is_seen;
      // A ray that nearly grazes the leaf may not meet it at all.
      const Mask is_isolated = leaving ? interval.enter_to < from : interval.leave_from > to;
      const Mask sure =
          here && near_to < lines_.limits() && is_isolated && depends_on(leaf, near_from, near_to);
      changes_.one = changes_.one || sure;
      if (value) changes_.into_object = changes_.into_object || sure;
      if (!leaving) changes_.into_leaf = changes_.into_leaf || sure;
      changes_.leaf = select(sure, broadcast<Real>(leaf.leaf), changes_.leaf);
      changes_.from = select(sure, from, changes_.from);
      changes_.to = select(sure, to, changes_.to);
    }
    return unseen;
  }

  /// Makes the interval of the leaf that a ray starts on agree with that start, which settles where
  /// the ray meets the surface. Returns false if that does not follow from what is known here.
  bool set_start(const StartPoint& start, std::uint32_t lane) {
    const std::span<const Leaf> leaves = object_.leaves;
    const std::uint32_t index = start.leaf - object_.first_leaf;
    const std::uint32_t end_face = leaves.back().first_face + leaves.back().face_count;
    const bool is_named_here =
        start.surface >= leaves.front().first_face && start.surface < end_face;
    if (index >= leaves.size()) return !is_named_here && !object_.shares_surfaces;
    const Leaf& leaf = leaves[index];
    const bool is_shared =
        leaf.surface_of(start.face, object_.faces).shared != FaceSurface::not_shared;
    if (is_shared || !lines_.starts_at_0(lane)) return false;
    const std::span<NearLeaf<Real>> near = near_.leaves();
    const auto found = std::find_if(near.begin(), near.end(),
                                    [&](const auto& other) { return other.leaf == index; });
    const Mask ray = EnclosedLines<Real>::lane_bit(lane);
    if (start_on_leaf(leaf, start.leaf, object_.faces, start).side == Side::outside) {
      if (found == near.end()) return true;
      // Where the ray grazes the leaf, the bounds on the errors of the leaf's crossings at the
      // start and before it reach so far ahead that others may be at one place with them.
      if (!lines_.is_outside_soon(found->interval, lane)) return false;
      found->interval.set_outside(ray);
      return true;
    }
    if (found == near.end() || !starts_inwards(index, start.face, lane) ||
        !lines_.is_inside_soon(found->interval, lane)) {
      return false;
    }
    found->interval.set_inside_first(ray);
    return true;
  }

  bool starts_inwards(std::uint32_t leaf, std::uint32_t face, std::uint32_t lane) const {
    return lines_.starts_inwards(filter_.solid(leaf), face, lane);
  }

  /// Returns whether a leaf must be outside to make for a value of the root.
  static bool wants_outside(const NearLeaf<Real>& leaf, bool value) {
    return value == leaf.complemented;
  }

  /// Returns the first t not before the given one at which a node may have a value.
  Real possible_from(const NearNode& node, Real t, bool value) {
    const bool needs_all = node.all == value;
    if (node.deciding > 0) return needs_all ? broadcast<Real>(infinity) : t;
    Real first = broadcast<Real>(infinity);
    const auto take = [&](const Real& of_child) {
      if (needs_all) {
        t = of_child;
      } else {
        first = min(first, of_child);
      }
    };
    for (std::uint32_t i = node.first_leaf; i != invalid_index;) {
      const NearLeaf<Real>& leaf = near_.leaves()[i];
      take(wants_outside(leaf, value) ? leaf.interval.outside_from(t)
                                      : leaf.interval.inside_from(t));
      i = leaf.next;
      ++looked_at_;
    }
    for (std::uint32_t i = node.first_node; i != invalid_index; i = near_.node(i).next) {
      take(possible_from(near_.node(i), t, value));
    }
    return needs_all ? t : first;
  }

  /// Returns whether all leaves but one are certain between two t, and the root depends on that
  /// one. On its path to the root all other children must leave the decision to the child on the
  /// path.
  Mask depends_on(const NearLeaf<Real>& open, const Real& from, const Real& to) {
    Mask result = lanes_of_mask<Real>(~std::uint32_t{0});
    for (std::uint32_t i = open.node; i != invalid_index; i = near_.node(i).parent) {
      near_.node(i).is_on_path = true;
      if (near_.node(i).deciding > 0) result = Mask{};
    }
    for (const NearLeaf<Real>& leaf : near_.leaves()) {
      if (&leaf == &open) continue;
      const NearNode& parent = near_.node(leaf.node);
      result = result && (parent.is_on_path ? has_value(leaf, parent.all, from, to)
                                            : leaf.interval.is_inside(from, to) ||
                                                  leaf.interval.is_outside(from, to));
      if (!any(result)) break;
    }
    for (std::uint32_t i = open.node; i != invalid_index; i = near_.node(i).parent) {
      near_.node(i).is_on_path = false;
    }
    std::uint32_t on_path = invalid_index;
    for (std::uint32_t i = open.node; i != invalid_index && any(result); i = near_.node(i).parent) {
      const NearNode& node = near_.node(i);
      for (std::uint32_t k = node.first_node; k != invalid_index; k = near_.node(k).next) {
        if (k != on_path) result = result && has_value(near_.node(k), node.all, from, to);
      }
      on_path = i;
    }
    return result;
  }

  /// Returns whether a leaf that is certain between two t has a value for the node above it.
  static Mask has_value(const NearLeaf<Real>& leaf, bool value, const Real& from, const Real& to) {
    return wants_outside(leaf, value) ? leaf.interval.is_outside(from, to)
                                      : leaf.interval.is_inside(from, to);
  }
  /// Returns whether a node, whose leaves are certain between two t, has a value.
  Mask has_value(const NearNode& node, bool value, const Real& from, const Real& to) {
    const bool needs_all = node.all == value;
    const Mask everywhere = lanes_of_mask<Real>(~std::uint32_t{0});
    if (node.deciding > 0) return needs_all ? Mask{} : everywhere;
    Mask result = needs_all ? everywhere : Mask{};
    const auto take = [&](const Mask& of_child) {
      result = needs_all ? (result && of_child) : result || of_child;
    };
    for (std::uint32_t i = node.first_leaf; i != invalid_index; i = near_.leaves()[i].next) {
      take(has_value(near_.leaves()[i], value, from, to));
    }
    for (std::uint32_t i = node.first_node; i != invalid_index; i = near_.node(i).next) {
      take(has_value(near_.node(i), value, from, to));
    }
    return result;
  }

  /// Returns whether following all crossings would cost less than the search has done already.
  bool is_too_much() {
    constexpr std::uint64_t looks_a_leaf = 32;
    constexpr std::uint64_t free = 1024;
    return looked_at_ > looks_a_leaf * near_.leaves().size() + free ||
           near_.leaves().size() > steps_.most();
  }

  const IntervalFilter& filter_;
  const IntervalFilterRays<Real>& rays_;
  EnclosedLines<Real> lines_;
  NearLeaves<Real> near_;
  const CsgObject& object_;
  const RaySteps& steps_;
  BoundaryTransitions<Real> changes_;
  std::size_t batch_ = 8;
  std::uint64_t looked_at_ = 0;
};

template <class Real>
BoundaryTransitions<Real> IntervalFilter::first_transitions(const IntervalFilterRays<Real>& rays,
                                                            const CsgObject& object,
                                                            NearLeavesWorkspace& workspace,
                                                            const RaySteps& steps) const {
  Search<Real> search(*this, rays, object, workspace, steps);
  return search.find();
}

template BoundaryTransitions<double> IntervalFilter::first_transitions(
    const IntervalFilterRays<double>&, const CsgObject&, NearLeavesWorkspace&,
    const RaySteps&) const;
template BoundaryTransitions<Lanes> IntervalFilter::first_transitions(
    const IntervalFilterRays<Lanes>&, const CsgObject&, NearLeavesWorkspace&,
    const RaySteps&) const;

}  // namespace crt::core
