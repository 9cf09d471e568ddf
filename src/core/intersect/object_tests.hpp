// The rays of a packet are tested against one object after the other: filter, solve, commit.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <new>
#include <span>
#include <utility>
#include <vector>

#include "core/intersect/filter_rays.hpp"
#include "core/intersect/first_crossing.hpp"
#include "core/intersect/queries.hpp"

namespace crt::core {

inline const BoundaryTransitions<double>& lane_of(const BoundaryTransitions<double>& change,
                                                  std::size_t /*lane*/) {
  return change;
}

/// An ObjectTests tests the rays of a packet against objects. Each ray finds the same in any
/// packet.
template <class Real, class Asked>
class ObjectTests {
 public:
  using Packet = RayPacketOf<Real>;
  static constexpr bool any_will_do = Asked::any_will_do;
  /// To find the nearest crossing, objects are to come from near to far.
  static constexpr bool from_near = !any_will_do;

  ObjectTests(const Accelerator& accelerator, Packet& packet, RayMask active, const Asked& asked,
              RayWorkspace& work)
      : accelerator_(accelerator),
        packet_(packet),
        filter_(packet),
        active_(active),
        asked_(asked),
        work_(work) {
    work.csg.steps.begin_ray();
  }

  /// Returns the rays that have not found all they ask for.
  RayMask active() const { return active_; }

  /// Tests some rays against an object. Returns the rays whose limits it changed.
  RayMask test(const BoundingProxy& proxy, RayMask rays) {
    changed_ = 0;
    if ((proxy.passed_by & asked_.kind) != 0) [[unlikely]]
      return 0;
    step(rays);
    rays &= ~filter_.left(proxy);
    if (rays == 0) return 0;
    if constexpr (Asked::gathers) {
      if (asked_.is_gathered(proxy.object)) return gather(proxy, rays);
    }
    RayMask pending = proxy.solid == nullptr ? rays : test_solid(proxy, rays);
    if (pending == 0) return changed_;  // what follows looks farther away in memory
    if (const IntervalFilter* filter = accelerator_.filter(proxy.object)) {
      Packet::for_each_group(std::exchange(pending, 0), [&](std::size_t group, RayMask lanes) {
        pending |= test_transitions(proxy.object, *filter, group, lanes) << (group * group_size);
      });
    }
    for_each_ray(pending, [&](std::size_t ray) {
      ask(ray, [&](auto& query) { query.test(proxy.object); });
    });
    return changed_;
  }

  /// Lets an object that rays surely meet bound what else matters to them.
  void limit_by(const BoundingProxy& proxy) {
    if ((proxy.passed_by & asked_.kind) != 0) [[unlikely]]
      return;
    step(active_);
    const RayMask rays = active_ & ~filter_.left(proxy);
    typename FilterRays<Real>::Parts parts;
    const RayMask accepted =
        filter_.decide(proxy, rays, filter_.starts_on(proxy, rays), true, parts).accepted;
    Packet::for_each_group(accepted, [&](std::size_t group, RayMask lanes) {
      // A hit there would have this reach.
      const FilterLine<Real>& lines = packet_.groups[group];
      const Enclosure<Real>& part = parts[group];
      const auto enters = EnclosedCrossing<Real>{part.enter_from, part.enter_to}.counts(lines);
      const Real last = select(enters, part.enter_to, part.leave_to);
      const Real reach = last + coincidence_tolerance(plain_ray(lines), last, Real{});
      Real& limits = packet_.limits[group];
      limits = select(lanes_of_mask<Real>(lanes) && reach < limits, reach, limits);
      active_ &= ~((lanes & mask_of(limits <= lines.begin)) << (group * group_size));
    });
  }

 private:
  static constexpr std::size_t group_size = Packet::group_size;

  /// A GroupCrossing has memory for what a group crosses, which is written where it stays.
  union GroupCrossing {
    GroupCrossing() {}  // NOLINT(modernize-use-equals-default): that would be deleted
    FirstCrossing<Real> first;
  };

  void count_tests(RayMask rays) {
    work_.intersection_tests += static_cast<unsigned>(std::popcount(rays));
  }

  /// Ends rays that have found what they ask for.
  void settle(RayMask rays) {
    changed_ |= rays;
    active_ &= ~rays;
    Packet::for_each_group(rays, [&](std::size_t group, RayMask lanes) {
      Real& limits = packet_.limits[group];
      limits = select(lanes_of_mask<Real>(lanes), broadcast<Real>(-infinity), limits);
    });
  }

