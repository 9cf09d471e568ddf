#include <algorithm>
#include <array>
#include <bit>
#include <iterator>

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

/// Tests a sphere against the rays of a packet that come to its box.
void visit_sphere(const RTCIntersectFunctionNArguments& arguments, RTCRayN* rays) {
  auto& traversal = *reinterpret_cast<SphereTraversal*>(arguments.context);
  NearestSphereFilter& search = traversal.search;
  const unsigned count = arguments.N;
  const FloatSphere& sphere =
      static_cast<const Things*>(arguments.geometryUserPtr)->spheres[arguments.primID];
  const auto meet_octets = [&](auto& of_part) {
    for (std::size_t first = 0; first < std::size(of_part.tfar); first += octet_size) {
      const FloatRays octet{
          .origin = {&of_part.org_x[first], &of_part.org_y[first], &of_part.org_z[first]},
          .direction = {&of_part.dir_x[first], &of_part.dir_y[first], &of_part.dir_z[first]},
          .end = &of_part.tfar[first]};
      const auto valid = lanes_at<IntOctet>(arguments.valid + first) != 0;
      search.meet(sphere, arguments.primID, first, mask_cast<OctetMask>(valid), octet);
    }
  };
  if (count == packet_size) return meet_octets(*reinterpret_cast<RTCRay16*>(rays));
  if (count == octet_size) return meet_octets(*reinterpret_cast<RTCRay8*>(rays));
  for (unsigned i = 0; i < count; ++i) {
    if (arguments.valid[i] == 0) continue;
    // This is one ray among others that are not looked at.
    const std::size_t ray = RTCRayN_id(rays, count, i) - traversal.first_ray;
    const std::size_t first = ray - ray % octet_size;
    std::array<std::array<float, octet_size>, 7> columns;
    const auto column = [&](std::size_t index, float value) {
      columns[index].fill(value);
      return columns[index].data();
    };
    const FloatRays octet{.origin = {column(0, RTCRayN_org_x(rays, count, i)),
                                     column(1, RTCRayN_org_y(rays, count, i)),
                                     column(2, RTCRayN_org_z(rays, count, i))},
                          .direction = {column(3, RTCRayN_dir_x(rays, count, i)),
                                        column(4, RTCRayN_dir_y(rays, count, i)),
                                        column(5, RTCRayN_dir_z(rays, count, i))},
                          .end = column(6, RTCRayN_tfar(rays, count, i))};
    OctetMask only{};
    only[ray % octet_size] = true;
    search.meet(sphere, arguments.primID, first, only, octet);
    RTCRayN_tfar(rays, count, i) = columns[6][ray % octet_size];
    // From a copy of a part of a packet, Embree takes the ends of those rays that hit something.
    RTCHitN_geomID(RTCRayHitN_HitN(arguments.rayhit, count), count, i) = arguments.geomID;
  }
}

}  // namespace

void bounds_callback(const RTCBoundsFunctionArguments* arguments) {
  *arguments->bounds_o =
      static_cast<const Things*>(arguments->geometryUserPtr)->boxes[arguments->primID];
}

void intersect_callback(const RTCIntersectFunctionNArguments* arguments) {
  using Kind = AnyTraversal::Kind;
  RTCRayN* rays = RTCRayHitN_RayN(arguments->rayhit, arguments->N);
  switch (reinterpret_cast<const AnyTraversal*>(arguments->context)->kind) {
    case Kind::among_spheres:
      return visit_sphere(*arguments, rays);
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
