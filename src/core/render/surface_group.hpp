// Surfaces side by side: what light needs to know of them, by component.
#pragma once

#include "core/shading/phong.hpp"

namespace crt::core {

/// As many surfaces as there are lanes. What lanes hold where a ray has met none is of no use, but finite.
struct SurfaceGroup {
  VectorLanes position;
  VectorLanes face_normal;  ///< of the geometry, turned to the viewer
  PhongSurfaces phong;      ///< its normal is that tilted by bumps
  Lanes path_length{};      ///< from the camera
  VectorLanes light;        ///< that they send back, as far as it has been added up
};

/// One of them.
struct SurfaceLane {
  SurfaceGroup& group;
  std::size_t lane;

  Vec3 normal() const { return group.phong.normal[lane]; }
  Vec3 face_normal() const { return group.face_normal[lane]; }
  Rgb color() const { return group.phong.color[lane]; }
  Rgb light() const { return group.light[lane]; }
};

}  // namespace crt::core
