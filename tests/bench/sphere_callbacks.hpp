// Embree calls these functions for a sphere: bounds, the nearest hit and any hit, for one ray and
// for 16 at a time, in float and in double.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <cmath>
#include <limits>

namespace crt::bench {

constexpr unsigned lanes = 16;

#if RTC_VERSION_MAJOR >= 4
using Context = RTCRayQueryContext;
#else
using Context = RTCIntersectContext;
#endif

/// An Equation is a sphere as the callbacks have it.
template <class Real>
struct Equation {
  Real center[3];
  Real radius_squared;
};

/// Holds the rays of a call with all their digits, which Embree hands to the callbacks. N is 1 or
/// 16.
template <class Real, unsigned N>
struct Rays {
  Context context;  // first: callbacks get its address
  alignas(64) Real origin[3][N];
  Real direction[3][N];
  Real t_min[N];
  Real t[N];  ///< the nearest so far
};

/// Returns the nearest crossing of one lane beyond its t_min, or what is nearest already.
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

/// Finds the lanes whose rays the ball stops, 1 or 0 for each. Returns false if there are none.
/// Loops over lanes here and below are written so that they become vector code.
template <class Real>
bool stopped_lanes(const Rays<Real, lanes>& rays, const Equation<Real>& ball, const int* valid,
                   Real (&found)[lanes], int (&stopped)[lanes]) {
  int any = 0;
  for (unsigned lane = 0; lane < lanes; ++lane) found[lane] = nearest_crossing(rays, ball, lane);
  for (unsigned lane = 0; lane < lanes; ++lane)
    stopped[lane] = found[lane] < rays.t[lane] ? -valid[lane] : 0;
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
  for (unsigned lane = 0; lane < lanes; ++lane)
    numbers[lane] = where[lane] != 0 ? by : numbers[lane];
}

template <class Real>
void meet_packet(const RTCIntersectFunctionNArguments& arguments) {
  auto& rays = *reinterpret_cast<Rays<Real, lanes>*>(arguments.context);
  alignas(64) Real found[lanes];
  alignas(64) int stopped[lanes];
  if (!stopped_lanes(rays, ball_of<Real, lanes>(arguments), arguments.valid, found, stopped))
    return;
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
  if (!stopped_lanes(rays, ball_of<Real, lanes>(arguments), arguments.valid, found, stopped))
    return;
  replace(reinterpret_cast<RTCRay16*>(arguments.ray)->tfar, stopped,
          -std::numeric_limits<float>::infinity());
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

}  // namespace crt::bench
