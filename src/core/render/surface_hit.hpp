// A hit with its material looked up: all that light needs to know of the place.
#pragma once

#include "core/render/surface_group.hpp"
#include "core/render/workspace.hpp"

namespace crt::core {

struct SurfaceHit {
  const PreparedMaterial* material = nullptr;
  StartPoint start;  ///< of rays that leave to the viewer's side
  // The rest only of surfaces that rays go on from, or that patterns or bumps are on.
  double transparency = 0;
  HitPoint point;

  /// Of rays that go on behind the surface.
  StartPoint start_behind() const {
    StartPoint behind = start;
    behind.side = opposite(start.side);
    return behind;
  }
};

/// Looks up the place where `ray` hits, with the material's colour and bumps there.
void look_up(const PreparedData& data, const WorldRay& ray, const RayHit& hit, Workspace& work,
             SurfaceHit& surface, const SurfaceLane& lit);

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
