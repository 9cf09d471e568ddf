// The two queries that most rays ask, for a packet of rays: the nearest crossing, and whether there is any.
// Each ray finds what it would find alone.
#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "core/scene/first_crossing.hpp"
#include "core/scene/nearest_and_any.hpp"
#include "core/scene/outlined_rays.hpp"

namespace crt::core {

namespace {

/// What some rays of a batch ask, and find: the nearest crossing.
struct NearestOfEach {
  static constexpr bool any_will_do = false;

  const Accelerator& accelerator;
  const RayBatch& rays;
  std::span<RayHit> hits;
  RayWorkspace& work;
  WorldRay asked{};

  /// In the state that what has been found so far puts it in; but for the limit. The only one at a time.
  Nearest query(std::size_t ray) {
    asked = rays.ray(ray);
    return {accelerator, asked, work, hits[ray]};
  }
};

/// The same: whether there is any.
struct AnyOfEach {
  static constexpr bool any_will_do = true;

  const Accelerator& accelerator;
  const RayBatch& rays;
  RayWorkspace& work;
  WorldRay asked{};

  Any query(std::size_t ray) {
    asked = rays.ray(ray);
    return {accelerator, asked, work};
  }
};

/// Tests the rays of a packet against objects.
template <class Answers>
class PacketTests {
 public:
  static constexpr bool any_will_do = Answers::any_will_do;

  PacketTests(RayPacket& packet, RayMask going, Answers& answers)
      : packet_(packet), outlined_(packet), going_(going), answers_(answers) {}

  /// The rays that still go.
  RayMask going() const { return going_; }

  /// Returns the rays whose limits it changed.
  RayMask test(const Outline& outline, const Outlines& outlines, RayMask rays) {
    changed_ = 0;
    rays &= ~outlined_.left(outline);
    if (rays == 0) return 0;
    const BoxStarts starts = outlined_.box_starts(outline, outlines, rays);
    const Verdict<RayMask> verdict = outlined_.judge(outline, outlines, rays, starts, any_will_do);
    RayMask open = rays & ~verdict.missed;
    if constexpr (any_will_do) {
      open &= ~verdict.met;
      settle(verdict.met);
    }
    if (open != 0 && outlines.leaf_told(outline) != nothing) {
      const RayMask told = open & outlined_.told(outline, starts);
      open &= ~told;
      RayPacket::for_each_group(told, [&](std::size_t group, RayMask asked) {
        open |= test_told(outline, outlines, group, asked, starts) << (group * lane_count);
      });
    }
    if (const CsgSketch* sketch = answers_.accelerator.sketch(outline.object); open != 0 && sketch != nullptr) {
      RayPacket::for_each_group(std::exchange(open, 0), [&](std::size_t group, RayMask asked) {
        open |= test_sketch(outline.object, *sketch, group, asked) << (group * lane_count);
      });
    }
    for_each_ray(open,
                 [&](std::size_t ray) { ask(ray, [&](auto& query) { query.test_in_full(outline.object); }); });
    return changed_;
  }

