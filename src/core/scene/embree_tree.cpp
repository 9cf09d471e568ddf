#include "core/scene/embree_tree.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstring>
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
#include "core/scene/ball_search.hpp"
#include "core/scene/embree_compat.hpp"
#include "core/scene/embree_floats.hpp"
#include "crt/error.hpp"

namespace crt::core {

namespace {

constexpr float float_infinity = std::numeric_limits<float>::infinity();

/// How much boxes grow by, in units in which the whole scene's half extent is between 1/2 and 1: as much as
/// roundings may put a ray next to where it is, u = 2^-24 being a float's.
///
/// Embree gets the ray's start o and direction d as floats, which moves its points by u and, for each unit of
/// the way, by u again: rays start within 2 of the middle, so that is 9 u. It finds where they meet the plane
/// x = l at l r - o r, with r = 1 / d known to 4 u (a processor's estimate, and a step of Newton's method):
/// another 2 u for the product and 5 u of |l - o| < 3. RTC_SCENE_FLAG_ROBUST, which would spare the latter,
/// makes no difference to boxes of users (Embree 3.13).
constexpr double box_margin = 0x1p-19;  // 32 u

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
  enum class Kind { of_ray, of_packet, among_balls };

  EmbreeContext context;
  Kind kind = Kind::of_ray;
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
  AnyTraversal any{.context = {}, .kind = AnyTraversal::Kind::of_packet};
  PacketVisitor* visitor = nullptr;
  const RayPacket* packet = nullptr;
  std::array<Lanes, RayPacket::group_count> t_start{};
  double scale = 1;
  std::exception_ptr failure{};

  FloatLanes far_ends(std::size_t group) const {
    const Lanes& start = t_start[group];
    const Lanes& limit = packet->limits[group];
    const auto is_over = __builtin_convertvector(limit < start, IntLanes);
    return is_over ? FloatLanes{} - float_infinity : round_up_length((limit - start) * scale);
  }
};

/// A packet's whose rays are looked for by floats alone.
struct BallTraversal {
  AnyTraversal any;
  std::size_t first_ray;  ///< of the packet, that the search has as its first
  BallSearch search;

