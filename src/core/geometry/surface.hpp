#pragma once

#include <array>
#include <cstdint>

#include "crt/vec.hpp"

namespace crt::core {

enum class SurfaceKind : std::uint8_t {
  plane,
  sphere,
  cylinder,
  cone,
  torus,
  quadric,
  rounding,
  field,
  custom
};

/// A Surface is the whole surface that a face is a piece of, in object space. Equal surfaces of one
/// kind have equal parameters, but for planes. One plane has many positions and normals, so planes
/// are compared by their equations (compile/surface_table.cpp).
struct Surface {
  SurfaceKind kind = SurfaceKind::plane;
  /// This is a point of the plane, the centre, or a point of the axis (of a cone the apex).
  Vec3 position{0, 0, 0};
  /// This is a plane's normal out of the face, of any length, or an axis (see canonical_axis), or 0
  /// where there is none.
  Vec3 direction{0, 0, 0};
  /// These are radii, thickness, or slope, or what tells fields and custom shapes apart. A quadric,
  /// whose position is the origin, has all its numbers but the squares here. The squares are in
  /// place of the direction. A rounding, which is a round face of a rounded box, has its radius and
  /// the number of the face here. Its position and direction are the box's lower corner and size.
  std::array<double, 8> sizes{};
  /// The face's normal points into what the round surface encloses. A plane has its `direction`.
  bool is_hollow = false;
};

}  // namespace crt::core
