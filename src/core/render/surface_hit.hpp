// Hits with their materials looked up.
#pragma once

#include "core/render/surface_group.hpp"
#include "core/render/workspace.hpp"

namespace crt::core {

/// Looks up the place where `ray` hits, with the colour and bumps there of the surface's material, which is
/// known already.
void look_up(const PreparedData& data, const WorldRay& ray, const RayHit& hit, Workspace& work,
             const SurfaceLane& surface);

/// The same for those of a group of rays that have their bit in `uniform`, whose materials are. It may write
/// into other lanes, too.
void look_up_uniform(const PreparedData& data, std::span<const WorldRay, lane_count> rays,
                     std::span<const RayHit, lane_count> hits, RayMask uniform, SurfaceGroup& group);

/// What a crossing does to light that goes through it: it lets `transparency` of it pass, times `color`.
struct CrossingFilter {
  double transparency = 0;
  Rgb color{0, 0, 0};
};
CrossingFilter crossing_filter(const PreparedData& data, const WorldRay& ray, const RayHit& crossing,
                               RenderStats& stats);

/// The share of light that is left after a way through a medium (Beer-Lambert).
Rgb transmittance(const PreparedMaterial& medium, double length);

}  // namespace crt::core
