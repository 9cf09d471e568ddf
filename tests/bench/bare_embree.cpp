#include "bare_embree.hpp"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <cmath>
#include <limits>
#include <stdexcept>
#include <type_traits>

namespace crt::bench {

namespace {

constexpr unsigned lanes = 16;
constexpr unsigned no_id = RTC_INVALID_GEOMETRY_ID;

#if RTC_VERSION_MAJOR >= 4
using Context = RTCRayQueryContext;
#else
using Context = RTCIntersectContext;
#endif

/// A ball as the callbacks have it.
template <class Real>
struct Equation {
  Real center[3];
  Real radius_squared;
};

/// The rays of a call with all their digits, which Embree hands to the callbacks: N is 1 or 16.
template <class Real, unsigned N>
struct Rays {
  Context context;  // first: callbacks get its address
  alignas(64) Real origin[3][N];
  Real direction[3][N];
  Real t_min[N];
  Real t[N];  ///< the nearest so far
};

/// The nearest crossing of one lane beyond its t_min, or what is nearest already.
template <class Real, unsigned N>
inline Real nearest_crossing(const Rays<Real, N>& rays, const Equation<Real>& ball, unsigned lane) {
  Real along = 0;
  Real speed = 0;
  Real distance = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Real to_center = ball.center[axis] - rays.origin[axis][lane];
    along += to_center * rays.direction[axis][lane];
    speed += rays.direction[axis][lane] * rays.direction[axis][lane];
    distance += to_center * to_center;
  }
  const Real discriminant = along * along - speed * (distance - ball.radius_squared);
  const Real root = std::sqrt(discriminant > 0 ? discriminant : 0);
  const Real per_speed = 1 / speed;
  const Real first = (along - root) * per_speed;
  const Real second = (along + root) * per_speed;
  const Real t = first > rays.t_min[lane] ? first : second;
  const bool nearer = (discriminant > 0) & (t > rays.t_min[lane]) & (t < rays.t[lane]);
  return nearer ? t : rays.t[lane];
}

template <class Real, unsigned N, class Arguments>
const Equation<Real>& ball_of(const Arguments& arguments) {
  return static_cast<const Equation<Real>*>(arguments.geometryUserPtr)[arguments.primID];
}

template <class Real>
void meet_one(const RTCIntersectFunctionNArguments& arguments) {
  auto& rays = *reinterpret_cast<Rays<Real, 1>*>(arguments.context);
  const Real t = nearest_crossing(rays, ball_of<Real, 1>(arguments), 0);
  if (!(t < rays.t[0])) return;
  rays.t[0] = t;
  auto& ray_hit = *reinterpret_cast<RTCRayHit*>(arguments.rayhit);
  ray_hit.ray.tfar = static_cast<float>(t);
  ray_hit.hit.primID = arguments.primID;
  ray_hit.hit.geomID = arguments.geomID;
}

/// Finds the lanes whose rays the ball stops, 1 or 0 for each; false if there are none. Loops over lanes here
/// and below are written so that they become vector code.
template <class Real>
bool stopped_lanes(const Rays<Real, lanes>& rays, const Equation<Real>& ball, const int* valid,
                   Real (&found)[lanes], int (&stopped)[lanes]) {
  int any = 0;
  for (unsigned lane = 0; lane < lanes; ++lane) found[lane] = nearest_crossing(rays, ball, lane);
  for (unsigned lane = 0; lane < lanes; ++lane) stopped[lane] = found[lane] < rays.t[lane] ? -valid[lane] : 0;
  for (unsigned lane = 0; lane < lanes; ++lane) any |= stopped[lane];
  return any != 0;
}

template <class Number, class Other>
void replace(Number (&numbers)[lanes], const int (&where)[lanes], const Other (&by)[lanes]) {
  for (unsigned lane = 0; lane < lanes; ++lane) {
    numbers[lane] = where[lane] != 0 ? static_cast<Number>(by[lane]) : numbers[lane];
  }
}

template <class Number>
void replace(Number (&numbers)[lanes], const int (&where)[lanes], Number by) {
  for (unsigned lane = 0; lane < lanes; ++lane) numbers[lane] = where[lane] != 0 ? by : numbers[lane];
}

template <class Real>
void meet_packet(const RTCIntersectFunctionNArguments& arguments) {
  auto& rays = *reinterpret_cast<Rays<Real, lanes>*>(arguments.context);
  alignas(64) Real found[lanes];
  alignas(64) int stopped[lanes];
  if (!stopped_lanes(rays, ball_of<Real, lanes>(arguments), arguments.valid, found, stopped)) return;
  auto& ray_hit = *reinterpret_cast<RTCRayHit16*>(arguments.rayhit);
  replace(rays.t, stopped, found);
  replace(ray_hit.ray.tfar, stopped, found);
  replace(ray_hit.hit.primID, stopped, arguments.primID);
  replace(ray_hit.hit.geomID, stopped, arguments.geomID);
}

template <class Real>
void meet(const RTCIntersectFunctionNArguments* arguments) {
  arguments->N == 1 ? meet_one<Real>(*arguments) : meet_packet<Real>(*arguments);
}

template <class Real>
void hide_one(const RTCOccludedFunctionNArguments& arguments) {
  const auto& rays = *reinterpret_cast<const Rays<Real, 1>*>(arguments.context);
  if (!(nearest_crossing(rays, ball_of<Real, 1>(arguments), 0) < rays.t[0])) return;
  reinterpret_cast<RTCRay*>(arguments.ray)->tfar = -std::numeric_limits<float>::infinity();
}

template <class Real>
void hide_packet(const RTCOccludedFunctionNArguments& arguments) {
  const auto& rays = *reinterpret_cast<const Rays<Real, lanes>*>(arguments.context);
  alignas(64) Real found[lanes];
  alignas(64) int stopped[lanes];
  if (!stopped_lanes(rays, ball_of<Real, lanes>(arguments), arguments.valid, found, stopped)) return;
  replace(reinterpret_cast<RTCRay16*>(arguments.ray)->tfar, stopped, -std::numeric_limits<float>::infinity());
}

template <class Real>
void hide(const RTCOccludedFunctionNArguments* arguments) {
  arguments->N == 1 ? hide_one<Real>(*arguments) : hide_packet<Real>(*arguments);
}

template <class Real>
void bound(const RTCBoundsFunctionArguments* arguments) {
  const Equation<Real>& ball =
      static_cast<const Equation<Real>*>(arguments->geometryUserPtr)[arguments->primID];
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const Real radius = std::sqrt(ball.radius_squared);
  const auto low = [&](int axis) {
    return std::nextafter(static_cast<float>(ball.center[axis] - radius), -infinity);
  };
  const auto high = [&](int axis) {
    return std::nextafter(static_cast<float>(ball.center[axis] + radius), infinity);
  };
  *arguments->bounds_o = {low(0), low(1), low(2), 0, high(0), high(1), high(2), 0};
}

/// Embree 3 takes a context, Embree 4 arguments that hold one.
struct Call {
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments intersect;
  RTCOccludedArguments occlude;
#endif
  Context* context;

