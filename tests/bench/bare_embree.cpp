#include "bare_embree.hpp"

#include <algorithm>
#include <stdexcept>

#include "sphere_callbacks.hpp"

namespace crt::bench {

namespace {

constexpr unsigned no_id = RTC_INVALID_GEOMETRY_ID;

/// A Call holds what Embree 3 takes as a context, and Embree 4 as arguments that hold one.
struct Call {
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments intersect;
  RTCOccludedArguments occlude;
#endif
  Context* context;

  Call(Context& with, Flow flow) : context(&with) {
#if RTC_VERSION_MAJOR >= 4
    const auto flags =
        flow == Flow::coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
    rtcInitRayQueryContext(context);
    rtcInitIntersectArguments(&intersect);
    rtcInitOccludedArguments(&occlude);
    intersect.context = occlude.context = context;
    intersect.flags = occlude.flags = flags;
#else
    rtcInitIntersectContext(context);
    context->flags = flow == Flow::coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                            : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
#endif
  }
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

#if RTC_VERSION_MAJOR >= 4
  void operator()(RTCScene scene, RTCRayHit& ray) {
    rtcIntersect1(scene, &ray, &intersect);
  }
  void operator()(RTCScene scene, RTCRay& ray) {
    rtcOccluded1(scene, &ray, &occlude);
  }
  void operator()(RTCScene scene, const int* valid, RTCRayHit16& ray) {
    rtcIntersect16(valid, scene, &ray, &intersect);
  }
  void operator()(RTCScene scene, const int* valid, RTCRay16& ray) {
    rtcOccluded16(valid, scene, &ray, &occlude);
  }
#else
  void operator()(RTCScene scene, RTCRayHit& ray) {
    rtcIntersect1(scene, context, &ray);
  }
  void operator()(RTCScene scene, RTCRay& ray) {
    rtcOccluded1(scene, context, &ray);
  }
  void operator()(RTCScene scene, const int* valid, RTCRayHit16& ray) {
    rtcIntersect16(valid, scene, context, &ray);
  }
  void operator()(RTCScene scene, const int* valid, RTCRay16& ray) {
    rtcOccluded16(valid, scene, context, &ray);
  }
#endif
};

template <class Real>
void load(const crt_ray& from, Rays<Real, 1>& rays, RTCRay& ray) {
  for (int axis = 0; axis < 3; ++axis) {
    rays.origin[axis][0] = static_cast<Real>(from.origin[axis]);
    rays.direction[axis][0] = static_cast<Real>(from.direction[axis]);
  }
  rays.t_min[0] = static_cast<Real>(from.t_min);
  rays.t[0] = static_cast<Real>(from.t_max);
  ray.org_x = static_cast<float>(from.origin[0]);
  ray.org_y = static_cast<float>(from.origin[1]);
  ray.org_z = static_cast<float>(from.origin[2]);
  ray.dir_x = static_cast<float>(from.direction[0]);
  ray.dir_y = static_cast<float>(from.direction[1]);
  ray.dir_z = static_cast<float>(from.direction[2]);
  ray.tnear = static_cast<float>(from.t_min);
  ray.tfar = static_cast<float>(from.t_max);
  ray.time = 0;
  ray.mask = ~0U;
  ray.flags = 0;
}

template <class Real>
void load(std::span<const crt_ray> from, Rays<Real, lanes>& rays, RTCRay16& ray) {
  for (unsigned lane = 0; lane < lanes; ++lane) {
    const crt_ray& one = from[lane];
    for (int axis = 0; axis < 3; ++axis) {
      rays.origin[axis][lane] = static_cast<Real>(one.origin[axis]);
      rays.direction[axis][lane] = static_cast<Real>(one.direction[axis]);
    }
    rays.t_min[lane] = static_cast<Real>(one.t_min);
    rays.t[lane] = static_cast<Real>(one.t_max);
    ray.org_x[lane] = static_cast<float>(one.origin[0]);
    ray.org_y[lane] = static_cast<float>(one.origin[1]);
    ray.org_z[lane] = static_cast<float>(one.origin[2]);
    ray.dir_x[lane] = static_cast<float>(one.direction[0]);
    ray.dir_y[lane] = static_cast<float>(one.direction[1]);
    ray.dir_z[lane] = static_cast<float>(one.direction[2]);
    ray.tnear[lane] = static_cast<float>(one.t_min);
    ray.tfar[lane] = static_cast<float>(one.t_max);
    ray.time[lane] = 0;
    ray.mask[lane] = ~0U;
    ray.flags[lane] = 0;
  }
}

alignas(64) constexpr int all_valid[lanes] = {-1, -1, -1, -1, -1, -1, -1, -1,
                                              -1, -1, -1, -1, -1, -1, -1, -1};

}  // namespace

class BareEmbree::World {
 public:
  World(std::span<const Ball> balls, Stand stand) : World(stand) { take(make(balls)); }
  explicit World(const Surface& surface) : World(Stand::triangles) { take(make(surface)); }
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  ~World() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  /// Calls `with` with a number of the kind that callbacks compute in.
  template <class With>
  void in_precision(const With& with) const {
    if (stand_ == Stand::double_callback) {
      with(double{});
    } else {
      with(float{});
    }
  }

