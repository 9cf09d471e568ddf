#include "core/accel/embree_tree.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <memory>
#include <vector>

#ifndef CRT_TASKS_THREADS
#include <oneapi/tbb/task_arena.h>
#endif

#include "core/accel/embree_traversals.hpp"
#include "core/geometry/ray_slabs.hpp"
#include "core/math/vector.hpp"
#include "core/ray/object_ray.hpp"

namespace crt::core {

namespace {

/// Boxes grow by this much, in units in which the whole scene's half extent is between 1/2 and 1.
/// It is as much as roundings may displace a ray, with u = 2^-24 for floats.
///
/// Embree gets the ray's start o and direction d as floats. That moves its points by u and, for
/// each unit of the direction, by u again. Rays start within 2 of the middle, so that is 9 u.
/// Embree finds where they meet the plane x = l at l r - o r. Here r = 1 / d is known to 4 u, by a
/// processor's estimate and a step of Newton's method. That adds 2 u for the product and 5 u of
/// |l - o| < 3. RTC_SCENE_FLAG_ROBUST, which would spare the latter, makes no difference to boxes
/// of users (Embree 3.13).
constexpr double box_margin = 0x1p-19;  // 32 u

/// Boxes also grow by this share of the farthest coordinate, which is more than rays' starts may be
/// off what they are on. In a scene that is far from the origin that is no small part of its size.
constexpr double place_margin = 2 * start_rounding;

/// A tree of fewer boxes is built on this thread alone, as it is not worth starting others.
constexpr std::size_t worth_threads = 2048;

/// Builds the tree on the threads of the caller's arena, if there are enough boxes.
void build(RTCScene scene, [[maybe_unused]] std::size_t box_count) {
#ifndef CRT_TASKS_THREADS
  if (box_count < worth_threads) {
    tbb::task_arena(1).execute([scene] { rtcCommitScene(scene); });
    return;
  }
#endif
  rtcCommitScene(scene);
}

/// Returns the device for a tree of so many boxes. Small trees share one, as a process may have
/// many of them. What they take there is known because one thread builds each of them.
std::shared_ptr<EmbreeDevice> device_for(std::size_t box_count) {
  return box_count < worth_threads ? shared_embree_device() : std::make_shared<EmbreeDevice>();
}

/// A StoppableBuild is what Embree passes to may_go_on() now and then while it builds. No exception
/// may pass through it, so one is kept.
struct StoppableBuild {
  StopCheck* stop;
  std::exception_ptr failure;
  std::atomic_flag failed{};
};

bool may_go_on(void* stoppable_build, double /*share*/) {
  auto& build = *static_cast<StoppableBuild*>(stoppable_build);
  try {
    build.stop->poll();
    return true;
  } catch (...) {
    if (!build.failed.test_and_set()) build.failure = std::current_exception();
    return false;
  }
}

}  // namespace

EmbreeTree::EmbreeTree(std::span<const Bounds> boxes, const Bounds& total, double farthest,
                       StopCheck* stop) {
  double extent = 0;
  for (int axis = 0; axis < 3; ++axis) {
    center_[axis] = total.lower[axis] / 2 + total.upper[axis] / 2;
    extent =
        std::max({extent, total.upper[axis] - center_[axis], center_[axis] - total.lower[axis]});
  }
  if (extent > 0) scale_ = 0.5 / power_of_two_below(extent);
  const double margin = box_margin + place_margin * farthest * scale_;
  total_ = total.grown(2 * margin / scale_);

  auto handles = std::make_unique<Handles>();
  handles->device = device_for(boxes.size());
  const EmbreeDevice& device = *handles->device;
  const std::int64_t bytes_before = EmbreeDevice::bytes_of_this_thread();
  std::vector<RTCBounds>& floats = handles->boxes;
  floats.reserve(boxes.size());
  for (const Bounds& box : boxes) {
    const auto lower = [&](int axis) {
      return round_down((box.lower[axis] - center_[axis]) * scale_ - margin);
    };
    const auto upper = [&](int axis) {
      return round_up((box.upper[axis] - center_[axis]) * scale_ + margin);
    };
    floats.push_back({lower(0), lower(1), lower(2), 0, upper(0), upper(1), upper(2), 0});
  }
  handles->scene = rtcNewScene(device.handle());
  RTCGeometry geometry = rtcNewGeometry(device.handle(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(boxes.size()));
  rtcSetGeometryUserData(geometry, &floats);
  rtcSetGeometryBoundsFunction(geometry, bounds_callback, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect_callback);
  rtcSetGeometryOccludedFunction(geometry, occluded_callback);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(handles->scene, geometry);
  rtcReleaseGeometry(geometry);
  StoppableBuild stoppable{stop, nullptr};
  if (stop != nullptr) rtcSetSceneProgressMonitorFunction(handles->scene, may_go_on, &stoppable);
  build(handles->scene, boxes.size());
  rtcSetSceneProgressMonitorFunction(handles->scene, nullptr, nullptr);
  if (stoppable.failure) {
    device.forget_failure();
    std::rethrow_exception(stoppable.failure);
  }
  device.check();
  floats = {};
  handles->takes_sixteen =
      rtcGetDeviceProperty(device.handle(), RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
  handles->embree_bytes = boxes.size() < worth_threads
                              ? EmbreeDevice::bytes_of_this_thread() - bytes_before
                              : device.bytes();
  handles_ = std::move(handles);
}

EmbreeTree::~EmbreeTree() = default;

std::uint64_t EmbreeTree::bytes() const {
  return static_cast<std::uint64_t>(handles_->embree_bytes);
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

  // The axes are side by side, and the start is computed as ObjectRay::from_center() does it.
  const auto by_axis = [](const Vec3& v) { return lanes_of(v.x, v.y, v.z, 0); };
  const Lanes along = by_axis(direction);
  const DoubleDoubleLanes offset = two_sum(by_axis(origin), -by_axis(center_));
  const Lanes place = (fma(lanes_of(t_start), along, offset.hi) + offset.lo) * scale_;
  const Lanes far = lanes_of(farthest_place);
  const FloatLanes place_floats = to_floats(clamp(place, -far, far));
  const FloatLanes direction_floats = to_floats(along * (1 / length));
  RTCRayHit ray_hit;
  RTCRay& ray = ray_hit.ray;
  ray = {};
  ray.org_x = place_floats[0];
  ray.org_y = place_floats[1];
  ray.org_z = place_floats[2];
  ray.dir_x = direction_floats[0];
  ray.dir_y = direction_floats[1];
  ray.dir_z = direction_floats[2];
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

}  // namespace crt::core
