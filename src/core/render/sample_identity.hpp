// Identities of samples: those that meet the same things on the same paths have the same one,
// others most likely not. The things are surfaces with the side and the kind of ray that they are
// met by, the background, and shadows of lights.
#pragma once

#include "core/render/path_hits.hpp"

namespace crt::core {

/// Takes what the rays of a round have met into their samples' identities.
void identify_hits(const PreparedData& data, const PathRays& rays, const PathHits& hits,
                   const Surfaces& surfaces);

/// Takes into them that something is on the paths from these rays' surfaces to a light.
void identify_shadows(const PathRays& rays, std::size_t light, RayMask shaded);

}  // namespace crt::core
