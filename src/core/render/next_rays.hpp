// The rays of the next round: mirrored and refracted ones, and those that have waited.
#pragma once

#include "core/render/path_hits.hpp"

namespace crt::core {

/// Fills `next` with one ray for each sample that has one left. That is the last of the mirrored
/// and refracted rays that surfaces send on, unless these are too deep or of too little weight.
/// Others wait on the samples' stacks until no ray is sent on.
void next_rays(TraceContext& context, const PathRays& rays, const PathHits& hits,
               const Surfaces& surfaces, PathRays& next);

}  // namespace crt::core
