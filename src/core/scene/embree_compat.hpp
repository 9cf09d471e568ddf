// The few names that differ between Embree 3 and 4.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace crt::core {

#if RTC_VERSION_MAJOR >= 4

using EmbreeContext = RTCRayQueryContext;

inline void init_context(EmbreeContext& context) {
  rtcInitRayQueryContext(&context);
}

inline void embree_intersect(RTCScene scene, EmbreeContext& context, RTCRayHit& ray_hit) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  rtcIntersect1(scene, &ray_hit, &arguments);
}

#else

using EmbreeContext = RTCIntersectContext;

inline void init_context(EmbreeContext& context) {
  rtcInitIntersectContext(&context);
}

inline void embree_intersect(RTCScene scene, EmbreeContext& context, RTCRayHit& ray_hit) {
  rtcIntersect1(scene, &context, &ray_hit);
}

#endif

}  // namespace crt::core
