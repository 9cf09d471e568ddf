// This looks behind transparent surfaces, for the rays that go on through them.
#pragma once

#include "core/render/path_hits.hpp"

namespace crt::core {

/// Behind a group of surfaces are these media, and so much of the light from there gets through.
struct Behind {
  Lanes transparency{};  ///< where it is 0, the rest means nothing
  VectorLanes color;
  Lanes index_before = lanes_of(1);  ///< refractive indices
  Lanes index_behind = lanes_of(1);
  std::array<MediaLists::List, lane_count> media{};
};

/// Looks behind some of a group of surfaces. Makes the lists of the media there.
Behind behind_surfaces(TraceContext& context, const PathRays& rays, const PathHits& hits,
                       const Surfaces& surfaces, std::size_t group, RayMask lanes);

}  // namespace crt::core