  /// Calls use(query) with the exact query of one ray, and takes what that changes.
  template <class Use>
  void ask(std::size_t number, const Use& use) {
    const double before = packet_.limit(number);
    const WorldRay& ray = packet_.source.ray(number);
    auto query = asked_.query(accelerator_, ray, number, work_);
    query.set_limit(before);
    begin_steps();
    use(query);
    add_steps(number);
    if (query.limit() == before) return;
    packet_.set_limit(number, query.limit());
    const RayMask bit = RayMask{1} << number;
    changed_ |= bit;
    if (query.limit() <= ray.t_min) active_ &= ~bit;
  }

  /// Tests an object by its solid, and by the spans of a leaf that it may be. Returns the rays that
  /// this leaves open.
  RayMask test_solid(const BoundingProxy& proxy, RayMask rays) {
    const SolidStarts starts = filter_.starts_on(proxy, rays);
    typename FilterRays<Real>::Parts parts;
    if (!any_will_do && proxy.has_quick_spans) {
      return test_starting(proxy, rays & starts.unknown) |
             test_leaf(proxy, rays & ~starts.left & ~starts.unknown, starts, nullptr);
    }
    const Decision<RayMask> decision = filter_.decide(proxy, rays, starts, any_will_do, parts);
    RayMask pending = rays & ~decision.rejected;
    if constexpr (any_will_do) {
      pending &= ~decision.accepted;
      settle(decision.accepted);
    }
    if (pending == 0 || proxy.leaf == nullptr) return pending;
    const RayMask starting = pending & starts.unknown;
    return test_starting(proxy, starting) | test_leaf(proxy, pending & ~starting, starts, &parts);
  }

  /// Returns which rays that start on a leaf may meet it again.
  RayMask test_starting(const BoundingProxy& proxy, RayMask rays) const {
    return rays == 0 ? 0 : rays & ~filter_.left_again(proxy, rays);
  }

  /// Tests an object that is a leaf by the leaf's spans. Returns the rays for which these do not
  /// suffice. `parts` is null for a leaf with quick spans.
  RayMask test_leaf(const BoundingProxy& proxy, RayMask rays, const SolidStarts& starts,
                    const typename FilterRays<Real>::Parts* parts) {
    // All are found before any is taken, so that none waits for what is made of another.
    std::array<GroupCrossing, Packet::group_count> crossings;
    Packet::for_each_group(rays, [&](std::size_t group, RayMask lanes) {
      new (&crossings[group].first) FirstCrossing<Real>(filter_.first_crossing(
          proxy, group, lanes, starts, parts == nullptr ? nullptr : &(*parts)[group]));
    });
    RayMask pending = 0;
    Packet::for_each_group(rays, [&](std::size_t group, RayMask lanes) {
      const FirstCrossing<Real>& first = crossings[group].first;
      const RayMask known = lanes & ~mask_of(first.unknown);
      pending |= (lanes & ~known) << (group * group_size);
      count_tests(known);
      const RayMask found = known & mask_of(first.found && first.t <= packet_.limits[group]);
      if (found == 0) return;
      take(proxy.object, group, first, found,
           [&](std::size_t lane, RayHit& hit) { write_first(proxy, lane_of(first, lane), hit); });
    });
    return pending;
  }

  /// Takes crossings with an object before the limits; write(lane, hit) writes one where it stays.
  template <class Write>
  void take(std::uint32_t object, std::size_t group, const FirstCrossing<Real>& first,
            RayMask found, const Write& write) {
    const FilterLine<Real>& lines = packet_.groups[group];
    const std::size_t first_ray = group * group_size;
    if constexpr (any_will_do) {
      const RayMask surely = found & mask_of(first.t < lines.certain_to);
      settle(surely << first_ray);
      for_each_ray(found & ~surely, [&](std::size_t lane) {
        RayHit hit;
        write(lane, hit);
        ask(first_ray + lane, [&](Any& query) { query.take(hit); });
      });
    } else {
      const Real reach = first.t + coincidence_tolerance(plain_ray(lines), first.t, first.error);
      commit(object, group, first.t, reach, found, write);
    }
  }

