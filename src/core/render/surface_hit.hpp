// The materials of hits are looked up here.
#pragma once

#include "core/render/surface_group.hpp"
#include "core/render/workspace.hpp"

namespace crt::core {

/// Looks up the hits of those rays of a group that have their bit in `seen`, with their materials'
/// colours and bumps there.
void look_up(const PreparedData& data, const RayLanes& rays,
             std::span<const RayHit, lane_count> hits, RayMask seen, SurfaceGroup& group,
             Workspace& work);

/// A CrossingFilter is what a crossing does to light that goes through it: it lets `transparency`
/// of it pass, times `color`.
struct CrossingFilter {
  double transparency = 0;
  Rgb color{0, 0, 0};
};
CrossingFilter patterned_filter(const PreparedData& data, const WorldRay& ray,
                                const RayHit& crossing, RenderStats& stats);
inline CrossingFilter crossing_filter(const PreparedData& data, const WorldRay& ray,
                                      const RayHit& crossing, RenderStats& stats) {
  const PreparedMaterial& material = data.materials()[data.hit_material(crossing)];
  if (material.pattern) return patterned_filter(data, ray, crossing, stats);
  return {.transparency = material.transparency(material.color.a), .color = rgb(material.color)};
}

/// Returns the share of light that is left after a path of that length through a medium
/// (Beer-Lambert).
Rgb transmittance(const PreparedMaterial& medium, double length);

}  // namespace crt::core