  explicit BallTraversal(std::size_t first) : first_ray(first) {
    init_context(any.context);
    any.kind = AnyTraversal::Kind::among_balls;
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

/// What Embree's geometry is of.
struct Things {
  std::vector<RTCBounds> boxes;  ///< until Embree has built its tree
  std::vector<FloatBall> balls;
};

void bounds_callback(const RTCBoundsFunctionArguments* arguments) {
  *arguments->bounds_o = static_cast<const Things*>(arguments->geometryUserPtr)->boxes[arguments->primID];
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

/// Rays of a packet come to a ball.
void visit_ball(const RTCIntersectFunctionNArguments& arguments, RTCRayN* rays) {
  auto& [any, first_ray, search] = *reinterpret_cast<BallTraversal*>(arguments.context);
  const unsigned count = arguments.N;
  const FloatBall& ball = static_cast<const Things*>(arguments.geometryUserPtr)->balls[arguments.primID];
  const auto meet_octets = [&](auto& of_part) {
    for (std::size_t first = 0; first < std::size(of_part.tfar); first += octet_size) {
      const FloatRays octet{
          .origin = {&of_part.org_x[first], &of_part.org_y[first], &of_part.org_z[first]},
          .direction = {&of_part.dir_x[first], &of_part.dir_y[first], &of_part.dir_z[first]},
          .end = &of_part.tfar[first]};
      search.meet(ball, arguments.primID, first, octet_at<OctetMask>(arguments.valid + first), octet);
    }
  };
  if (count == packet_size) return meet_octets(*reinterpret_cast<RTCRay16*>(rays));
  if (count == octet_size) return meet_octets(*reinterpret_cast<RTCRay8*>(rays));
  for (unsigned i = 0; i < count; ++i) {
    if (arguments.valid[i] == 0) continue;
    // One ray among others that are not looked at.
    const std::size_t ray = RTCRayN_id(rays, count, i) - first_ray;
    const std::size_t first = ray - ray % octet_size;
    std::array<std::array<float, octet_size>, 7> columns;
    const auto column = [&](std::size_t index, float value) {
      columns[index].fill(value);
      return columns[index].data();
    };
    const FloatRays octet{
        .origin = {column(0, RTCRayN_org_x(rays, count, i)), column(1, RTCRayN_org_y(rays, count, i)),
                   column(2, RTCRayN_org_z(rays, count, i))},
        .direction = {column(3, RTCRayN_dir_x(rays, count, i)), column(4, RTCRayN_dir_y(rays, count, i)),
                      column(5, RTCRayN_dir_z(rays, count, i))},
        .end = column(6, RTCRayN_tfar(rays, count, i))};
    OctetMask only{};
    only[ray % octet_size] = -1;
    search.meet(ball, arguments.primID, first, only, octet);
    RTCRayN_tfar(rays, count, i) = columns[6][ray % octet_size];
  }
}

void intersect_callback(const RTCIntersectFunctionNArguments* arguments) {
  using Kind = AnyTraversal::Kind;
  RTCRayN* rays = RTCRayHitN_RayN(arguments->rayhit, arguments->N);
  switch (reinterpret_cast<const AnyTraversal*>(arguments->context)->kind) {
    case Kind::among_balls:
      return visit_ball(*arguments, rays);
    case Kind::of_packet:
      return visit_box(arguments->context, arguments->primID, arguments->valid, rays, arguments->N);
    case Kind::of_ray:
      return visit_box(arguments->context, arguments->primID, arguments->valid,
                       *reinterpret_cast<RTCRay*>(rays));
  }
}

/// Only single rays ask in that way.
void occluded_callback(const RTCOccludedFunctionNArguments* arguments) {
  visit_box(arguments->context, arguments->primID, arguments->valid,
            *reinterpret_cast<RTCRay*>(arguments->ray));
}

/// None if most of them are so small that floats hardly know them.
std::vector<FloatBall> float_balls(std::span<const Ball> balls, const Vec3& center, double scale) {
  constexpr double smallest = 0x1p-12;
  const auto is_small = [&](const Ball& ball) { return ball.radius * scale < smallest; };
  const auto small_balls = std::count_if(balls.begin(), balls.end(), is_small);
  std::vector<FloatBall> floats;
  if (static_cast<std::size_t>(small_balls) > balls.size() / 8) return floats;
  floats.reserve(balls.size());
  const auto to_float = [](double value) { return static_cast<float>(value); };
  for (const Ball& ball : balls) {
    const Vec3 place = (ball.center - center) * scale;
    floats.push_back(
        {{to_float(place.x), to_float(place.y), to_float(place.z)}, to_float(ball.radius * scale)});
  }
  return floats;
}

}  // namespace

struct EmbreeTree::Handles {
  std::atomic<std::int64_t> embree_bytes = 0;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  Things things;
  bool takes_sixteen = false;  ///< rays at once, without taking them one by one

  ~Handles() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
};

EmbreeTree::EmbreeTree(std::span<const Bounds> boxes, const Bounds& total, std::span<const Ball> balls) {
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
  std::vector<RTCBounds>& floats = handles->things.boxes;
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
  handles->scene = rtcNewScene(handles->device);
  RTCGeometry geometry = rtcNewGeometry(handles->device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(boxes.size()));
  rtcSetGeometryUserData(geometry, &handles->things);
  rtcSetGeometryBoundsFunction(geometry, bounds_callback, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect_callback);
  rtcSetGeometryOccludedFunction(geometry, occluded_callback);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(handles->scene, geometry);
  rtcReleaseGeometry(geometry);
  build(handles->scene, boxes.size());
  check(handles->device);
  floats = {};
  handles->things.balls = float_balls(balls, center_, scale_);
  handles->takes_sixteen =
      rtcGetDeviceProperty(handles->device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
  handles_ = std::move(handles);
}

EmbreeTree::~EmbreeTree() = default;

std::uint64_t EmbreeTree::bytes() const {
  return static_cast<std::uint64_t>(handles_->embree_bytes) +
         handles_->things.balls.capacity() * sizeof(FloatBall);
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
    traverse_part<RTCRayHit16>(packet, rays, 0, visitor);
    return;
  }
  traverse_part<RTCRayHit8>(packet, rays, 0, visitor);
  traverse_part<RTCRayHit8>(packet, rays, packet_size / 2, visitor);
}

bool EmbreeTree::knows_balls() const {
  return !handles_->things.balls.empty();
}

FirstBalls EmbreeTree::first_balls(const RayBatch& rays, const RayBatch::Numbers& limits,
                                   RayMask some) const {
  FirstBalls known;
  if (handles_->takes_sixteen) {
    find_first_balls<RTCRayHit16>(rays, limits, some, 0, known);
  } else {
    find_first_balls<RTCRayHit8>(rays, limits, some, 0, known);
    find_first_balls<RTCRayHit8>(rays, limits, some, packet_size / 2, known);
  }
  return known;
}

/// Where Embree's rays of a group start, and end.
struct EmbreeTree::Entry {
  Lanes start;        ///< t there
  Lanes end;          ///< and t where they end
  VectorLanes place;  ///< where they start, in Embree's units
  RayMask coming;     ///< those that come to the box around all
  RayMask near;       ///< among balls: that start where BallSearch takes them
};

/// Some rays of a packet as Embree takes them.
template <class RayHits>
struct EmbreeTree::Part {
  static constexpr std::size_t count = sizeof(RayHits::ray.tfar) / sizeof(float);

  std::size_t first_ray;  ///< of the packet
  RayHits ray_hits;
  alignas(64) std::array<int, count> valid{};
  RayBatch::Numbers t_start;  ///< t where Embree's rays start, by the packet's groups
  RayMask followed = 0;       ///< of the packet

  explicit Part(std::size_t first) : first_ray(first) {}

  /// put(group, lanes) of each group that is in the part.
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
    }
  }