  /// Keeps crossings with an object that are the nearest so far. Others may coincide with them up
  /// to `reach`.
  template <class Write>
  void commit(std::uint32_t object, std::size_t group, const Real& t, const Real& reach,
              RayMask found, const Write& write) {
    Real& limits = packet_.limits[group];
    const std::size_t first_ray = group * group_size;
    RayMask best = 0;
    const RayMask surely = found & mask_of(t < packet_.groups[group].certain_to);
    const RayMask in_time = found & mask_of(t < packet_.source.end(group));
    for_each_ray(in_time, [&](std::size_t lane) {
      if ((surely >> lane & 1u) == 0) {
        RayHit hit;
        write(lane, hit);
        if (accelerator_.is_at_end(packet_.source.ray(first_ray + lane), hit, work_)) return;
      }
      const bool is_best =
          Nearest::commit(asked_.hits[first_ray + lane], lane_of(t, lane), 0, object,
                          lane_of(reach, lane), [&](RayHit& hit) { write(lane, hit); });
      best |= mask_of(is_best) << lane;
    });
    // These limits are after the rays' starts, so that the rays go on.
    const auto nearer = lanes_of_mask<Real>(best) && reach < limits;
    limits = select(nearer, reach, limits);
    changed_ |= mask_of(nearer) << first_ray;
  }

  /// Gathers all crossings with an object, of which not all is opaque.
  RayMask gather(const BoundingProxy& proxy, RayMask rays) {
    RayMask pending = rays;
    if (proxy.solid != nullptr) {
      const SolidStarts starts = filter_.starts_on(proxy, rays);
      typename FilterRays<Real>::Parts parts;
      pending &= ~filter_.decide(proxy, rays, starts, false, parts).rejected;
      if (proxy.leaf != nullptr && proxy.leaf->shape->is_convex()) {
        Packet::for_each_group(pending & ~starts.some, [&](std::size_t group, RayMask lanes) {
          pending &= ~(gather_ends(proxy, group, lanes) << (group * group_size));
        });
      }
    }
    for_each_ray(pending, [&](std::size_t number) {
      const WorldRay& ray = packet_.source.ray(number);
      All query(accelerator_, ray, work_, &asked_.opacity, asked_.found[number]);
      begin_steps();
      query.test(proxy.object);
      add_steps(number);
      if (query.stopped) settle(RayMask{1} << number);
    });
    return changed_;
  }

  /// Gathers the crossings with a convex leaf of lanes that do not start on it. Returns the lanes
  /// for which its spans suffice.
  RayMask gather_ends(const BoundingProxy& proxy, std::size_t group, RayMask lanes) {
    const FilterLine<Real>& lines = packet_.groups[group];
    const Real& limits = packet_.limits[group];
    const auto asked = lanes_of_mask<Real>(lanes);
    ShapeSpan<Real> span;
    find_span(*proxy.leaf, lines, {.enter = asked, .leave = asked}, nullptr, span);
    const auto is_after = [&](const SpanEnd<Real>& end) {
      return after_start(lines, end.t, end.error);
    };
    const auto is_clear = [&](const SpanEnd<Real>& end) {
      const auto start = is_after(end);
      return span.misses || (end.known && !start.unknown &&
                             (!start.surely || end.t < lines.certain_to || end.t > limits));
    };
    const RayMask done = lanes & mask_of(is_clear(span.enter) && is_clear(span.leave));
    count_tests(done);
    for (const SpanEnd<Real>* end : {&span.enter, &span.leave}) {
      const auto counts = !span.misses && is_after(*end).surely && end->t <= limits;
      FirstCrossing<Real> crossing{.found = counts,
                                   .t = end->t,
                                   .error = end->error,
                                   .face = end->face,
                                   .leave_root = span.leave_root};
      if (end == &span.enter) crossing.entering = asked;
      for_each_ray(done & mask_of(counts), [&](std::size_t lane) {
        write_first(proxy, lane_of(crossing, lane),
                    asked_.found[group * group_size + lane].emplace_back());
      });
    }
    return done;
  }

  /// Tests a CSG object by its interval filter. Returns the lanes that this leaves open.
  RayMask test_transitions(std::uint32_t object, const IntervalFilter& filter, std::size_t group,
                           RayMask asked) {
    const CompiledScene& scene = accelerator_.compiled();
    const SceneObject& solid = scene.objects[object];
    const FilterLine<Real>& lines = packet_.groups[group];
    const auto changes = filter.first_transitions<Real>(
        {.lines = lines,
         .limits = packet_.limits[group],
         .asked = asked,
         .on_surface = Packet::lanes(packet_.starts.on_surface, group),
         .starts = packet_.source.group_starts(group)},
        scene.csg_object(solid), work_.near_leaves, work_.csg.steps);
    RayMask to_come = asked & mask_of(changes.one);
    RayMask pending = asked & ~mask_of(changes.one || changes.none);
    if constexpr (any_will_do) {
      const RayMask surely = to_come & mask_of(changes.to < lines.certain_to);
      settle(surely << (group * group_size));
      to_come &= ~surely;
    }
    while (to_come != 0) {
      const std::size_t first = first_ray(to_come);
      const RayMask into_leaf = mask_of(changes.into_leaf);
      const RayMask same_way = (into_leaf >> first & 1u) != 0 ? into_leaf : ~into_leaf;
      const RayMask same_leaf =
          to_come & same_way &
          mask_of(changes.leaf == broadcast<Real>(lane_of(changes.leaf, first)));
      to_come &= ~same_leaf;
      pending |= take_transitions(object, group, same_leaf, changes);
    }
    count_tests(asked & ~pending);
    return pending;
  }

