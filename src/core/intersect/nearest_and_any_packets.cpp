// The two queries that most rays ask, for a packet of rays: the nearest crossing, and whether there
// is any. Each ray finds what it would find alone.
#include <array>
#include <bit>

#include "core/intersect/packet_tests.hpp"

namespace crt::core {

template <class Answers>
RayMask Accelerator::traverse_filtered(RayPacket& packet, RayMask going, Answers& answers) const {
  PacketTests tests(packet, going, answers);
  // Where exactly a plane is met is only asked if nothing is before it.
  constexpr bool planes_last = !Answers::any_will_do;
  for (const BoundingProxy& proxy : unbounded_.list) {
    if (tests.going() == 0) break;
    if (planes_last && proxy.kind == BoundingProxy::Kind::plane) {
      tests.limit_by(proxy, unbounded_);
    } else {
      tests.test(proxy, unbounded_, tests.going());
    }
  }
  RayMask open = tests.going();
  if constexpr (!Answers::any_will_do) {
    if (open != 0 && filters_spheres() && packet.starts.on_surface == 0) {
      open &= ~tests.take_nearest_spheres(tree_->nearest_spheres(answers.rays, packet.limits, open),
                                          bounded_);
    }
  }
  if (open != 0) {
    visit_boxes<!Answers::any_will_do>(packet, open, [&](std::uint32_t box, RayMask rays) {
      return tests.test(bounded_.list[box], bounded_, rays);
    });
  }
  if constexpr (planes_last) {
    for (const BoundingProxy& proxy : unbounded_.list) {
      if (proxy.kind == BoundingProxy::Kind::plane) tests.test(proxy, unbounded_, tests.going());
    }
  }
  return tests.going();
}

PacketStarts Accelerator::noted_starts(const RayBatch& rays, RayMask some) const {
  PacketStarts starts;
  // Neighbours start on the same face more often than not.
  StartPoint face;
  std::uint32_t left = nothing;
  RayMask on_face = 0;
  const auto add_face = [&] {
    if (face.leaf == nothing) return;
    starts.on_surface |= on_face;
    if (face.side == Side::outside) starts.outwards |= on_face;
    if (left != nothing) starts.left_some |= on_face;
  };
  for_each_ray(some & rays.with_starts, [&](std::size_t i) {
    const StartPoint& start = rays.starts[i];
    if (!start.is_to_same_side(face)) {
      add_face();
      face = start;
      left = left_for_good(start);
      on_face = 0;
    }
    on_face |= RayMask{1} << i;
    starts.surfaces[i] = start.surface;
    starts.leaves[i] = start.leaf;
    starts.left_objects[i] = left;
  });
  add_face();
  return starts;
}

bool Accelerator::leaves_isolated(const BoundingProxy& solid, const WorldRay& ray,
                                  RayWorkspace& work, RayHit& hit) const {
  Nearest query(*this, ray, work, hit);
  query.test(solid.object);
  const Bounds margin = box_around(solid.object);
  const PlainRay<double> line{ray.origin, ray.direction};
  if (hit.found() && is_within(margin, line, ray.t_min) && is_within(margin, line, query.limit()))
    return true;
  hit = {};
  return false;
}

bool Accelerator::leaves_isolated(const WorldRay& ray, RayWorkspace& work, RayHit& hit) const {
  const std::uint32_t place = entered_isolated(ray.start);
  if (place == nothing) return false;
  const BoundingProxy& solid = bounded_.list[place];
  if (resolves_exit(solid)) {
    const PlainRay<double> line{ray.origin, ray.direction};
    const auto exit = isolated_exit(solid, box_around(solid.object), line, ray.t_min, ray.t_max);
    if (exit.found) {
      write_first(solid, bounded_, exit, hit);
      ++work.intersection_tests;
      return true;
    }
  }
  return leaves_isolated(solid, ray, work, hit);
}

RayMask Accelerator::leave_isolated(const BoundingProxy& solid, const RayBatch& rays,
                                    std::size_t group, RayMask some,
                                    std::span<RayHit, lane_count> hits, RayWorkspace& work) const {
  RayMask done = 0;
  if (resolves_exit(solid)) {
    const auto exit = isolated_exit(solid, box_around(solid.object), rays.lines[group],
                                    rays.t_min[group], rays.t_max[group]);
    done = some & mask_of(exit.found);
    for_each_ray(done, [&](std::size_t lane) {
      write_first(solid, bounded_, lane_of(exit, lane), hits[lane]);
    });
    work.intersection_tests += static_cast<unsigned>(std::popcount(done));
  }
  for_each_ray(some & ~done, [&](std::size_t lane) {
    const WorldRay ray = rays.ray(group * lane_count + lane);
    done |= static_cast<RayMask>(leaves_isolated(solid, ray, work, hits[lane])) << lane;
  });
  return done;
}

RayMask Accelerator::leave_isolated(const RayBatch& rays, RayMask some,
                                    std::span<RayHit, packet_size> hits, RayWorkspace& work) const {
  if (isolated_.empty()) return 0;
  RayMask done = 0;
  RayPacket::for_each_group(some & rays.with_starts, [&](std::size_t group, RayMask to_come) {
    const std::size_t first = group * lane_count;
    std::array<std::uint32_t, lane_count> places;
    const StartPoint* before = nullptr;
    std::uint32_t place = nothing;
    for_each_ray(to_come, [&](std::size_t lane) {
      const StartPoint& start = rays.starts[first + lane];
      if (before == nullptr || !start.is_to_same_side(*before)) place = entered_isolated(start);
      before = &start;
      places[lane] = place;
      if (place == nothing) to_come &= ~(RayMask{1} << lane);
    });
    while (to_come != 0) {
      place = places[first_ray(to_come)];
      RayMask alike = 0;
      for_each_ray(to_come,
                   [&](std::size_t i) { alike |= static_cast<RayMask>(places[i] == place) << i; });
      to_come &= ~alike;
      done |= leave_isolated(bounded_.list[place], rays, group, alike,
                             hits.subspan(first).first<lane_count>(), work)
              << first;
    }
  });
  return done;
}

bool Accelerator::first_leaves(const RayBatch& rays, RayMask some, FirstLeaves& first) const {
  if (!has_only_spheres() || (some & rays.with_starts) != 0 || !go_together(rays, some))
    return false;
  const NearestSpheres spheres = tree_->nearest_spheres(rays, rays.t_max, some);
  const NearestSphereHits crossings(spheres, bounded_, rays);
  if ((some & ~spheres.missing & ~crossings.known()) != 0) return false;
  RayPacket::for_each_group(crossings.known(), [&](std::size_t group, RayMask lanes) {
    const Lanes& t = crossings.t(group);
    first.found |= (lanes & mask_of(t < rays.t_max[group])) << (group * lane_count);
    first.t[group] = t;
    for (std::size_t i = group * lane_count; i < (group + 1) * lane_count; ++i) {
      first.leaves[i] = crossings.leaf(i);
    }
  });
  return true;
}

RayMask Accelerator::find_all_nearest_spheres(const RayBatch& rays, RayMask some,
                                              std::span<RayHit, packet_size> hits,
                                              RayWorkspace& work) const {
  const NearestSpheres spheres = tree_->nearest_spheres(rays, rays.t_max, some);
  const NearestSphereHits crossings(spheres, bounded_, rays);
  const RayMask known = spheres.missing | crossings.known();
  for (std::size_t group = 0; group < RayBatch::group_count; ++group) {
    const std::size_t first = group * lane_count;
    const RayMask lanes = RayPacket::lanes(known, group);
    RayMask found = RayPacket::lanes(crossings.known(), group);
    if (found == 0) {
      for_each_ray(lanes, [&](std::size_t lane) { hits[first + lane] = {}; });
      continue;
    }
    found &= mask_of(crossings.t(group) < rays.t_max[group]);
    for_each_ray(lanes, [&](std::size_t lane) {
      crossings.write(first + lane, (found >> lane & 1u) != 0, hits[first + lane]);
    });
  }
  work.intersection_tests += static_cast<unsigned>(std::popcount(crossings.known()));
  return known;
}

void Accelerator::nearest_together(const RayBatch& rays, RayMask some,
                                   std::span<RayHit, packet_size> hits, RayWorkspace& work) const {
  const PacketStarts starts = noted_starts(rays, some);
  RayPacket packet(rays, starts, some);
  NearestOfEach answers{*this, rays, hits, work};
  traverse_filtered(packet, some, answers);
  for_each_ray(some, [&](std::size_t i) {
    if (hits[i].has_coincident) hits[i] = gather_coincident(rays.ray(i), hits[i], work);
  });
}

bool Accelerator::pay_together(const RayBatch& rays, RayMask some, Packets packets) const {
  if (packets == Packets::always) return some != 0;
  // A row of boxes is looked at for any rays as for those that go the same way.
  return has_flat_box_list() ? std::popcount(some) >= fewest_together : go_together(rays, some);
}

void Accelerator::nearest_each(const RayBatch& rays, RayMask some,
                               std::span<RayHit, packet_size> hits, Packets packets,
                               RayWorkspace& work) const {
  if (has_only_spheres() && (some & rays.with_starts) == 0 && pay_together(rays, some, packets)) {
    some &= ~find_all_nearest_spheres(rays, some, hits, work);
  }
  for_each_ray(some, [&](std::size_t i) { hits[i] = {}; });
  const RayMask open = some & ~leave_isolated(rays, some, hits, work);
  if (pay_together(rays, open, packets)) {
    nearest_together(rays, open, hits, work);
  } else {
    for_each_ray(open, [&](std::size_t i) { hits[i] = nearest_elsewhere(rays.ray(i), work); });
  }
}

RayMask Accelerator::any_each(const RayBatch& rays, const PacketStarts& starts, RayMask some,
                              Packets packets, RayWorkspace& work) const {
  if (!pay_together(rays, some, packets)) {
    RayMask found = 0;
    for_each_ray(
        some, [&](std::size_t i) { found |= static_cast<RayMask>(any(rays.ray(i), work)) << i; });
    return found;
  }
  RayPacket packet(rays, starts, some);
  AnyOfEach answers{*this, rays, work};
  return some & ~traverse_filtered(packet, some, answers);
}

LightPaths Accelerator::paths_to_light(const RayBatch& rays, const PacketStarts& starts,
                                       RayMask some, const Opacity& opacity, Packets packets,
                                       RayWorkspace& work) const {
  for_each_ray(some, [&](std::size_t i) { work.on_paths[i].clear(); });
  LightPaths paths;
  if (pay_together(rays, some, packets)) {
    RayPacket packet(rays, starts, some);
    LightOfEach answers{{*this, rays, work}, opacity, work.on_paths};
    paths.blocked = some & ~traverse_filtered(packet, some, answers);
  } else {
    for_each_ray(some, [&](std::size_t i) {
      const WorldRay ray = rays.ray(i);
      const bool is_blocked = any(ray, work) && !all(ray, &opacity, work.on_paths[i], work);
      paths.blocked |= static_cast<RayMask>(is_blocked) << i;
    });
  }
  for_each_ray(some & ~paths.blocked, [&](std::size_t i) {
    paths.filtered |= static_cast<RayMask>(!work.on_paths[i].empty()) << i;
  });
  return paths;
}

}  // namespace crt::core
