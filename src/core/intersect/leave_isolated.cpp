// Rays that start into an isolated solid find their nearest hits without the driver.
#include <array>
#include <bit>

#include "core/intersect/first_crossing.hpp"
#include "core/intersect/queries.hpp"

namespace crt::core {

template <class Real>
RayMask Accelerator::leave_isolated(const BoundingProxy& solid, const Rays<Real>& rays,
                                    std::size_t group, RayMask lanes, std::span<RayHit> hits,
                                    RayWorkspace& work) const {
  const std::size_t first = group * lanes_in<Real>;
  RayMask done = 0;
  if (solid.leaf != nullptr && solid.leaf->placement->is_identity()) {
    const auto exit = isolated_exit(*solid.leaf, box_around(solid.object), rays.line(group),
                                    rays.begin(group), rays.end(group));
    done = lanes & mask_of(exit.found);
    for_each_ray(done, [&](std::size_t lane) {
      write_first(solid, lane_of(exit, lane), hits[first + lane]);
    });
    work.intersection_tests += static_cast<unsigned>(std::popcount(done));
  }
  const RayMask pending = lanes & ~done;
  return pending == 0
             ? done
             : done | leave_by_tests<Real>(solid, rays, pending << first, hits, work) >> first;
}

RayMask Accelerator::leave_isolated(const WorldRay& ray, RayHit& hit, RayWorkspace& work) const {
  const std::uint32_t place = entered_isolated(ray.start);
  return place == invalid_index
             ? 0
             : leave_isolated<double>(bounded_.list[place], ray, 0, 1, {&hit, 1}, work);
}

RayMask Accelerator::leave_isolated(const RayBatch& rays, RayMask some,
                                    std::span<RayHit, packet_size> hits, RayWorkspace& work) const {
  if (isolated_.empty()) return 0;
  RayMask done = 0;
  RayPacket::for_each_group(some & rays.with_starts, [&](std::size_t group, RayMask to_come) {
    const std::size_t first = group * lane_count;
    std::array<std::uint32_t, lane_count> places;
    const StartPoint* before = nullptr;
    std::uint32_t place = invalid_index;
    for_each_ray(to_come, [&](std::size_t lane) {
      const StartPoint& start = rays.starts[first + lane];
      if (before == nullptr || !start.is_to_same_side(*before)) place = entered_isolated(start);
      before = &start;
      places[lane] = place;
      if (place == invalid_index) to_come &= ~(RayMask{1} << lane);
    });
    while (to_come != 0) {
      place = places[first_ray(to_come)];
      RayMask same_place = 0;
      for_each_ray(to_come, [&](std::size_t i) { same_place |= mask_of(places[i] == place) << i; });
      to_come &= ~same_place;
      done |= leave_isolated<Lanes>(bounded_.list[place], rays, group, same_place, hits, work)
              << first;
    }
  });
  return done;
}

}  // namespace crt::core
