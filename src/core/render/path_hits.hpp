// What the rays of a round meet, and what of it is seen.
#pragma once

#include "core/render/path_rays.hpp"
#include "core/render/surface_group.hpp"
#include "core/render/trace_context.hpp"

namespace crt::core {

/// Where the rays of a round end, each in one of the masks as long as light from there gets
/// through.
struct PathHits {
  std::array<RayHit, packet_size> hits;
  RayMask on_surface = 0;
  RayMask on_background = 0;

  std::span<const RayHit, lane_count> of_group(std::size_t group) const {
    return std::span(hits).subspan(group * lane_count).first<lane_count>();
  }
};

/// Finds what the rays meet first. Where several objects have surfaces at that place, the hit is of
/// the one that lets the least light through, of equal ones the one that was written first.
PathHits& intersect(TraceContext& context, const PathRays& rays, PathHits& hits);

/// Takes from the rays' weights what the media around them absorb on the way to their hits, and
/// from the masks those of which nothing is left.
void absorb(const TraceContext& context, PathRays& rays, PathHits& hits);

/// Looks up the surfaces that the rays have met.
const Surfaces& surfaces_of(TraceContext& context, const PathRays& rays, const PathHits& hits,
                            Surfaces& surfaces);

}  // namespace crt::core
