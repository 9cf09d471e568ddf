// Packets of rays traverse the tree here.
#include <array>
#include <cstring>
#include <exception>

#include "core/accel/embree_traversals.hpp"
#include "core/geometry/ray_slabs.hpp"
#include "core/math/vector_lanes.hpp"

namespace crt::core {

void EmbreeTree::traverse(const RayPacket& packet, RayMask rays, PacketVisitor& visitor) const {
  if (handles_->takes_sixteen) {
    traverse_part<RTCRayHit16>(packet, rays, 0, visitor);
    return;
  }
  traverse_part<RTCRayHit8>(packet, rays, 0, visitor);
  traverse_part<RTCRayHit8>(packet, rays, packet_size / 2, visitor);
}

/// An Entry is where Embree's rays of a group start and end.
struct EmbreeTree::Entry {
  Lanes start;        ///< t where they start
  Lanes end;          ///< t where they end
  VectorLanes place;  ///< where they start, in Embree's units
  RayMask coming;     ///< the rays that come to the box around all
};

/// A Part holds some rays of a packet as Embree takes them.
template <class RayHits>
struct EmbreeTree::Part {
  static constexpr std::size_t count = sizeof(RayHits::ray.tfar) / sizeof(float);

  std::size_t first_ray;  ///< of the packet
  RayHits ray_hits;
  alignas(64) std::array<int, count> valid{};
  RayBatch::Numbers t_start;  ///< t where Embree's rays start, by the packet's groups
  RayMask followed = 0;       ///< of the packet

  explicit Part(std::size_t first) : first_ray(first) {}

  /// Calls put(group, lanes) for each group of the rays that is in the part. Then it sets what all
  /// rays of the part have alike. Rays that are not followed end before they start: without packets
  /// of this size, as on AArch64, Embree looks at that alone, and not at `valid`.
  template <class Put>
  void fill(RayMask rays, const Put& put) {
    for (std::size_t first = 0; first < count; first += lane_count) {
      const std::size_t group = (first_ray + first) / lane_count;
      const RayMask lanes = RayPacket::lanes(rays, group);
      if (lanes != 0) put(group, lanes);
    }
    if (followed == 0) return;
    for (std::size_t ray = 0; ray < count; ++ray) {
      ray_hits.ray.tnear[ray] = 0;
      ray_hits.ray.time[ray] = 0;
      ray_hits.ray.mask[ray] = ~0u;
      ray_hits.ray.id[ray] = static_cast<unsigned>(first_ray + ray);
      ray_hits.ray.flags[ray] = 0;
      ray_hits.hit.geomID[ray] = RTC_INVALID_GEOMETRY_ID;
      if (valid[ray] == 0) ray_hits.ray.tfar[ray] = -float_infinity;
    }
  }

  /// Puts some lanes of a group into Embree's rays.
  void put(std::size_t group, RayMask lanes, const Entry& entry, const VectorLanes& direction,
           double scale) {
    const std::size_t first = group * lane_count - first_ray;
    auto& to_trace = ray_hits.ray;
    followed |= lanes << (group * lane_count);
    t_start[group] = entry.start;
    put_lanes(int_lanes_with(lanes), valid, first);
    put_lanes(to_floats(entry.place.x), to_trace.org_x, first);
    put_lanes(to_floats(entry.place.y), to_trace.org_y, first);
    put_lanes(to_floats(entry.place.z), to_trace.org_z, first);
    put_lanes(direction_floats(direction.x), to_trace.dir_x, first);
    put_lanes(direction_floats(direction.y), to_trace.dir_y, first);
    put_lanes(direction_floats(direction.z), to_trace.dir_z, first);
    put_lanes(round_up_length((entry.end - entry.start) * scale), to_trace.tfar, first);
  }
};

inline void EmbreeTree::enter(const FilterLine<Lanes>& lines, const Lanes& limits, RayMask lanes,
                              Entry& entry) const {
  const LineSpanLanes inside = RaySlabs::spans(lines, total_, lanes);
  entry.start = max(lines.begin, inside.enter);
  entry.end = min(limits, inside.leave);
  const VectorLanes place = plain_ray(lines).from_center(center_, entry.start);
  const Lanes far = lanes_of(farthest_place);
  for (int axis = 0; axis < 3; ++axis) entry.place[axis] = clamp(place[axis] * scale_, -far, far);
  entry.coming = lanes & mask_of(entry.start <= entry.end);
}

template <class RayHits>
void EmbreeTree::traverse_part(const RayPacket& packet, RayMask rays, std::size_t first_ray,
                               PacketVisitor& visitor) const {
  Part<RayHits> part(first_ray);
  part.fill(rays, [&](std::size_t group, RayMask lanes) {
    const FilterLine<Lanes>& lines = packet.groups[group];
    Entry entry;
    enter(lines, packet.limits[group], lanes, entry);
    part.put(group, entry.coming, entry, plain_ray(lines).direction, scale_);
  });
  if (part.followed == 0) return;
  PacketTraversal traversal{
      .visitor = &visitor, .packet = &packet, .t_start = part.t_start, .scale = scale_};
  init_context(traversal.any.context);
  embree_intersect(handles_->scene, traversal.any.context, part.valid.data(), part.ray_hits);
  if (traversal.failure) std::rethrow_exception(traversal.failure);
}

}  // namespace crt::core