  /// Some lanes of a group.
  void put(std::size_t group, RayMask lanes, const Entry& entry, const VectorLanes& direction, double scale) {
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

inline void EmbreeTree::enter(const OutlineLine<Lanes>& lines, const Lanes& limits, RayMask lanes,
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
    const OutlineLine<Lanes>& lines = packet.groups[group];
    Entry entry;
    enter(lines, packet.limits[group], lanes, entry);
    part.put(group, entry.coming, entry, plain_ray(lines).direction, scale_);
  });
  if (part.followed == 0) return;
  PacketTraversal traversal{.visitor = &visitor, .packet = &packet, .t_start = part.t_start, .scale = scale_};
  init_context(traversal.any.context);
  embree_intersect(handles_->scene, traversal.any.context, part.valid.data(), part.ray_hits);
  if (traversal.failure) std::rethrow_exception(traversal.failure);
}

/// Rays that start near enough are not moved to the box around all.
inline void EmbreeTree::enter_among_balls(const RayBatch& rays, const RayBatch::Numbers& limits,
                                          std::size_t group, RayMask lanes, Entry& entry) const {
  const RayLanes& lines = rays.lines[group];
  const Lanes& begin = rays.t_min[group];
  for (int axis = 0; axis < 3; ++axis) {
    entry.place[axis] = (lines.origin[axis] - center_[axis] + begin * lines.direction[axis]) * scale_;
  }
  entry.near = lanes & mask_of(BallSearch::is_near(entry.place, begin * scale_));
  if (entry.near == lanes) {
    entry.start = begin;
    entry.end = min(limits[group], begin + BallSearch::farthest * (1 / scale_));
    entry.coming = lanes & mask_of(begin <= entry.end);
    return;
  }
  OutlineLine<Lanes> line;
  line.origin = {lines.origin.x, lines.origin.y, lines.origin.z};
  line.direction = {lines.direction.x, lines.direction.y, lines.direction.z};
  for (std::size_t axis = 0; axis < 3; ++axis) line.inverse[axis] = 1.0 / line.direction[axis];
  line.begin = begin;
  enter(line, limits[group], lanes, entry);
  entry.near = lanes & mask_of(BallSearch::is_near(entry.place, entry.start * scale_));
}

template <class RayHits>
void EmbreeTree::find_first_balls(const RayBatch& rays, const RayBatch::Numbers& limits, RayMask some,
                                  std::size_t first_ray, FirstBalls& known) const {
  Part<RayHits> part(first_ray);
  BallTraversal traversal(first_ray);
  BallSearch& search = traversal.search;
  part.fill(some, [&](std::size_t group, RayMask lanes) {
    const VectorLanes& direction = rays.lines[group].direction;
    Entry entry;
    enter_among_balls(rays, limits, group, lanes, entry);
    known.missing |= (lanes & ~entry.coming) << (group * lane_count);
    const Lanes squared_speed = dot(direction, direction);
    search.set_squared_speeds(group * lane_count - first_ray, to_floats(squared_speed));
    const LaneMask is_plain = BallSearch::is_plain(squared_speed) & (rays.start_errors[group] == 0.0);
    part.put(group, entry.coming & entry.near & mask_of(is_plain), entry, direction, scale_);
  });
  if (part.followed == 0) return;
  embree_intersect(handles_->scene, traversal.any.context, part.valid.data(), part.ray_hits);

  const auto& ends = part.ray_hits.ray.tfar;
  const BallSearch::Outcome outcome = search.outcome(ends);
  const RayMask known_rays = part.followed & outcome.known << first_ray;
  const RayMask meeting = outcome.meeting << first_ray;
  known.meeting |= known_rays & meeting;
  known.missing |= known_rays & ~meeting;
  std::memcpy(&known.boxes[first_ray], search.first().data(), part.count * sizeof(std::uint32_t));
  for (std::size_t first = 0; first < part.count; first += lane_count) {
    const std::size_t group = (first_ray + first) / lane_count;
    known.to[group] = part.t_start[group] + to_doubles(lanes_at<FloatLanes>(&ends[first])) * (1 / scale_);
  }
}

}  // namespace crt::core
