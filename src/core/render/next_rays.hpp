// The rays of the next round: mirrored and refracted ones, and those that have waited.
#pragma once

#include "core/render/path_hits.hpp"

namespace crt::core {

/// Fills `next` with one ray for each sample that has one left. Surfaces put mirrored and refracted
/// rays onto the samples' stacks, unless these are too deep or of too little weight. Then each
/// sample takes the last ray from its stack.
void next_rays(TraceContext& context, const PathRays& rays, const PathHits& hits,
               const Surfaces& surfaces, PathRays& next);

}  // namespace crt::core