  Call(Context& with, Flow flow) : context(&with) {
#if RTC_VERSION_MAJOR >= 4
    const auto flags = flow == Flow::coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
    rtcInitRayQueryContext(context);
    rtcInitIntersectArguments(&intersect);
    rtcInitOccludedArguments(&occlude);
    intersect.context = occlude.context = context;
    intersect.flags = occlude.flags = flags;
#else
    rtcInitIntersectContext(context);
    context->flags =
        flow == Flow::coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
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

alignas(64) constexpr int all_valid[lanes] = {-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};

}  // namespace

class BareEmbree::World {
 public:
  World(std::span<const Ball> balls, Stand stand)
      : stand_(stand), device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    const RTCGeometry geometry = make(balls);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) throw std::runtime_error("Embree refuses the spheres");
  }
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

  /// Whether t is to be taken from our own ray, which has all its digits, and not from Embree's.
  bool has_callbacks() const { return stand_ == Stand::double_callback || stand_ == Stand::float_callback; }
  RTCScene scene() const { return scene_; }

 private:
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

  /// One in each ball's middle, across the z axis, with corners on the ball.
  RTCGeometry triangles(std::span<const Ball> balls) {
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * balls.size()));
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
        answers[i + lane] = {t, ray_hit.hit.geomID[lane] == no_id ? no_id : ray_hit.hit.primID[lane]};
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