  /// A plane that is met bounds what else matters.
  void limit_by(const Outline& plane, const Outlines& outlines) {
    std::array<Lanes, RayPacket::group_count> last;
    const RayMask met = outlined_.judge(plane, outlines, going_ & ~outlined_.left(plane), last).met;
    RayPacket::for_each_group(met, [&](std::size_t group, RayMask lanes) {
      // As a hit there would have it.
      const OutlineLine<Lanes>& lines = packet_.groups[group];
      const Lanes reach = last[group] + company_width(plain_ray(lines), last[group], Lanes{});
      Lanes& limits = packet_.limits[group];
      limits = both(lanes_with(lanes), reach < limits) ? reach : limits;
      going_ &= ~((lanes & mask_of(limits <= lines.begin)) << (group * lane_count));
    });
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  /// Those rays have found what they ask for.
  void settle(RayMask rays) {
    changed_ |= rays;
    going_ &= ~rays;
    RayPacket::for_each_group(rays, [&](std::size_t group, RayMask lanes) {
      Lanes& limits = packet_.limits[group];
      limits = lanes_with(lanes) ? lanes_of(-infinity) : limits;
    });
  }

  /// use(query) of one ray, and what it changes.
  template <class Use>
  void ask(std::size_t ray, const Use& use) {
    const double before = packet_.limit(ray);
    auto query = answers_.query(ray);
    query.set_limit(before);
    use(query);
    if (query.limit() == before) return;
    packet_.set_limit(ray, query.limit());
    const RayMask bit = RayMask{1} << ray;
    changed_ |= bit;
    if (query.limit() <= query.ray().t_min) going_ &= ~bit;
  }

  /// Those lanes of a group whose crossings with an object the outline alone tells. Returns which of them it
  /// leaves open nevertheless.
  RayMask test_told(const Outline& outline, const Outlines& outlines, std::size_t group, RayMask asked,
                    const BoxStarts& starts) {
    const FirstCrossing<Lanes> first = outlined_.first_crossing(outline, outlines, group, asked, starts);
    const RayMask open = asked & mask_of(first.unknown);
    answers_.work.intersection_tests += static_cast<unsigned>(std::popcount(asked & ~open));
    const RayMask found = asked & ~open & mask_of(both(first.found, first.t <= packet_.limits[group]));
    if (found != 0) {
      take(outline.object, group, first, found, [&](std::size_t lane, RayHit& hit) {
        write_first(outline, outlines, lane_of(first, lane), hit);
      });
    }
    return open;
  }

  /// Takes crossings with an object before the limits; write(lane, hit) writes one where it stays.
  template <class Write>
  void take(std::uint32_t object, std::size_t group, const FirstCrossing<Lanes>& first, RayMask found,
            const Write& write) {
    const OutlineLine<Lanes>& lines = packet_.groups[group];
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
      Lanes& limits = packet_.limits[group];
      found &= mask_of(first.t < answers_.rays.t_max[group]);
      const Lanes reach = first.t + company_width(plain_ray(lines), first.t, first.error);
      RayMask best = 0;
      for_each_ray(found, [&](std::size_t lane) {
        const auto i = static_cast<int>(lane);
        const bool is_best = Nearest::take(answers_.hits[first_ray + lane], first.t[i], 0, object, reach[i],
                                           [&](RayHit& hit) { write(lane, hit); });
        best |= static_cast<RayMask>(is_best) << lane;
      });
      // After the rays' starts, so that they go on.
      const LaneMask nearer = both(lanes_with(best), reach < limits);
      limits = nearer ? reach : limits;
      changed_ |= mask_of(nearer) << first_ray;
    }
  }

  /// The same as test_told() by the sketch of a CSG object.
  RayMask test_sketch(std::uint32_t object, const CsgSketch& sketch, std::size_t group, RayMask asked) {
    const CompiledScene& scene = answers_.accelerator.compiled();
    const OutlineLine<Lanes>& lines = packet_.groups[group];
    const auto changes = sketch.first_changes<Lanes>(
        {.lines = lines,
         .limits = packet_.limits[group],
         .asked = asked,
         .on_surface = RayPacket::lanes(packet_.starts.on_surface, group),
         .starts = std::span(answers_.rays.starts).subspan(group * lane_count, lane_count)},
        scene.leaves_of(scene.objects[object]), scene.face_surfaces);
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
      const RayMask alike =
          to_come & same_way & mask_of(changes.leaf == changes.leaf[static_cast<int>(first)]);
      to_come &= ~alike;
      open |= take_changes(object, sketch, group, alike, changes);
    }
    return open;
  }

