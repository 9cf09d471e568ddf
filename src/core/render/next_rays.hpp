// The rays of the next round: mirrored and refracted ones, and those that have waited.
#pragma once

#include "core/render/path_hits.hpp"

namespace crt::core {

/// Fills `next` with one ray for each sample that has one left. Surfaces send mirrored and
/// refracted rays on, but for those too deep or of too little weight. Where a surface sends two,
/// the refracted one is followed first and the other waits on its sample's stack. Samples whose
/// path ends take up what waits there last.
PathRays& next_rays(TraceContext& context, const PathRays& rays, const PathHits& hits,
                    const Surfaces& surfaces, PathRays& next);

}  // namespace crt::core
