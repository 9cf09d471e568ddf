// Embree 3 and 4 differ in a few names, which are made alike here.
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

inline RTCIntersectArguments arguments_with(EmbreeContext& context) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  return arguments;
}

inline void embree_intersect(RTCScene scene, EmbreeContext& context, RTCRayHit& ray_hit) {
  RTCIntersectArguments arguments = arguments_with(context);
  rtcIntersect1(scene, &ray_hit, &arguments);
}
inline void embree_occluded(RTCScene scene, EmbreeContext& context, RTCRay& ray) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context;
  rtcOccluded1(scene, &ray, &arguments);
}

/// Traverses the tree with rays that have nearly the same direction.
inline void embree_intersect(RTCScene scene, EmbreeContext& context, const int* valid,
                             RTCRayHit8& ray_hits) {
  RTCIntersectArguments arguments = arguments_with(context);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect8(valid, scene, &ray_hits, &arguments);
}
inline void embree_intersect(RTCScene scene, EmbreeContext& context, const int* valid,
                             RTCRayHit16& ray_hits) {
  RTCIntersectArguments arguments = arguments_with(context);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &ray_hits, &arguments);
}

#else

using EmbreeContext = RTCIntersectContext;

inline void init_context(EmbreeContext& context) {
  rtcInitIntersectContext(&context);
}

inline void embree_intersect(RTCScene scene, EmbreeContext& context, RTCRayHit& ray_hit) {
  rtcIntersect1(scene, &context, &ray_hit);
}
inline void embree_occluded(RTCScene scene, EmbreeContext& context, RTCRay& ray) {
  rtcOccluded1(scene, &context, &ray);
}

/// Traverses the tree with rays that have nearly the same direction.
inline void embree_intersect(RTCScene scene, EmbreeContext& context, const int* valid,
                             RTCRayHit8& ray_hits) {
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(valid, scene, &context, &ray_hits);
}
inline void embree_intersect(RTCScene scene, EmbreeContext& context, const int* valid,
                             RTCRayHit16& ray_hits) {
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &context, &ray_hits);
}

#endif

}  // namespace crt::core