  /// Takes changes of one leaf, all into it or all out of it. Returns where none has been found.
  RayMask take_changes(std::uint32_t object, const CsgSketch& sketch, std::size_t group, RayMask alike,
                       const SketchedChanges<Lanes>& changes) {
    const CompiledScene& scene = answers_.accelerator.compiled();
    const OutlineLine<Lanes>& lines = packet_.groups[group];
    const std::size_t first = first_ray(alike);
    const auto number = static_cast<std::uint32_t>(changes.leaf[static_cast<int>(first)]);
    const std::uint32_t index = scene.objects[object].first_leaf + number;
    const Leaf& leaf = scene.leaves[index];
    RayMask told = 0;
    if (outline_tells(leaf)) {
      const bool into_leaf = changes.into_leaf[static_cast<int>(first)] != 0;
      const FirstCrossing<Lanes> crossing = crossing_of_change(sketch, number, into_leaf, lines);
      const RayMask starting = RayPacket::lanes(rays_with(packet_.starts.leaves, index), group);
      const LineSpanLanes span = RaySlabs::spans(lines, leaf.bounds, alike);
      const LaneMask in_span = (crossing.t >= span.enter) & (crossing.t <= span.leave);
      told = alike & ~starting & mask_of(crossing.found & in_span);
      answers_.work.csg.events += static_cast<unsigned>(std::popcount(told));
      take(object, group, crossing, told, [&](std::size_t lane, RayHit& hit) {
        const FirstCrossing<double> of_ray = lane_of(crossing, lane);
        const auto face = static_cast<std::uint32_t>(of_ray.face);
        hit = {.t = of_ray.t,
               .error = of_ray.error,
               .object = object,
               .leaf = index,
               .face = face,
               .surface = scene.face_surfaces[leaf.first_face + face].surface,
               .root = static_cast<std::uint8_t>(sketch.sphere(number) != nullptr && !into_leaf),
               .entering = changes.into_object[static_cast<int>(lane)] != 0};
      });
    }
    RayMask open = 0;
    for_each_ray(alike & ~told, [&](std::size_t lane) {
      ask(group * lane_count + lane, [&](auto& query) {
        if (!query.test_change(object, lane_of(changes, lane))) open |= RayMask{1} << lane;
      });
    });
    return open;
  }

  RayPacket& packet_;
  OutlinedPacket outlined_;
  RayMask going_;
  RayMask changed_ = 0;
  Answers& answers_;
};

}  // namespace

template <class Answers>
RayMask Accelerator::traverse_filtered(RayPacket& packet, RayMask going, Answers& answers) const {
  PacketTests tests(packet, going, answers);
  // Where exactly a plane is met is only asked if nothing is before it.
  constexpr bool planes_last = !Answers::any_will_do;
  for (const Outline& outline : unbounded_.list) {
    if (tests.going() == 0) break;
    if (planes_last && outline.kind == Outline::Kind::plane) {
      tests.limit_by(outline, unbounded_);
    } else {
      tests.test(outline, unbounded_, tests.going());
    }
  }
  if (tests.going() != 0) {
    visit_boxes<!Answers::any_will_do>(packet, tests.going(), [&](std::uint32_t box, RayMask rays) {
      return tests.test(bounded_.list[box], bounded_, rays);
    });
  }
  if constexpr (planes_last) {
    for (const Outline& outline : unbounded_.list) {
      if (outline.kind == Outline::Kind::plane) tests.test(outline, unbounded_, tests.going());
    }
  }
  return tests.going();
}

PacketStarts Accelerator::noted_starts(const RayBatch& rays, RayMask some) const {
  PacketStarts starts;
  const StartPoint* before = nullptr;
  std::uint32_t left = nothing;
  for_each_ray(some & rays.with_starts, [&](std::size_t i) {
    const StartPoint& start = rays.starts[i];
    if (start.leaf == nothing) return;
    const RayMask bit = RayMask{1} << i;
    starts.surfaces[i] = start.surface;
    starts.leaves[i] = start.leaf;
    starts.on_surface |= bit;
    if (start.side == Side::outside) starts.outwards |= bit;
    // Neighbours start on the same face more often than not.
    if (before == nullptr || !start.is_to_same_side(*before)) left = left_for_good(start);
    before = &start;
    starts.left_objects[i] = left;
    if (left != nothing) starts.left_some |= bit;
  });
  return starts;
}

bool Accelerator::leaves_apart(const Outline& solid, const WorldRay& ray, RayWorkspace& work,
                               RayHit& hit) const {
  Nearest query(*this, ray, work, hit);
  query.test(solid.object);
  const Bounds room = room_of(solid.object);
  const PlainRay<double> line{ray.origin, ray.direction};
  if (hit.found() && is_within(room, line, ray.t_min) && is_within(room, line, query.limit())) return true;
  hit = {};
  return false;
}

bool Accelerator::leaves_apart(const WorldRay& ray, RayWorkspace& work, RayHit& hit) const {
  const std::uint32_t place = entered_apart(ray.start);
  if (place == nothing) return false;
  const Outline& solid = bounded_.list[place];
  if (tells_exit(solid)) {
    const PlainRay<double> line{ray.origin, ray.direction};
    const auto exit = exit_apart(solid, room_of(solid.object), line, ray.t_min, ray.t_max);
    if (exit.found) {
      write_first(solid, bounded_, exit, hit);
      ++work.intersection_tests;
      return true;
    }
  }
  return leaves_apart(solid, ray, work, hit);
}

