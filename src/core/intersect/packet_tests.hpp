// A packet's rays against one object after the other: cheap tests for four of them at a time, then
// what else tells crossings side by side, then exact tests for each ray that these leave open.
#pragma once

#include <array>
#include <bit>
#include <limits>
#include <new>
#include <span>
#include <utility>
#include <vector>

#include "core/intersect/all_crossings.hpp"
#include "core/intersect/filter_rays.hpp"
#include "core/intersect/first_crossing.hpp"
#include "core/intersect/nearest_and_any.hpp"
#include "core/intersect/nearest_sphere_hits.hpp"

namespace crt::core {

/// What some rays of a batch ask, and find: the nearest crossing.
struct NearestOfEach {
  static constexpr bool any_will_do = false;
  static constexpr bool gathers = false;

  const Accelerator& accelerator;
  const RayBatch& rays;
  std::span<RayHit, packet_size> hits;
  RayWorkspace& work;
  WorldRay asked{};

  /// In the state that what has been found so far puts it in; but for the limit. The only one at a
  /// time.
  Nearest query(std::size_t ray) {
    asked = rays.ray(ray);
    return {accelerator, asked, work, hits[ray]};
  }
};

/// The same: whether there is any.
struct AnyOfEach {
  static constexpr bool any_will_do = true;
  static constexpr bool gathers = false;

  const Accelerator& accelerator;
  const RayBatch& rays;
  RayWorkspace& work;
  WorldRay asked{};

  Any query(std::size_t ray) {
    asked = rays.ray(ray);
    return {accelerator, asked, work};
  }
};

/// The same: whether there is anything opaque; and else all that there is, by ray.
struct LightOfEach : AnyOfEach {
  static constexpr bool gathers = true;

  const Opacity& opacity;
  std::span<std::vector<RayHit>, packet_size> found;

  bool is_gathered(std::uint32_t object) const { return !opacity.of_objects[object]; }
  All all(std::size_t ray) {
    asked = rays.ray(ray);
    return {accelerator, asked, work, &opacity, found[ray]};
  }
};

/// Tests the rays of a packet against objects.
template <class Answers>
class PacketTests {
 public:
  static constexpr bool any_will_do = Answers::any_will_do;

  PacketTests(RayPacket& packet, RayMask going, Answers& answers)
      : packet_(packet), filter_(packet), going_(going), answers_(answers) {}

  /// The rays that still go.
  RayMask going() const { return going_; }

  /// Returns the rays whose limits it changed.
  RayMask test(const BoundingProxy& proxy, const BoundingProxies& proxies, RayMask rays) {
    changed_ = 0;
    if (++visits_ >= steps_per_look) [[unlikely]]
      count_steps(rays);
    rays &= ~filter_.left(proxy);
    if (rays == 0) return 0;
    const BoxStarts starts = filter_.box_starts(proxy, proxies, rays);
    if constexpr (Answers::gathers) {
      if (answers_.is_gathered(proxy.object)) return gather(proxy, proxies, rays, starts);
    }
    const Decision<RayMask> decision = filter_.decide(proxy, proxies, rays, starts, any_will_do);
    RayMask open = rays & ~decision.rejected;
    if constexpr (any_will_do) {
      open &= ~decision.accepted;
      settle(decision.accepted);
    }
    if (open != 0 && proxies.resolved_leaf(proxy) != nothing) {
      const RayMask resolved = open & filter_.resolved(proxy, proxies, starts);
      open &= ~resolved;
      // All are found before any is taken, so that none waits for what is made of another.
      std::array<GroupCrossing, RayPacket::group_count> crossings;
      RayPacket::for_each_group(resolved, [&](std::size_t group, RayMask asked) {
        new (&crossings[group].first)
            FirstCrossing<Lanes>(filter_.first_crossing(proxy, proxies, group, asked, starts));
      });
      RayPacket::for_each_group(resolved, [&](std::size_t group, RayMask asked) {
        open |= take_resolved(proxy, proxies, group, asked, crossings[group].first)
                << (group * lane_count);
      });
    }
    if (open == 0) return changed_;  // what follows looks farther away in memory
    if (const IntervalFilter* filter = answers_.accelerator.filter(proxy.object)) {
      RayPacket::for_each_group(std::exchange(open, 0), [&](std::size_t group, RayMask asked) {
        open |= test_filter(proxy.object, *filter, group, asked) << (group * lane_count);
      });
    }
    for_each_ray(open, [&](std::size_t ray) {
      ask(ray, [&](auto& query) { query.test_in_full(proxy.object); });
    });
    return changed_;
  }

