#include <algorithm>
#include <array>
#include <bit>

#include "core/accel/embree_traversals.hpp"

namespace crt::core {

namespace {

/// Visits a box and returns Embree's new end of the ray. No exception may pass through Embree, so
/// one is kept for later and the ray is ended.
float visit_box(EmbreeContext* context, std::uint32_t box) {
  auto* traversal = reinterpret_cast<Traversal*>(context);
  try {
    const double t_max = traversal->visitor->visit(box);
    return t_max < traversal->t_start ? -float_infinity : traversal->far_end(t_max);
  } catch (...) {
    traversal->failure = std::current_exception();
    return -float_infinity;
  }
}

/// Returns whether what Embree calls with has whole groups. It calls with a packet, with a part of
/// it that has whole groups, or with a single ray of it.
bool has_groups(unsigned count) {
  return count % lane_count == 0;
}

RayMask mask_of_valid(const int* valid, unsigned count) {
  if (!has_groups(count)) return valid[0] != 0 ? 1 : 0;
  RayMask mask = 0;
  for (unsigned i = 0; i < count; i += lane_count)
    mask |= mask_of(lanes_at<IntLanes>(valid + i) != 0) << i;
  return mask;
}

/// Visits a box with those rays of a packet that meet it, as far as Embree can resolve.
void visit_box(EmbreeContext* context, std::uint32_t box, const int* valid, RTCRayN* rays,
               unsigned count) {
  auto* traversal = reinterpret_cast<PacketTraversal*>(context);
  const RayMask mask = mask_of_valid(valid, count);
  if (mask == 0) return;
  // The number of a valid ray shows which part of the packet this is.
  const auto some = static_cast<unsigned>(std::countr_zero(mask));
  const unsigned first = RTCRayN_id(rays, count, some) - some;
  try {
    const RayMask changed = traversal->visitor->visit(box, mask << first) >> first;
    RayPacket::for_each_group(changed, [&](std::size_t group, RayMask) {
      const std::size_t ray = group * lane_count;
      const FloatLanes ends = traversal->far_ends((first + ray) / lane_count);
      float* far_ends = &RTCRayN_tfar(rays, count, static_cast<unsigned>(ray));
      if (has_groups(count)) {
        put_lanes(min(lanes_at<FloatLanes>(far_ends), ends), far_ends, 0);
      } else {
        *far_ends = std::min(*far_ends, ends[first % lane_count]);
      }
    });
  } catch (...) {
    traversal->failure = std::current_exception();
    for (unsigned i = 0; i < count; ++i) RTCRayN_tfar(rays, count, i) = -float_infinity;
  }
}

/// Visits a box with one ray.
void visit_box(EmbreeContext* context, std::uint32_t box, const int* valid, RTCRay& ray) {
  if (valid[0] != 0) ray.tfar = std::min(ray.tfar, visit_box(context, box));
}

}  // namespace

void bounds_callback(const RTCBoundsFunctionArguments* arguments) {
  *arguments->bounds_o =
      (*static_cast<const std::vector<RTCBounds>*>(arguments->geometryUserPtr))[arguments->primID];
}

void intersect_callback(const RTCIntersectFunctionNArguments* arguments) {
  using Kind = AnyTraversal::Kind;
  RTCRayN* rays = RTCRayHitN_RayN(arguments->rayhit, arguments->N);
  switch (reinterpret_cast<const AnyTraversal*>(arguments->context)->kind) {
    case Kind::of_packet:
      return visit_box(arguments->context, arguments->primID, arguments->valid, rays, arguments->N);
    case Kind::of_ray:
      return visit_box(arguments->context, arguments->primID, arguments->valid,
                       *reinterpret_cast<RTCRay*>(rays));
  }
}

/// Visits a box with a single ray. Embree calls it for no packets, as these only use
/// intersect_callback().
void occluded_callback(const RTCOccludedFunctionNArguments* arguments) {
  visit_box(arguments->context, arguments->primID, arguments->valid,
            *reinterpret_cast<RTCRay*>(arguments->ray));
}

}  // namespace crt::core