RayMask Accelerator::leave_apart(const Outline& solid, const RayBatch& rays, std::size_t group, RayMask some,
                                 std::span<RayHit, lane_count> hits, RayWorkspace& work) const {
  RayMask done = 0;
  if (tells_exit(solid)) {
    const auto exit = exit_apart(solid, room_of(solid.object), rays.lines[group], rays.t_min[group],
                                 rays.t_max[group]);
    done = some & mask_of(exit.found);
    for_each_ray(done, [&](std::size_t lane) {
      write_first(solid, bounded_, lane_of(exit, lane), hits[lane]);
    });
    work.intersection_tests += static_cast<unsigned>(std::popcount(done));
  }
  for_each_ray(some & ~done, [&](std::size_t lane) {
    const WorldRay ray = rays.ray(group * lane_count + lane);
    done |= static_cast<RayMask>(leaves_apart(solid, ray, work, hits[lane])) << lane;
  });
  return done;
}

RayMask Accelerator::leave_apart(const RayBatch& rays, RayMask some, std::span<RayHit> hits,
                                 RayWorkspace& work) const {
  if (apart_.empty()) return 0;
  RayMask done = 0;
  RayPacket::for_each_group(some & rays.with_starts, [&](std::size_t group, RayMask to_come) {
    const std::size_t first = group * lane_count;
    std::array<std::uint32_t, lane_count> places;
    const StartPoint* before = nullptr;
    std::uint32_t place = nothing;
    for_each_ray(to_come, [&](std::size_t lane) {
      const StartPoint& start = rays.starts[first + lane];
      if (before == nullptr || !start.is_to_same_side(*before)) place = entered_apart(start);
      before = &start;
      places[lane] = place;
      if (place == nothing) to_come &= ~(RayMask{1} << lane);
    });
    while (to_come != 0) {
      place = places[first_ray(to_come)];
      RayMask alike = 0;
      for_each_ray(to_come, [&](std::size_t i) { alike |= static_cast<RayMask>(places[i] == place) << i; });
      to_come &= ~alike;
      done |= leave_apart(bounded_.list[place], rays, group, alike,
                          hits.subspan(first).first<lane_count>(), work)
              << first;
    }
  });
  return done;
}

void Accelerator::nearest_together(const RayBatch& rays, RayMask some, std::span<RayHit> hits,
                                   RayWorkspace& work) const {
  const PacketStarts starts = noted_starts(rays, some);
  RayPacket packet(rays, starts, some);
  NearestOfEach answers{*this, rays, hits, work};
  traverse_filtered(packet, some, answers);
  for_each_ray(some, [&](std::size_t i) {
    if (hits[i].has_company) hits[i] = gather_company(rays.ray(i), hits[i], work);
  });
}

bool Accelerator::pay_together(const RayBatch& rays, RayMask some, Packets packets) const {
  if (packets == Packets::always) return some != 0;
  // A row of boxes is looked at for any rays as for those that go the same way.
  return has_box_row() ? std::popcount(some) >= fewest_together : go_together(rays, some);
}

void Accelerator::nearest_each(const RayBatch& rays, RayMask some, std::span<RayHit> hits, Packets packets,
                               RayWorkspace& work) const {
  for_each_ray(some, [&](std::size_t i) { hits[i] = {}; });
  const RayMask open = some & ~leave_apart(rays, some, hits, work);
  if (pay_together(rays, open, packets)) {
    nearest_together(rays, open, hits, work);
  } else {
    for_each_ray(open, [&](std::size_t i) { hits[i] = nearest_elsewhere(rays.ray(i), work); });
  }
  expect_surface_points(hits, some);
}

RayMask Accelerator::any_each(const RayBatch& rays, const PacketStarts& starts, RayMask some,
                              Packets packets, RayWorkspace& work) const {
  if (!pay_together(rays, some, packets)) {
    RayMask found = 0;
    for_each_ray(some, [&](std::size_t i) { found |= static_cast<RayMask>(any(rays.ray(i), work)) << i; });
    return found;
  }
  RayPacket packet(rays, starts, some);
  AnyOfEach answers{*this, rays, work};
  return some & ~traverse_filtered(packet, some, answers);
}

}  // namespace crt::core
