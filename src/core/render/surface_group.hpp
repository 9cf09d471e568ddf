// Surfaces that rays meet are kept side by side: what lighting needs to know of them, by component.
#pragma once

#include <array>

#include "core/prepare/prepared_data.hpp"
#include "core/shading/phong.hpp"
#include "core/shading/principled.hpp"

namespace crt::core {

/// A SurfaceGroup has as many surfaces as there are lanes. Lanes whose rays have met none mean
/// nothing.
struct SurfaceGroup {
  /// These are the starts of rays that leave to the viewer's side, but for their errors.
  std::array<StartPoint, lane_count> starts;
  VectorLanes position;
  Lanes start_errors{};     ///< StartPoint::t_error of rays that start there
  VectorLanes face_normal;  ///< of the geometry, turned to the viewer
  PhongSurfaces phong;      ///< its normal is that of shading, also tilted by bumps
  RayMask smooth = 0;       ///< those whose facets have normals for shading
  Lanes horizons{};         ///< ShadingNormal::horizon of these
  Lanes reflectivity{};     ///< of the materials
  Lanes transparency{};
  RayMask sending_on = 0;  ///< those whose materials do not end paths
  Lanes path_length{};     ///< from the camera
  // These are set where Features say that some material is principled, or gives off light. The
  // relative indices are those between the materials and vacuum.
  RayMask principled_rays = 0;  ///< those whose materials are principled
  PrincipledSurface<Lanes> principled;
  VectorLanes emission;
};

/// A SurfaceLane is one surface of a group.
struct SurfaceLane {
  const SurfaceGroup& group;
  std::size_t lane;

  Vec3 position() const { return group.position.lane(lane); }
  Vec3 normal() const { return group.phong.normal.lane(lane); }
  Rgb color() const { return group.phong.color.lane(lane); }
  double transparency() const { return group.transparency[lane]; }
  double path_length() const { return group.path_length[lane]; }

  /// Returns the start of a ray that leaves to the viewer's side.
  StartPoint start() const {
    StartPoint start = group.starts[lane];
    start.t_error = group.start_errors[lane];
    return start;
  }
  /// Returns the start of a ray that continues behind the surface.
  StartPoint start_behind() const {
    StartPoint behind = start();
    behind.side = opposite(behind.side);
    return behind;
  }
};

/// Surfaces are what the rays of a packet meet.
struct Surfaces {
  RayMask rays = 0;  ///< those that meet a surface
  std::array<SurfaceGroup, RayPacket::group_count> groups;

  SurfaceLane of(std::size_t ray) const { return {groups[ray / lane_count], ray % lane_count}; }
};

}  // namespace crt::core