  /// Says whether t comes from our own ray, which has all its digits, and not from Embree's.
  bool has_callbacks() const {
    return stand_ == Stand::double_callback || stand_ == Stand::float_callback;
  }
  RTCScene scene() const { return scene_; }

 private:
  explicit World(Stand stand)
      : stand_(stand), device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {}

  void take(RTCGeometry geometry) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE)
      throw std::runtime_error("Embree refuses the geometry");
  }

  RTCGeometry make(const Surface& surface) {
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), surface.positions.size()));
    for (const auto& position : surface.positions) {
      for (const double coordinate : position) *vertices++ = static_cast<float>(coordinate);
    }
    auto* indices = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(unsigned), surface.triangles.size()));
    for (const auto& triangle : surface.triangles) {
      indices = std::copy(triangle.begin(), triangle.end(), indices);
    }
    return geometry;
  }

  RTCGeometry make(std::span<const Ball> balls) {
    switch (stand_) {
      case Stand::double_callback:
        return user_geometry(balls, doubles_);
      case Stand::float_callback:
        return user_geometry(balls, floats_);
      case Stand::sphere_point:
        return points(balls);
      case Stand::triangles:
        return triangles(balls);
    }
    throw std::logic_error("no such stand");
  }

  template <class Real>
  RTCGeometry user_geometry(std::span<const Ball> balls, std::vector<Equation<Real>>& equations) {
    for (const Ball& ball : balls) {
      equations.push_back({{static_cast<Real>(ball.center[0]), static_cast<Real>(ball.center[1]),
                            static_cast<Real>(ball.center[2])},
                           static_cast<Real>(ball.radius * ball.radius)});
    }
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(equations.size()));
    rtcSetGeometryUserData(geometry, equations.data());
    rtcSetGeometryBoundsFunction(geometry, bound<Real>, nullptr);
    rtcSetGeometryIntersectFunction(geometry, meet<Real>);
    rtcSetGeometryOccludedFunction(geometry, hide<Real>);
    return geometry;
  }

  RTCGeometry points(std::span<const Ball> balls) {
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), balls.size()));
    for (const Ball& ball : balls) {
      for (const double coordinate : ball.center) *vertices++ = static_cast<float>(coordinate);
      *vertices++ = static_cast<float>(ball.radius);
    }
    return geometry;
  }

  /// Makes one triangle in each ball's middle, across the z axis, with corners on the ball.
  RTCGeometry triangles(std::span<const Ball> balls) {
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), 3 * balls.size()));
    auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), balls.size()));
    constexpr double corners[3][2] = {{0, 1}, {0.866, -0.5}, {-0.866, -0.5}};
    unsigned index = 0;
    for (const Ball& ball : balls) {
      for (const double(&corner)[2] : corners) {
        *vertices++ = static_cast<float>(ball.center[0] + corner[0] * ball.radius);
        *vertices++ = static_cast<float>(ball.center[1] + corner[1] * ball.radius);
        *vertices++ = static_cast<float>(ball.center[2]);
        *indices++ = index++;
      }
    }
    return geometry;
  }

  Stand stand_;
  RTCDevice device_;
  RTCScene scene_;
  std::vector<Equation<double>> doubles_;
  std::vector<Equation<float>> floats_;
};

