// Packets are rays that travel through a scene side by side. A single ray is a packet of one.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include "core/ray/line_of_ray.hpp"
#include "core/ray/plain_ray.hpp"
#include "core/ray/world_ray.hpp"

namespace crt::core {

/// This is the largest number of rays that travel together. A packet pays where its rays have
/// nearly the same direction.
inline constexpr std::size_t packet_size = 16;

/// A RayMask has a bit for each ray of a packet.
using RayMask = std::uint32_t;

/// Returns the lowest bit that is set. There must be one.
inline std::size_t first_ray(RayMask mask) {
  return static_cast<std::size_t>(std::countr_zero(mask));
}

/// Calls use(index) for each bit that is set.
template <class Use>
void for_each_ray(RayMask mask, const Use& use) {
  for (; mask != 0; mask &= mask - 1) use(first_ray(mask));
}

/// A PacketStartsOf says on what the rays of a packet start, which has `count` rays at most.
template <std::size_t count>
struct PacketStartsOf {
  std::array<std::uint32_t, count> surfaces;
  std::array<std::uint32_t, count> leaves;
  RayMask on_surface = 0;  ///< the rays that start on a surface
  RayMask outwards = 0;    ///< the rays of `on_surface` that leave to the outside
  /// Each entry is the object that a ray has left for good.
  std::array<std::uint32_t, count> left_objects;
  RayMask left_some = 0;  ///< the rays that have left an object

  PacketStartsOf() {
    surfaces.fill(invalid_index);
    leaves.fill(invalid_index);
    left_objects.fill(invalid_index);
  }
};
using PacketStarts = PacketStartsOf<packet_size>;

/// A RayBatch has up to packet_size rays by component. A mask that comes with it says which of them
/// there are. The others may hold anything.
struct RayBatch {
  static constexpr std::size_t group_count = packet_size / lane_count;
  /// Numbers has one number for each ray.
  using Numbers = std::array<Lanes, group_count>;

  std::array<RayLanes, group_count> lines;
  Numbers t_min{};
  Numbers t_max;              ///< infinity unless it is set
  Numbers start_errors;       ///< StartPoint::t_error
  Numbers end_errors{};       ///< as in WorldRay; infinity for the rays with an end
  double max_size_error = 0;  ///< as in WorldRay, of all rays
  bool is_input = false;      ///< as in WorldRay, of all rays
  RayMask with_starts = 0;    ///< the rays with a start; the others start in free space
  std::array<StartPoint, packet_size> starts;
  /// A KnownEnd is an EndPoint with the error there.
  struct KnownEnd {
    EndPoint point;
    double error = 0;
  };
  RayMask with_ends = 0;  ///< the rays that end on a known surface
  std::array<KnownEnd, packet_size> ends;

  RayBatch() { t_max.fill(lanes_of(std::numeric_limits<double>::infinity())); }

  /// Returns one of the rays.
  WorldRay ray(std::size_t index) const;
  const RayLanes& line(std::size_t group) const { return lines[group]; }
  const Lanes& begin(std::size_t group) const { return t_min[group]; }
  const Lanes& end(std::size_t group) const { return t_max[group]; }
  std::span<const StartPoint> group_starts(std::size_t group) const {
    return std::span(starts).subspan(group * lane_count, lane_count);
  }
  Vec3 direction(std::size_t index) const {
    return lines[index / lane_count].direction.lane(index % lane_count);
  }
  void set(std::size_t index, const WorldRay& ray);
  /// Sets all of a ray but t_min, t_max and the errors of its end and of sizes.
  void set(std::size_t index, const Vec3& origin, const Vec3& direction, const StartPoint& start);
};

inline void RayBatch::set(std::size_t index, const Vec3& origin, const Vec3& direction,
                          const StartPoint& start) {
  const std::size_t group = index / lane_count;
  const std::size_t lane = index % lane_count;
  lines[group].origin.set(lane, origin);
  lines[group].direction.set(lane, direction);
  start_errors[group][lane] = start.t_error;
  starts[index] = start;
  with_starts |= RayMask{1} << index;
}

/// A RayPacketOf has rays in the form that the conservative tests take. Of doubles it has one group
/// of one ray, and of Lanes several groups of lane_count rays.
template <class Real>
struct RayPacketOf {
  static constexpr bool is_single = std::is_same_v<Real, double>;
  static constexpr std::size_t group_size = lanes_in<Real>;
  static constexpr std::size_t size = is_single ? 1 : packet_size;
  static constexpr std::size_t group_count = size / group_size;
  static constexpr RayMask group_mask = (1u << group_size) - 1;
  using Rays = std::conditional_t<is_single, WorldRay, RayBatch>;
  using Starts = PacketStartsOf<size>;

  /// Makes a packet of some rays. They and their starts must outlive the packet.
  RayPacketOf(const Rays& rays, const Starts& of_rays, RayMask some);

  /// Groups without a ray hold nothing.
  std::array<FilterLine<Real>, group_count> groups;
  /// Nothing beyond its limit matters to a ray.
  std::array<Real, group_count> limits;
  const Rays& source;  ///< which the packet was made of
  const Starts& starts;

  /// Returns the rays of a group by lane.
  static RayMask lanes(RayMask rays, std::size_t group) {
    return rays >> (group * group_size) & group_mask;
  }

  /// Calls use(group, lanes) for each group that has some of the rays.
  template <class Use>
  static void for_each_group(RayMask rays, const Use& use) {
    for (std::size_t group = 0; group < group_count; ++group) {
      if (lanes(rays, group) != 0) use(group, lanes(rays, group));
    }
  }

  static RayMask all(std::size_t count) {
    return static_cast<RayMask>((std::uint64_t{1} << count) - 1);
  }
  double limit(std::size_t ray) const {
    return lane_of(limits[ray / group_size], ray % group_size);
  }
  void set_limit(std::size_t ray, double limit) {
    set_lane(limits[ray / group_size], ray % group_size, limit);
  }
};
template <>
inline RayPacketOf<double>::RayPacketOf(const WorldRay& ray, const Starts& of_ray, RayMask)
    : groups{line_of(ray)}, limits{ray.t_max}, source(ray), starts(of_ray) {}
template <>
RayPacketOf<Lanes>::RayPacketOf(const RayBatch&, const Starts&, RayMask);
using RayPacket = RayPacketOf<Lanes>;
using SingleRay = RayPacketOf<double>;

/// Returns the rays whose value is the given one.
template <std::size_t count>
RayMask rays_with(const std::array<std::uint32_t, count>& values, std::uint32_t value) {
  if constexpr (count == 1) {
    return mask_of(values[0] == value);
  } else {
    RayMask mask = 0;
    for (std::size_t first = 0; first < count; first += 8) {
      mask |= which_of_eight(&values[first], value) << first;
    }
    return mask;
  }
}

/// Says which rays of a batch are followed together.
enum class Packets {
  where_they_pay,
  always  ///< makes no difference to what the rays find
};

/// A packet of fewer rays does not pay.
inline constexpr int fewest_together = 3;

/// Returns whether some rays have so nearly the same direction that a packet of them pays.
bool go_together(const RayBatch& rays, RayMask some);

}  // namespace crt::core
