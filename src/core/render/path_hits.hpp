// These steps of the loop find what the rays of a round meet, and what of it is seen.
#pragma once

#include "core/render/path_rays.hpp"
#include "core/render/surface_group.hpp"
#include "core/render/trace_context.hpp"

namespace crt::core {

/// PathHits are where the rays of a round end.
struct PathHits {
  std::array<RayHit, packet_size> hits;
  RayMask found = 0;     ///< rays that have met a surface
  RayMask seen = 0;      ///< rays from whose ends light gets through
  RayMask on_light = 0;  ///< rays that have met a light which is seen itself
  std::array<std::uint32_t, packet_size> lights;  ///< its number in Frame::lights()

  RayMask on_surface() const { return found & seen; }
  RayMask on_background() const { return seen & ~(found | on_light); }
};

/// Finds what the rays meet first. Where several objects have surfaces at that place, the hit is of
/// the one that lets the least light through, of equal ones the one that was written first.
PathHits& intersect(TraceContext& context, const PathRays& rays, PathHits& hits);

/// Calls f(number, group, lanes, t) for each light that is seen itself and that some of the rays
/// meet at t, before what they have met so far.
template <class F>
void for_each_light_met(const TraceContext& context, const PathRays& rays, RayMask some,
                        const PathHits& hits, F&& f) {
  const std::vector<PreparedLight>& lights = context.frame.lights();
  for (std::uint32_t number = 0; number < lights.size(); ++number) {
    if (!lights[number].is_visible()) continue;
    RayPacket::for_each_group(some, [&](std::size_t group, RayMask lanes) {
      const LightMet light = lights[number].meet(rays.batch.lines[group]);
      const RayHit* const first = &hits.hits[group * lane_count];
      const Lanes ends([first](auto lane) { return first[lane].t; });
      if (const RayMask met = lanes & mask_of(light.met & (light.t < ends)); met != 0)
        f(number, group, met, light.t);
    });
  }
}

/// Ends rays at lights that are seen themselves, where these are nearer than what the rays meet.
/// Those whose directions were drawn go on, as light does: a light is in nobody's way.
void meet_lights(const TraceContext& context, const PathRays& rays, PathHits& hits);

/// Returns what is left of a ray's weight after a way of length t through the medium around it.
Rgb weight_after(const TraceContext& context, const PathRays& rays, std::size_t i, double t);

/// Takes from the rays' weights what the media around them absorb on the way to their hits. The
/// hits of those of which nothing is left are not seen.
void absorb(const TraceContext& context, PathRays& rays, PathHits& hits);

/// Looks up the surfaces that are seen, and the others too if they are asked for.
const Surfaces& surfaces_of(TraceContext& context, const PathRays& rays, const PathHits& hits,
                            bool with_unseen, Surfaces& surfaces);

}  // namespace crt::core
