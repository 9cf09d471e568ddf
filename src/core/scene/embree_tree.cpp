#include "core/scene/embree_tree.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <exception>
#include <limits>
#include <string>
#include <vector>

#ifndef CRT_TASKS_THREADS
#include <oneapi/tbb/task_arena.h>
#endif

#include "core/csg/ray_slabs.hpp"
#include "core/geometry/object_ray.hpp"
#include "core/math/vector.hpp"
#include "core/scene/embree_compat.hpp"
#include "core/scene/embree_floats.hpp"
#include "crt/error.hpp"

namespace crt::core {

namespace {

constexpr float float_infinity = std::numeric_limits<float>::infinity();

/// How much boxes grow, in units in which the whole scene's half extent is between 1/2 and 1.
/// A ray's origin and direction are rounded to floats for Embree: 2^-25 an axis for the origin
/// (below 1 in magnitude) and 2^-25 for each unit of the way, at most 2 sqrt(3) long.
constexpr double box_margin = 0x1p-22;

/// And by more than rays' starts may be off what they are on, relative to their coordinates: beside a scene
/// that is far from the origin that is no small part of it.
constexpr double place_margin = 2 * start_rounding;

/// In the same units: Embree takes no ray that starts farther away. None that does so where it should enter
/// the box around all meets anything, but rounding may put it there.
constexpr double farthest_place = 0x1p60;

/// Builds the tree on the threads of the caller's arena; a small one on this thread alone, which is not
/// worth starting any for.
void build(RTCScene scene, [[maybe_unused]] std::size_t box_count) {
#ifndef CRT_TASKS_THREADS
  constexpr std::size_t worth_threads = 2048;
  if (box_count < worth_threads) {
    tbb::task_arena(1).execute([scene] { rtcCommitScene(scene); });
    return;
  }
#endif
  rtcCommitScene(scene);
}

[[noreturn]] void fail(RTCError error) {
  if (error == RTC_ERROR_OUT_OF_MEMORY) {
    throw Error(ErrorCode::out_of_memory, "not enough memory for the acceleration structure");
  }
  if (error == RTC_ERROR_UNSUPPORTED_CPU) {
    throw Error(ErrorCode::unsupported, "this processor is too old for Embree");
  }
  throw Error(ErrorCode::internal, "Embree failed with error " + std::to_string(static_cast<int>(error)));
}

void check(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE) fail(error);
}

/// What the callbacks get of Embree: the context is the first member, so that the two have one address.
struct AnyTraversal {
  EmbreeContext context;
  bool of_packet = false;
};

/// A ray on its way.
struct Traversal {
  AnyTraversal any;
  BoxVisitor* visitor = nullptr;
  double t_start = 0;  ///< t where Embree's ray starts
  double scale = 1;    ///< Embree's t for each unit of t
  std::exception_ptr failure;

  /// Embree's end of the ray for the caller's.
  float far_end(double t) const { return round_up_length((t - t_start) * scale); }
};

/// A packet's likewise.
struct PacketTraversal {
  AnyTraversal any{.context = {}, .of_packet = true};
  PacketVisitor* visitor = nullptr;
  const RayPacket* packet = nullptr;
  std::array<Lanes, RayPacket::group_count> t_start;
  double scale = 1;
  std::exception_ptr failure;

  FloatLanes far_ends(std::size_t group) const {
    const Lanes& start = t_start[group];
    const Lanes& limit = packet->limits[group];
    const auto is_over = __builtin_convertvector(limit < start, IntLanes);
    return is_over ? FloatLanes{} - float_infinity : round_up_length((limit - start) * scale);
  }
};

/// Visits a box and returns Embree's new end of the ray. No exception may pass through Embree, so
/// one is kept for later and the ray ended.
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

/// Is told of what Embree takes (or, as a negative number, gives back); true lets it.
bool count_memory(void* embree_bytes, ssize_t bytes, bool /*done*/) {
  *static_cast<std::atomic<std::int64_t>*>(embree_bytes) += bytes;
  return true;
}

void bounds_callback(const RTCBoundsFunctionArguments* arguments) {
  *arguments->bounds_o = static_cast<const RTCBounds*>(arguments->geometryUserPtr)[arguments->primID];
}

/// Embree calls with a packet, with a part of it that has whole groups, or with a single ray of it.
bool has_groups(unsigned count) {
  return count % lane_count == 0;
}

RayMask mask_of_valid(const int* valid, unsigned count) {
  if (!has_groups(count)) return valid[0] != 0 ? 1 : 0;
  RayMask mask = 0;
  for (unsigned i = 0; i < count; i += lane_count) mask |= mask_of(lanes_at<IntLanes>(valid + i)) << i;
  return mask;
}

/// Visits a box with those rays of a packet whose own boxes Embree met.
void visit_box(EmbreeContext* context, std::uint32_t box, const int* valid, RTCRayN* rays, unsigned count) {
  auto* traversal = reinterpret_cast<PacketTraversal*>(context);
  const RayMask mask = mask_of_valid(valid, count);
  if (mask == 0) return;
  // A ray's number, if it is valid, tells which part of the packet this is.
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
        *far_ends = std::min(*far_ends, ends[static_cast<int>(first % lane_count)]);
      }
    });
  } catch (...) {
    traversal->failure = std::current_exception();
    for (unsigned i = 0; i < count; ++i) RTCRayN_tfar(rays, count, i) = -float_infinity;
  }
}

