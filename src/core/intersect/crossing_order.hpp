// The crossings of one ray with several objects are put into order here.
#pragma once

#include <cstdint>
#include <vector>

#include "core/compile/compile.hpp"
#include "core/intersect/ray_workspace.hpp"

namespace crt::core {

/// Returns the reach of the place of a crossing (csg/one_place.hpp).
double reach_of_place(const CompiledScene& scene, const WorldRay& ray, const RayHit& hit);

/// Puts the crossings of a ray into order. They come object after object, each object's in its own
/// order, which they keep. Those of one surface get one t if objects `share_surfaces`. Where solids
/// touch, those that are left come before those that are entered. Crossings have one (t, t_low) if
/// and only if they are at one place. In the exact tier the order is exact. There only the rounding
/// of the ray's start may decide otherwise.
void sort_crossings(const CompiledScene& scene, const WorldRay& ray, bool share_surfaces,
                    std::vector<RayHit>& crossings, RayWorkspace& work);

}  // namespace crt::core
