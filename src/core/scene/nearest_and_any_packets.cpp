// The two queries that most rays ask, for a packet of rays: the nearest crossing, and whether there is any.
// Each ray finds what it would find alone.
#include <algorithm>
#include <array>
#include <bit>
#include <type_traits>

#include "core/scene/first_crossing.hpp"
#include "core/scene/nearest_and_any.hpp"
#include "core/scene/outlined_rays.hpp"

namespace crt::core {

namespace {

/// Tests the rays of a packet against objects. `query_of(ray)` gives one ray's query, in the state that what
/// has been found so far puts it in; but for the limit, which the packet has.
template <class QueryOf>
class PacketTests {
 public:
  using Kind = std::invoke_result_t<QueryOf, std::size_t>;

  PacketTests(RayPacket& packet, RayMask going, RayWorkspace& work, const QueryOf& query_of)
      : packet_(packet), outlined_(packet), going_(going), work_(work), query_of_(query_of) {}

  /// The rays that still go.
  RayMask going() const { return going_; }

  /// Returns the rays whose limits it changed.
  RayMask test(const Outline& outline, const Outlines& outlines, RayMask rays) {
    changed_ = 0;
    rays &= ~outlined_.left(outline);
    if (rays == 0) return 0;
    const BoxStarts starts = outlined_.box_starts(outline, outlines, rays);
    const Verdict<RayMask> verdict = outlined_.judge(outline, outlines, rays, starts, Kind::any_will_do);
    RayMask open = rays & ~verdict.missed;
    if constexpr (Kind::any_will_do) {
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
    for_each_ray(open, [&](std::size_t ray) { ask(ray, [&](Kind& query) { query.test(outline.object); }); });
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
    Kind query = query_of_(ray);
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
    const OutlineLine<Lanes>& lines = packet_.groups[group];
    const FirstCrossing<Lanes> first = outlined_.first_crossing(outline, outlines, group, asked, starts);
    const RayMask open = asked & mask_of(first.unknown);
    work_.intersection_tests += static_cast<unsigned>(std::popcount(asked & ~open));
    const RayMask found = asked & ~open & mask_of(both(first.found, first.t <= packet_.limits[group]));
    if (found != 0) {
      const Lanes reach = first.t + company_width(plain_ray(lines), first.t, first.error);
      for_each_ray(found, [&](std::size_t lane) {
        const FirstCrossing<double> of_ray = lane_of(first, lane);
        const auto write = [&](RayHit& hit) { write_first(outline, outlines, of_ray, hit); };
        ask(group * lane_count + lane, [&](Kind& query) {
          query.take(of_ray.t, 0, outline.object, reach[static_cast<int>(lane)], write);
        });
      });
    }
    return open;
  }

  RayPacket& packet_;
  OutlinedPacket outlined_;
  RayMask going_;
  RayMask changed_ = 0;
  RayWorkspace& work_;
  const QueryOf& query_of_;
};

}  // namespace

template <class QueryOf>
RayMask Accelerator::traverse_filtered(RayPacket& packet, RayMask going, RayWorkspace& work,
                                       const QueryOf& query_of) const {
  PacketTests tests(packet, going, work, query_of);
  constexpr bool any_will_do = decltype(tests)::Kind::any_will_do;
  // Where exactly a plane is met is only asked if nothing is before it.
  constexpr bool planes_last = !any_will_do;
  for (const Outline& outline : unbounded_.list) {
    if (tests.going() == 0) break;
    if (planes_last && outline.kind == Outline::Kind::plane) {
      tests.limit_by(outline, unbounded_);
    } else {
      tests.test(outline, unbounded_, tests.going());
    }
  }
  if (tests.going() != 0) {
    visit_boxes<!any_will_do>(packet, tests.going(), [&](std::uint32_t box, RayMask rays) {
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

template <class StartOf>
PacketStarts Accelerator::noted_starts(RayMask rays, const StartOf& start_of) const {
  PacketStarts starts;
  const StartPoint* before = nullptr;
  std::uint32_t left = nothing;
  for_each_ray(rays, [&](std::size_t i) {
    const StartPoint& start = start_of(i);
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

void Accelerator::note_starts(RayMask some, SurfaceRays& rays) const {
  rays.noted = noted_starts(some, [&](std::size_t i) -> const StartPoint& { return rays.starts[i]; });
}

RayPacket Accelerator::packet_of(std::span<const WorldRay> rays) const {
  RayPacket packet(rays);
  packet.starts = noted_starts(RayPacket::all(rays.size()),
                               [&](std::size_t i) -> const StartPoint& { return rays[i].start; });
  return packet;
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

RayMask Accelerator::leave_apart(std::span<const WorldRay> group, std::span<RayHit> hits,
                                 RayWorkspace& work) const {
  std::array<std::uint32_t, lane_count> places;
  RayMask to_come = 0;
  for (std::size_t i = 0; i < group.size(); ++i) {
    const bool as_before = i > 0 && group[i].start.is_to_same_side(group[i - 1].start);
    places[i] = as_before ? places[i - 1] : entered_apart(group[i].start);
    to_come |= static_cast<RayMask>(places[i] != nothing) << i;
  }
  if (to_come == 0) return 0;
  const RayLanes lines = ray_lanes(group);
  const Lanes begin = ray_lanes(group, &WorldRay::t_min);
  const Lanes end = ray_lanes(group, &WorldRay::t_max);
  RayMask done = 0;
  while (to_come != 0) {
    const std::uint32_t place = places[first_ray(to_come)];
    RayMask alike = 0;
    for_each_ray(to_come, [&](std::size_t i) { alike |= static_cast<RayMask>(places[i] == place) << i; });
    to_come &= ~alike;
    const Outline& outline = bounded_.list[place];
    if (tells_exit(outline)) {
      const auto exit = exit_apart(outline, room_of(outline.object), lines, begin, end);
      const RayMask told = alike & mask_of(exit.found);
      for_each_ray(told, [&](std::size_t i) { write_first(outline, bounded_, lane_of(exit, i), hits[i]); });
      work.intersection_tests += static_cast<unsigned>(std::popcount(told));
      done |= told;
      alike &= ~told;
    }
    for_each_ray(alike, [&](std::size_t i) {
      done |= static_cast<RayMask>(leaves_apart(outline, group[i], work, hits[i])) << i;
    });
  }
  return done;
}

RayMask Accelerator::begin_nearest(std::span<const WorldRay> rays, std::span<RayHit> hits,
                                   RayWorkspace& work) const {
  std::fill_n(hits.begin(), rays.size(), RayHit{});
  RayMask open = RayPacket::all(rays.size());
  if (apart_.empty()) return open;
  for (std::size_t first = 0; first < rays.size(); first += lane_count) {
    const std::size_t count = std::min<std::size_t>(lane_count, rays.size() - first);
    const RayMask done = leave_apart(rays.subspan(first, count), hits.subspan(first, count), work);
    open &= ~(done << first);
  }
  return open;
}

void Accelerator::nearest_together(std::span<const WorldRay> rays, RayMask open, std::span<RayHit> hits,
                                   RayWorkspace& work) const {
  RayPacket packet = packet_of(rays);
  traverse_filtered(packet, open, work,
                    [&](std::size_t ray) { return Nearest(*this, rays[ray], work, hits[ray]); });
  for_each_ray(open, [&](std::size_t i) {
    if (hits[i].has_company) hits[i] = gather_company(rays[i], hits[i], work);
  });
}

void Accelerator::nearest(std::span<const WorldRay> rays, std::span<RayHit> hits, RayWorkspace& work) const {
  const RayMask open = begin_nearest(rays, hits, work);
  if (open != 0) nearest_together(rays, open, hits, work);
  expect_surface_points(hits.first(rays.size()));
}

template <class Rays>
bool Accelerator::pay_together(const Rays& rays, RayMask some) const {
  // A row of boxes is looked at for any rays as for those that go the same way.
  return has_box_row() ? std::popcount(some) >= fewest_together : go_together(rays, some);
}

void Accelerator::nearest_each(std::span<const WorldRay> rays, std::span<RayHit> hits,
                               RayWorkspace& work) const {
  const RayMask open = begin_nearest(rays, hits, work);
  if (pay_together(rays, open)) {
    nearest_together(rays, open, hits, work);
  } else {
    for_each_ray(open, [&](std::size_t i) { hits[i] = nearest_elsewhere(rays[i], work); });
  }
  expect_surface_points(hits.first(rays.size()));
}

RayMask Accelerator::any(std::span<const WorldRay> rays, RayWorkspace& work) const {
  if (rays.empty()) return 0;
  RayPacket packet = packet_of(rays);
  const RayMask all = RayPacket::all(rays.size());
  return all &
         ~traverse_filtered(packet, all, work, [&](std::size_t ray) { return Any(*this, rays[ray], work); });
}

RayMask Accelerator::any_each(std::span<const WorldRay> rays, RayWorkspace& work) const {
  if (pay_together(rays, RayPacket::all(rays.size()))) return any(rays, work);
  RayMask found = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) found |= static_cast<RayMask>(any(rays[i], work)) << i;
  return found;
}

RayMask Accelerator::any_each(const SurfaceRays& rays, RayMask some, RayWorkspace& work) const {
  if (!pay_together(rays, some)) {
    RayMask found = 0;
    for_each_ray(some, [&](std::size_t i) { found |= static_cast<RayMask>(any(rays.ray(i), work)) << i; });
    return found;
  }
  RayPacket packet(rays, some);
  WorldRay asked;
  return some & ~traverse_filtered(packet, some, work, [&](std::size_t ray) {
           asked = rays.ray(ray);
           return Any(*this, asked, work);
         });
}

}  // namespace crt::core