BareEmbree::BareEmbree(std::span<const Ball> balls, Stand stand)
    : world_(std::make_unique<World>(balls, stand)) {}
BareEmbree::BareEmbree(const Surface& surface) : world_(std::make_unique<World>(surface)) {}
BareEmbree::~BareEmbree() = default;
BareEmbree::BareEmbree(BareEmbree&&) noexcept = default;
BareEmbree& BareEmbree::operator=(BareEmbree&&) noexcept = default;

void BareEmbree::intersect_one_by_one(std::span<const crt_ray> rays, Flow flow,
                                      std::span<Answer> answers) const {
  world_->in_precision([&](auto real) {
    Rays<decltype(real), 1> own;
    Call call(own.context, flow);
    RTCRayHit ray_hit;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      load(rays[i], own, ray_hit.ray);
      ray_hit.hit.geomID = no_id;
      call(world_->scene(), ray_hit);
      const double t = world_->has_callbacks() ? own.t[0] : ray_hit.ray.tfar;
      answers[i] = {t, ray_hit.hit.geomID == no_id ? no_id : ray_hit.hit.primID};
    }
  });
}

void BareEmbree::intersect_packets(std::span<const crt_ray> rays, Flow flow,
                                   std::span<Answer> answers) const {
  world_->in_precision([&](auto real) {
    Rays<decltype(real), lanes> own;
    Call call(own.context, flow);
    RTCRayHit16 ray_hit;
    for (std::size_t i = 0; i + lanes <= rays.size(); i += lanes) {
      load(rays.subspan(i, lanes), own, ray_hit.ray);
      for (unsigned& id : ray_hit.hit.geomID) id = no_id;
      call(world_->scene(), all_valid, ray_hit);
      for (unsigned lane = 0; lane < lanes; ++lane) {
        const double t = world_->has_callbacks() ? own.t[lane] : ray_hit.ray.tfar[lane];
        answers[i + lane] = {t,
                             ray_hit.hit.geomID[lane] == no_id ? no_id : ray_hit.hit.primID[lane]};
      }
    }
  });
}

void BareEmbree::occluded_one_by_one(std::span<const crt_ray> rays, Flow flow,
                                     std::span<std::uint8_t> answers) const {
  world_->in_precision([&](auto real) {
    Rays<decltype(real), 1> own;
    Call call(own.context, flow);
    RTCRay ray;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      load(rays[i], own, ray);
      call(world_->scene(), ray);
      answers[i] = ray.tfar < 0;
    }
  });
}

void BareEmbree::occluded_packets(std::span<const crt_ray> rays, Flow flow,
                                  std::span<std::uint8_t> answers) const {
  world_->in_precision([&](auto real) {
    Rays<decltype(real), lanes> own;
    Call call(own.context, flow);
    RTCRay16 ray;
    for (std::size_t i = 0; i + lanes <= rays.size(); i += lanes) {
      load(rays.subspan(i, lanes), own, ray);
      call(world_->scene(), all_valid, ray);
      for (unsigned lane = 0; lane < lanes; ++lane) answers[i + lane] = ray.tfar[lane] < 0;
    }
  });
}

}  // namespace crt::bench