/// The same with one ray.
void visit_box(EmbreeContext* context, std::uint32_t box, const int* valid, RTCRay& ray) {
  if (valid[0] != 0) ray.tfar = std::min(ray.tfar, visit_box(context, box));
}

void intersect_callback(const RTCIntersectFunctionNArguments* arguments) {
  RTCRayN* rays = RTCRayHitN_RayN(arguments->rayhit, arguments->N);
  if (reinterpret_cast<const AnyTraversal*>(arguments->context)->of_packet) {
    visit_box(arguments->context, arguments->primID, arguments->valid, rays, arguments->N);
  } else {
    visit_box(arguments->context, arguments->primID, arguments->valid, *reinterpret_cast<RTCRay*>(rays));
  }
}

/// Only single rays ask in that way.
void occluded_callback(const RTCOccludedFunctionNArguments* arguments) {
  visit_box(arguments->context, arguments->primID, arguments->valid,
            *reinterpret_cast<RTCRay*>(arguments->ray));
}

}  // namespace

struct EmbreeTree::Handles {
  std::atomic<std::int64_t> embree_bytes = 0;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<RTCBounds> boxes;
  bool takes_sixteen = false;  ///< rays at once, without taking them one by one

  ~Handles() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
};

EmbreeTree::EmbreeTree(std::span<const Bounds> boxes, const Bounds& total) {
  double extent = 0;
  for (int axis = 0; axis < 3; ++axis) {
    center_[axis] = total.lower[axis] / 2 + total.upper[axis] / 2;
    extent = std::max({extent, total.upper[axis] - center_[axis], center_[axis] - total.lower[axis]});
  }
  if (extent > 0) scale_ = 0.5 / power_of_two_below(extent);
  const double margin = box_margin + place_margin * total.farthest() * scale_;
  total_ = total.grown(2 * margin / scale_);

  auto handles = std::make_unique<Handles>();
#ifdef CRT_TASKS_THREADS
  // Builds for ThreadSanitizer: it does not see how Embree's own threads agree.
  handles->device = rtcNewDevice("threads=1");
#else
  handles->device = rtcNewDevice(nullptr);
#endif
  if (handles->device == nullptr) fail(rtcGetDeviceError(nullptr));
  rtcSetDeviceMemoryMonitorFunction(handles->device, count_memory, &handles->embree_bytes);
  handles->boxes.reserve(boxes.size());
  for (const Bounds& box : boxes) {
    const auto lower = [&](int axis) {
      return round_down((box.lower[axis] - center_[axis]) * scale_ - margin);
    };
    const auto upper = [&](int axis) {
      return round_up((box.upper[axis] - center_[axis]) * scale_ + margin);
    };
    handles->boxes.push_back({lower(0), lower(1), lower(2), 0, upper(0), upper(1), upper(2), 0});
  }
  handles->scene = rtcNewScene(handles->device);
  rtcSetSceneFlags(handles->scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(handles->device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(boxes.size()));
  rtcSetGeometryUserData(geometry, handles->boxes.data());
  rtcSetGeometryBoundsFunction(geometry, bounds_callback, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect_callback);
  rtcSetGeometryOccludedFunction(geometry, occluded_callback);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(handles->scene, geometry);
  rtcReleaseGeometry(geometry);
  build(handles->scene, boxes.size());
  check(handles->device);
  handles->takes_sixteen =
      rtcGetDeviceProperty(handles->device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
  handles_ = std::move(handles);
}

EmbreeTree::~EmbreeTree() = default;

std::uint64_t EmbreeTree::bytes() const {
  return static_cast<std::uint64_t>(handles_->embree_bytes) + handles_->boxes.capacity() * sizeof(RTCBounds);
}

void EmbreeTree::traverse(const Vec3& origin, const Vec3& direction, double t_min, double t_max,
                          bool from_near, BoxVisitor& visitor) const {
  // A distant origin is moved up to the scene first, where floats are fine enough.
  const LineSpan span = RaySlabs::span(origin, direction, total_);
  const double t_start = std::max(t_min, span.enter);
  const double t_end = std::min(t_max, span.leave);
  if (t_start > t_end) return;

  const double length = power_of_two_below(largest_component(direction));
  Traversal traversal;
  init_context(traversal.any.context);
  traversal.visitor = &visitor;
  traversal.t_start = t_start;
  traversal.scale = scale_ * length;

  // Axes side by side, and the start as ObjectRay::from_center() has it.
  const auto by_axis = [](const Vec3& v) { return Lanes{v.x, v.y, v.z, 0}; };
  const Lanes way = by_axis(direction);
  const DoubleDoubleLanes offset = two_sum(by_axis(origin), -by_axis(center_));
  const Lanes place = (fma(lanes_of(t_start), way, offset.hi) + offset.lo) * scale_;
  const Lanes far = lanes_of(farthest_place);
  const FloatLanes place_floats = to_floats(clamp(place, -far, far));
  const FloatLanes way_floats = to_floats(way * (1 / length));
  RTCRayHit ray_hit;
  RTCRay& ray = ray_hit.ray;
  ray = {};
  ray.org_x = place_floats[0];
  ray.org_y = place_floats[1];
  ray.org_z = place_floats[2];
  ray.dir_x = way_floats[0];
  ray.dir_y = way_floats[1];
  ray.dir_z = way_floats[2];
  ray.tnear = 0;
  ray.tfar = traversal.far_end(t_end);
  ray.mask = ~0u;
  if (from_near) {
    ray_hit.hit = {};
    ray_hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    embree_intersect(handles_->scene, traversal.any.context, ray_hit);
  } else {
    embree_occluded(handles_->scene, traversal.any.context, ray);
  }
  if (traversal.failure) std::rethrow_exception(traversal.failure);
}

void EmbreeTree::traverse(const RayPacket& packet, RayMask rays, PacketVisitor& visitor) const {
  if (handles_->takes_sixteen) {
    traverse_part<RTCRayHit16, packet_size>(packet, rays, 0, visitor);
    return;
  }
  constexpr std::size_t half = packet_size / 2;
  traverse_part<RTCRayHit8, half>(packet, rays, 0, visitor);
  traverse_part<RTCRayHit8, half>(packet, rays, half, visitor);
}

template <class RayHits, std::size_t Count>
void EmbreeTree::traverse_part(const RayPacket& packet, RayMask rays, std::size_t first_ray,
                               PacketVisitor& visitor) const {
  PacketTraversal traversal;
  init_context(traversal.any.context);
  traversal.visitor = &visitor;
  traversal.packet = &packet;
  traversal.scale = scale_;

  RayHits ray_hits;
  auto& to_trace = ray_hits.ray;
  alignas(64) std::array<int, Count> valid;
  bool some = false;
  for (std::size_t first = 0; first < Count; first += lane_count) {
    const std::size_t group = (first_ray + first) / lane_count;
    const RayMask lanes = RayPacket::lanes(rays, group);
    if (lanes == 0) {
      put_lanes(IntLanes{}, valid, first);
      continue;
    }
    const OutlineLine<Lanes>& lines = packet.groups[group];
    const LineSpanLanes inside = RaySlabs::spans(lines, total_, lanes);
    const Lanes start = max(lines.begin, inside.enter);
    const Lanes end = min(packet.limits[group], inside.leave);
    const RayMask meeting = lanes & mask_of(start <= end);
    some = some || meeting != 0;
    traversal.t_start[group] = start;
    // As ObjectRay::from_center() has it.
    std::array<Lanes, 3> place;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const DoubleDoubleLanes offset =
          two_sum(lines.origin[axis], lanes_of(-center_[static_cast<int>(axis)]));
      const Lanes at = (fma(start, lines.direction[axis], offset.hi) + offset.lo) * scale_;
      place[axis] = max(min(at, lanes_of(farthest_place)), lanes_of(-farthest_place));
    }
    put_lanes(__builtin_convertvector(lanes_with(meeting), IntLanes), valid, first);
    put_lanes(to_floats(place[0]), to_trace.org_x, first);
    put_lanes(to_floats(place[1]), to_trace.org_y, first);
    put_lanes(to_floats(place[2]), to_trace.org_z, first);
    put_lanes(direction_floats(lines.direction[0]), to_trace.dir_x, first);
    put_lanes(direction_floats(lines.direction[1]), to_trace.dir_y, first);
    put_lanes(direction_floats(lines.direction[2]), to_trace.dir_z, first);
    put_lanes(round_up_length((end - start) * scale_), to_trace.tfar, first);
  }
  if (!some) return;
  for (std::size_t ray = 0; ray < Count; ++ray) {
    to_trace.tnear[ray] = 0;
    to_trace.time[ray] = 0;
    to_trace.mask[ray] = ~0u;
    to_trace.id[ray] = static_cast<unsigned>(first_ray + ray);
    to_trace.flags[ray] = 0;
    ray_hits.hit.geomID[ray] = RTC_INVALID_GEOMETRY_ID;
  }
  embree_intersect(handles_->scene, traversal.any.context, valid.data(), ray_hits);
  if (traversal.failure) std::rethrow_exception(traversal.failure);
}

}  // namespace crt::core
