// A hit with its material looked up: all that light needs to know of the place.
#pragma once

#include "core/render/workspace.hpp"
#include "core/shading/phong.hpp"

namespace crt::core {

struct SurfaceHit {
  HitPoint point;
  const PreparedMaterial* material = nullptr;
  double transparency = 0;
  Vec3 face_normal{0, 1, 0};  ///< of the geometry, turned to the viewer
  PhongSurface phong;         ///< its normal is that tilted by bumps
  StartPoint start;           ///< of rays that leave to the viewer's side

  /// Of rays that go on behind the surface.
  StartPoint start_behind() const {
    StartPoint behind = start;
    behind.side = opposite(start.side);
    return behind;
  }
};

/// Looks up the place where `ray` hits, with the material's colour and bumps there.
void look_up(const PreparedData& data, const WorldRay& ray, const RayHit& hit, Workspace& work,
             SurfaceHit& surface);

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