  /// Takes the spheres that rays cross first, as far as floats tell which. Returns of which rays
  /// that is known.
  RayMask take_nearest_spheres(const NearestSpheres& spheres, const BoundingProxies& proxies) {
    const NearestSphereHits crossings(spheres, proxies, answers_.rays);
    RayPacket::for_each_group(crossings.known(), [&](std::size_t group, RayMask known) {
      const std::size_t first = group * lane_count;
      const Lanes& t = crossings.t(group);
      take_best(
          group, t, crossings.reach(group), known & mask_of(t <= packet_.limits[group]),
          [&](std::size_t lane) { return crossings.object(first + lane); },
          [&](std::size_t lane, RayHit& hit) { crossings.write(first + lane, true, hit); });
    });
    answers_.work.intersection_tests += static_cast<unsigned>(std::popcount(crossings.known()));
    return spheres.missing | crossings.known();
  }

  /// A plane that is met bounds what else matters.
  void limit_by(const BoundingProxy& plane, const BoundingProxies& proxies) {
    std::array<Lanes, RayPacket::group_count> last;
    if (++visits_ >= steps_per_look) [[unlikely]]
      count_steps(going_);
    const RayMask accepted =
        filter_.decide(plane, proxies, going_ & ~filter_.left(plane), any_will_do, last).accepted;
    RayPacket::for_each_group(accepted, [&](std::size_t group, RayMask lanes) {
      // As a hit there would have it.
      const FilterLine<Lanes>& lines = packet_.groups[group];
      const Lanes reach =
          last[group] + coincidence_tolerance(plain_ray(lines), last[group], Lanes{});
      Lanes& limits = packet_.limits[group];
      limits = select(lanes_with(lanes) && reach < limits, reach, limits);
      going_ &= ~((lanes & mask_of(limits <= lines.begin)) << (group * lane_count));
    });
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  /// Room for what a group crosses, which is written where it stays, and nothing before.
  union GroupCrossing {
    GroupCrossing() {}  // NOLINT(modernize-use-equals-default): that would be deleted
    FirstCrossing<Lanes> first;
  };

  /// Those rays have found what they ask for.
  void settle(RayMask rays) {
    changed_ |= rays;
    going_ &= ~rays;
    RayPacket::for_each_group(rays, [&](std::size_t group, RayMask lanes) {
      Lanes& limits = packet_.limits[group];
      limits = select(lanes_with(lanes), lanes_of(-infinity), limits);
    });
  }

  /// use(query) of one ray, and what it changes.
  template <class Use>
  void ask(std::size_t ray, const Use& use) {
    const double before = packet_.limit(ray);
    auto query = answers_.query(ray);
    query.set_limit(before);
    use(query);
    add_steps(ray);
    if (query.limit() == before) return;
    packet_.set_limit(ray, query.limit());
    const RayMask bit = RayMask{1} << ray;
    changed_ |= bit;
    if (query.limit() <= query.ray().t_min) going_ &= ~bit;
  }

  /// Takes the crossings of a group's lanes with an object whose proxy alone tells them. Returns
  /// which lanes it leaves open nevertheless.
  RayMask take_resolved(const BoundingProxy& proxy, const BoundingProxies& proxies,
                        std::size_t group, RayMask asked, const FirstCrossing<Lanes>& first) {
    const RayMask open = asked & mask_of(first.unknown);
    answers_.work.intersection_tests += static_cast<unsigned>(std::popcount(asked & ~open));
    const RayMask found = asked & ~open & mask_of(first.found && first.t <= packet_.limits[group]);
    if (found != 0) {
      take(proxy.object, group, first, found, [&](std::size_t lane, RayHit& hit) {
        write_first(proxy, proxies, lane_of(first, lane), hit);
      });
    }
    return open;
  }

  /// Takes crossings with an object before the limits; write(lane, hit) writes one where it stays.
  template <class Write>
  void take(std::uint32_t object, std::size_t group, const FirstCrossing<Lanes>& first,
            RayMask found, const Write& write) {
    const FilterLine<Lanes>& lines = packet_.groups[group];
    const std::size_t first_ray = group * lane_count;
    if constexpr (any_will_do) {
      const RayMask surely = found & mask_of(first.t < lines.certain_to);
      settle(surely << first_ray);
      for_each_ray(found & ~surely, [&](std::size_t lane) {
        RayHit hit;
        write(lane, hit);
        ask(first_ray + lane, [&](Any& query) { query.take(hit); });
      });
    } else {
      const Lanes reach = first.t + coincidence_tolerance(plain_ray(lines), first.t, first.error);
      take_best(
          group, first.t, reach, found, [object](std::size_t) { return object; }, write);
    }
  }

  /// The same of nearest crossings, each of object_of(lane) and with company up to `reach`, if
  /// there is any.
  template <class ObjectOf, class Write>
  void take_best(std::size_t group, const Lanes& t, const Lanes& reach, RayMask found,
                 const ObjectOf& object_of, const Write& write) {
    Lanes& limits = packet_.limits[group];
    const std::size_t first_ray = group * lane_count;
    RayMask best = 0;
    for_each_ray(found & mask_of(t < answers_.rays.t_max[group]), [&](std::size_t lane) {
      const bool is_best =
          Nearest::take(answers_.hits[first_ray + lane], t[lane], 0, object_of(lane), reach[lane],
                        [&](RayHit& hit) { write(lane, hit); });
      best |= static_cast<RayMask>(is_best) << lane;
    });
    // After the rays' starts, so that they go on.
    const LaneMask nearer = lanes_with(best) && reach < limits;
    limits = select(nearer, reach, limits);
    changed_ |= mask_of(nearer) << first_ray;
  }

  /// Gathers all crossings with an object, of which not all is opaque.
  RayMask gather(const BoundingProxy& proxy, const BoundingProxies& proxies, RayMask rays,
                 const BoxStarts& starts) {
    RayMask open = rays & ~filter_.decide(proxy, proxies, rays, starts, false).rejected;
    if (proxy.is_sphere() && proxies.resolved_leaf(proxy) != nothing) {
      RayPacket::for_each_group(
          open & filter_.resolved(proxy, proxies, starts), [&](std::size_t group, RayMask asked) {
            open &= ~(gather_chords(proxy, proxies, group, asked) << (group * lane_count));
          });
    }
    for_each_ray(open, [&](std::size_t ray) {
      All query = answers_.all(ray);
      query.test(proxy.object);
      add_steps(ray);
      if (query.stopped) settle(RayMask{1} << ray);
    });
    return changed_;
  }

  /// Those of lanes with a sphere that they do not start on. Returns which lanes are done.
  RayMask gather_chords(const BoundingProxy& sphere, const BoundingProxies& proxies,
                        std::size_t group, RayMask asked) {
    const FilterLine<Lanes>& lines = packet_.groups[group];
    const auto ends = crossings_of_sphere(sphere, proxies, lines);
    const auto clear = [&](const FirstCrossing<Lanes>& end) {
      return !end.unknown &
             (!end.found | (end.t < lines.certain_to) | (end.t > packet_.limits[group]));
    };
    const RayMask done = asked & mask_of(clear(ends[0]) & clear(ends[1]));
    answers_.work.intersection_tests += static_cast<unsigned>(std::popcount(done));
    for (const FirstCrossing<Lanes>& end : ends) {
      const RayMask found = done & mask_of(end.found & (end.t <= packet_.limits[group]));
      for_each_ray(found, [&](std::size_t lane) {
        write_first(sphere, proxies, lane_of(end, lane),
                    answers_.found[group * lane_count + lane].emplace_back());
      });
    }
    return done;
  }

  /// The same by the filter of a CSG object, which it asks itself.
  RayMask test_filter(std::uint32_t object, const IntervalFilter& filter, std::size_t group,
                      RayMask asked) {
    const CompiledScene& scene = answers_.accelerator.compiled();
    const FilterLine<Lanes>& lines = packet_.groups[group];
    const auto changes = filter.first_changes<Lanes>(
        {.lines = lines,
         .limits = packet_.limits[group],
         .asked = asked,
         .on_surface = RayPacket::lanes(packet_.starts.on_surface, group),
         .starts = std::span(answers_.rays.starts).subspan(group * lane_count, lane_count)},
        scene.programs[scene.objects[object].program], scene.leaves_of(scene.objects[object]),
        scene.face_surfaces, answers_.work.near_leaves, answers_.work.csg.steps);
    RayMask to_come = asked & mask_of(changes.one);
    RayMask open = asked & ~mask_of(changes.one | changes.none);
    answers_.work.intersection_tests += static_cast<unsigned>(std::popcount(asked & ~open));
    if constexpr (any_will_do) {
      const RayMask surely = to_come & mask_of(changes.to < lines.certain_to);
      settle(surely << (group * lane_count));
      to_come &= ~surely;
    }
    while (to_come != 0) {
      const std::size_t first = first_ray(to_come);
      const RayMask into_leaf = mask_of(changes.into_leaf);
      const RayMask same_way = (into_leaf >> first & 1u) != 0 ? into_leaf : ~into_leaf;
      const RayMask alike = to_come & same_way & mask_of(changes.leaf == changes.leaf[first]);
      to_come &= ~alike;
      open |= take_changes(object, filter, group, alike, changes);
    }
    return open;
  }

  /// Takes changes of one leaf, all into it or all out of it. Returns where none has been found.
  RayMask take_changes(std::uint32_t object, const IntervalFilter& filter, std::size_t group,
                       RayMask alike, const BoundaryChanges<Lanes>& changes) {
    const CompiledScene& scene = answers_.accelerator.compiled();
    const FilterLine<Lanes>& lines = packet_.groups[group];
    const std::size_t first = first_ray(alike);
    const auto number = static_cast<std::uint32_t>(changes.leaf[first]);
    const std::uint32_t index = scene.objects[object].first_leaf + number;
    const Leaf& leaf = scene.leaves[index];
    RayMask resolved = 0;
    if (has_resolved_crossings(leaf)) {
      const bool into_leaf = changes.into_leaf[first];
      const FirstCrossing<Lanes> crossing = crossing_of_change(filter, number, into_leaf, lines);
      const RayMask starting = RayPacket::lanes(rays_with(packet_.starts.leaves, index), group);
      const LineSpanLanes span = RaySlabs::spans(lines, leaf.bounds, alike);
      const LaneMask in_span = (crossing.t >= span.enter) & (crossing.t <= span.leave);
      resolved = alike & ~starting & mask_of(crossing.found & in_span);
      answers_.work.csg.events += static_cast<unsigned>(std::popcount(resolved));
      take(object, group, crossing, resolved, [&](std::size_t lane, RayHit& hit) {
        const FirstCrossing<double> of_ray = lane_of(crossing, lane);
        const auto face = static_cast<std::uint32_t>(of_ray.face);
        hit = {.t = of_ray.t,
               .error = of_ray.error,
               .object = object,
               .leaf = index,
               .face = face,
               .surface = scene.face_surfaces[leaf.first_face + face].surface,
               .root = static_cast<std::uint8_t>(filter.sphere(number) != nullptr && !into_leaf),
               .entering = changes.into_object[lane]};
      });
    }
    RayMask open = 0;
    for_each_ray(alike & ~resolved, [&](std::size_t lane) {
      ask(group * lane_count + lane, [&](auto& query) {
        if (!query.test_change(object, lane_of(changes, lane))) open |= RayMask{1} << lane;
      });
    });
    return open;
  }

  /// Of rays that come to one object more, after so many others that it is worth counting.
  void count_steps(RayMask rays) {
    std::uint64_t most = 0;
    for_each_ray(rays, [&](std::size_t ray) { most = std::max(most, ++steps_[ray]); });
    if (visits_ % steps_per_look == 0) answers_.work.csg.steps.look(most);
  }
  /// Of a ray those that it has taken within an object.
  void add_steps(std::size_t ray) {
    const RaySteps& steps = answers_.work.csg.steps;
    if (steps.taken() < steps_per_look) return;
    steps_[ray] += steps.taken();
    steps.look(steps_[ray]);
  }

  RayPacket& packet_;
  FilterPacket filter_;
  RayMask going_;
  RayMask changed_ = 0;
  Answers& answers_;
  std::uint64_t visits_ = 0;
  std::array<std::uint64_t, packet_size> steps_{};
};

}  // namespace crt::core