  /// Takes changes of one leaf, all into it or all out of it. Returns where none has been found.
  RayMask take_transitions(std::uint32_t object, std::size_t group, RayMask same_leaf,
                           const BoundaryTransitions<Real>& changes) {
    const CompiledScene& scene = accelerator_.compiled();
    const FilterLine<Real>& lines = packet_.groups[group];
    const std::size_t first = first_ray(same_leaf);
    const auto number = static_cast<std::uint32_t>(lane_of(changes.leaf, first));
    const std::uint32_t index = scene.objects[object].first_leaf + number;
    const Leaf& leaf = scene.leaves[index];
    RayMask resolved = 0;
    if (!leaf.exact) {
      const bool into_leaf = lane_of(changes.into_leaf, first);
      const auto wanted = lanes_of_mask<Real>(same_leaf);
      ShapeSpan<Real> ends;
      find_span(leaf, lines,
                {.enter = into_leaf ? wanted : MaskOf<Real>{},
                 .leave = into_leaf ? MaskOf<Real>{} : wanted},
                nullptr, ends);
      const SpanEnd<Real>& end = into_leaf ? ends.enter : ends.leave;
      const RayMask starting = Packet::lanes(rays_with(packet_.starts.leaves, index), group);
      const auto span = RaySlabs::spans(lines, leaf.bounds, same_leaf);
      const auto in_span = end.t >= span.enter && end.t <= span.leave;
      resolved = same_leaf & ~starting & mask_of(end.known && in_span);
      work_.csg.events += static_cast<unsigned>(std::popcount(resolved));
      const FirstCrossing<Real> crossing{.t = end.t, .error = end.error};
      take(object, group, crossing, resolved, [&](std::size_t lane, RayHit& hit) {
        const auto face = static_cast<std::uint32_t>(lane_of(end.face, lane));
        hit = {.t = lane_of(end.t, lane),
               .error = lane_of(end.error, lane),
               .object = object,
               .leaf = index,
               .face = face,
               .surface = leaf.surface_of(face, scene.face_surfaces).surface,
               .root = into_leaf ? std::uint8_t{0} : ends.leave_root,
               .entering = lane_of(changes.into_object, lane)};
      });
    }
    RayMask pending = 0;
    for_each_ray(same_leaf & ~resolved, [&](std::size_t lane) {
      ask(group * group_size + lane, [&](auto& query) {
        if (!query.test_transition(object, lane_of(changes, lane))) pending |= RayMask{1} << lane;
      });
    });
    return pending;
  }

  // A single ray counts every step. A packet counts its rays' steps only where there are many.

  /// Counts that some rays come to one object more.
  void step(RayMask rays) {
    RaySteps& steps = work_.csg.steps;
    if constexpr (Packet::is_single) {
      steps.step();
    } else {
      if (++visits_ < steps_per_look) [[likely]]
        return;
      std::uint64_t most = 0;
      for_each_ray(rays, [&](std::size_t ray) { most = std::max(most, ++steps_[ray]); });
      if (visits_ % steps_per_look == 0) steps.look(most);
    }
  }
  /// Begins to count the steps of one ray within an object.
  void begin_steps() {
    if constexpr (!Packet::is_single) work_.csg.steps.begin_ray();
  }
  void add_steps(std::size_t ray) {
    if constexpr (!Packet::is_single) {
      const RaySteps& steps = work_.csg.steps;
      if (steps.taken() < steps_per_look) return;
      steps_[ray] += steps.taken();
      steps.look(steps_[ray]);
    }
  }

  const Accelerator& accelerator_;
  Packet& packet_;
  FilterRays<Real> filter_;
  RayMask active_;
  RayMask changed_ = 0;
  const Asked& asked_;
  RayWorkspace& work_;
  std::uint64_t visits_ = 0;
  std::array<std::uint64_t, Packet::size> steps_{};
};

}  // namespace crt::core
