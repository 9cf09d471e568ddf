#pragma once

#include <array>
#include <cstdint>

#include "crt/vec.hpp"

namespace crt::core {

enum class SurfaceKind : std::uint8_t { plane, sphere, cylinder, cone, torus };

/// The whole surface that a face is a piece of, in object space. Equal surfaces of one kind have
/// equal parameters, but for planes: those are compared by their equations
/// (scene/surface_table.cpp), as one plane has many positions and normals.
struct Surface {
  SurfaceKind kind = SurfaceKind::plane;
  /// A point of the plane; the centre; a point of the axis (of a cone the apex).
  Vec3 position{0, 0, 0};
  /// A plane's normal out of the face, any length; an axis (see canonical_axis); 0 where there is
  /// none.
  Vec3 direction{0, 0, 0};
  std::array<double, 2> sizes{0, 0};  ///< radii, thickness, or slope
};

}  // namespace crt::core
