// These functions check that rays find the same alone, in a packet, and without what spares them
// exact tests.
#pragma once

#include <doctest/doctest.h>

#include <array>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <vector>

#include "core/math/vector.hpp"
#include "core/prepare/prepared_data.hpp"
#include "support/numbers.hpp"

namespace crt::test {

using namespace crt::core;

inline bool same(const RayHit& a, const RayHit& b) {
  return a.t == b.t && a.t_low == b.t_low && a.error == b.error && a.object == b.object &&
         a.leaf == b.leaf && a.face == b.face && a.surface == b.surface && a.root == b.root &&
         a.entering == b.entering && a.has_coincident == b.has_coincident;
}

/// Makes a batch of those rays that have their bit in `some`. In the other lanes is no ray at all.
inline RayBatch batch_of(std::span<const WorldRay> rays, RayMask some) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  RayBatch batch;
  for (std::size_t i = 0; i < packet_size; ++i) {
    const bool is_one = (some >> i & 1u) != 0;
    batch.set(
        i, is_one ? rays[i] : WorldRay{.origin = Vec3(nan), .direction = Vec3(nan), .t_max = nan});
    // Code that has rays in free space makes its batches so.
    if (batch.starts[i].leaf == invalid_index) batch.with_starts &= ~(RayMask{1} << i);
  }
  return batch;
}

/// Returns what rays find in a packet, whatever their directions.
inline void intersect_as_packet(const PreparedData& data, std::span<const WorldRay> rays,
                                std::span<RayHit, packet_size> hits, RayWorkspace& work) {
  const RayMask all = RayPacket::all(rays.size());
  data.intersect_each(batch_of(rays, all), all, hits, work, Packets::always);
}
inline RayMask occluded_as_packet(const PreparedData& data, std::span<const WorldRay> rays,
                                  RayWorkspace& work) {
  const RayMask all = RayPacket::all(rays.size());
  return data.occluded_each(batch_of(rays, all), all, work, Packets::always);
}

/// Checks first crossings. With `rough_errors` the bounds on their errors may be larger than where
/// the others are found as well.
inline void check_first_crossings(const PreparedData& data, const std::vector<WorldRay>& rays,
                                  RayWorkspace& work, int& met, bool rough_errors = false) {
  std::array<RayHit, packet_size> hits;
  std::vector<RayHit> line;
  intersect_as_packet(data, rays, hits, work);
  const RayMask hidden = occluded_as_packet(data, rays, work);
  for (std::size_t k = 0; k < rays.size(); ++k) {
    const RayHit alone = data.intersect(rays[k], work);
    REQUIRE(same(alone, hits[k]));
    // The shapes themselves find these crossings.
    data.crossings(rays[k], line, work);
    REQUIRE(alone.found() == !line.empty());
    REQUIRE(((hidden >> k & 1u) != 0) == !line.empty());
    if (!alone.found() || alone.has_coincident) continue;
    RayHit first = line.front();
    if (rough_errors && first.error < alone.error) first.error = alone.error;
    REQUIRE(same(alone, first));
    ++met;
  }
}

/// Lets most of the rays that hit something start there, in the direction that set_way(point, ray)
/// sets. Mostly it is to the side that the start says, but not always.
template <class SetWay>
void go_on(const PreparedData& data, Numbers& numbers, RayWorkspace& work,
           std::vector<WorldRay>& rays, const SetWay& set_way) {
  for (WorldRay& ray : rays) {
    const RayHit hit = data.intersect(ray, work);
    if (!hit.found() || numbers.below(8) == 0) continue;
    const HitPoint point = data.hit_point(ray, hit);
    const Side side = numbers.below(2) == 0 ? Side::outside : Side::inside;
    ray = {.origin = point.position,
           .direction = numbers.direction(),
           .start = data.start_point(ray, hit, side)};
    set_way(point, ray);
    if (!(largest_component(ray.direction) > 0)) ray.direction = {0, 0, 1};
    ray.direction /= largest_component(ray.direction);
    const bool outwards = glm::dot(ray.direction, point.normal) > 0;
    if (outwards != (side == Side::outside) && numbers.below(8) != 0)
      ray.direction = -ray.direction;
  }
}

/// Checks so many packets of rays that some_ray() makes, and of those that continue from what they
/// hit, many of them to where others start.
template <class SomeRay>
void check_bounces(const PreparedData& data, Numbers& numbers, int packets, const SomeRay& some_ray,
                   int& met, bool rough_errors = false) {
  RayWorkspace work;
  for (int i = 0; i < packets; ++i) {
    std::vector<WorldRay> rays(
        static_cast<std::size_t>(1 + numbers.below(static_cast<int>(packet_size))));
    for (WorldRay& ray : rays) ray = some_ray();
    for (int bounce = 0; bounce < 3; ++bounce) {
      check_first_crossings(data, rays, work, met, rough_errors);
      go_on(data, numbers, work, rays, [&](const HitPoint&, WorldRay& ray) {
        const Vec3 to = some_ray().origin;
        if (numbers.below(2) == 0) ray.direction = to - ray.origin;
      });
    }
  }
}

}  // namespace crt::test
