// The primitive shapes, as plain values that read like a script:
//   crt::Sphere{.center = {0, 0.5, 0}, .radius = 0.5, .material = red}
// Lengths are in scene units. Coordinates must be finite and at most 1e100 in magnitude, radii
// between 1e-100 and 1e100. Values are checked when an Entity is made of them.
#pragma once

#include <crt/material.hpp>
#include <crt/vec.hpp>
#include <optional>
#include <variant>

namespace crt {

/// All points within `radius` of `center`. (u, v): longitude about y and latitude, both in [0, 1].
struct Sphere {
  Vec3 center{0, 0, 0};
  double radius = 1;
  std::optional<SharedMaterial> material{};
};

/// An axis-parallel box between any two opposite corners, which must differ by at least 1e-100 in
/// every coordinate. (u, v): across each face, in [0, 1].
struct Box {
  Vec3 corner_a{-1, -1, -1};
  Vec3 corner_b{1, 1, 1};
  std::optional<SharedMaterial> material{};
};

/// The half-space behind a plane: `normal` (any length but 0) points out of the solid.
/// (u, v): scene units from `position` along two directions in the plane.
struct Plane {
  Vec3 normal{0, 1, 0};
  Vec3 position{0, 0, 0};
  std::optional<SharedMaterial> material{};
};

/// A surface: the half of the plane through `position` across `normal` that lies on the `direction`
/// side of the line through `position`, within the plane, across `direction`.
struct HalfPlane {
  Vec3 normal{0, 1, 0};
  Vec3 position{0, 0, 0};
  /// Must not be parallel to `normal`; what of it is across the normal counts.
  Vec3 direction{1, 0, 0};
  std::optional<SharedMaterial> material{};
};

/// A solid cylinder between the centres of its two caps, at least 1e-100 apart. (u, v): angle about
/// the axis and height on the side, both in [0, 1]; angle and distance from the axis on the caps.
struct Cylinder {
  Vec3 from{0, 0, 0};
  Vec3 to{0, 1, 0};
  double radius = 1;
  std::optional<SharedMaterial> material{};
};

/// A solid cone or frustum: `radius` at `from`, `radius2` (0 or more: 0 is a point) at `to`, at
/// least 1e-100 from there. (u, v) as for the cylinder. Equal radii are legal.
struct Cone {
  Vec3 from{0, 0, 0};
  Vec3 to{0, 1, 0};
  double radius = 1;
  double radius2 = 0;
  std::optional<SharedMaterial> material{};
};

/// All points within `thickness` of the circle of the given `radius` about `center` across `axis`:
/// a ring (thickness < radius), a horn (equal) or a spindle torus (larger; it has no hole and no
/// hollow inside). (u, v): angle about the axis and about the ring, both in [0, 1].
struct Torus {
  Vec3 center{0, 0, 0};
  Vec3 axis{0, 1, 0};
  double radius = 1;
  double thickness = 0.25;
  std::optional<SharedMaterial> material{};
};

/// A surface: the flat disc about `center` across `normal`. (u, v): angle and distance, in [0, 1].
struct Disc {
  Vec3 center{0, 0, 0};
  Vec3 normal{0, 1, 0};
  double radius = 1;
  std::optional<SharedMaterial> material{};
};

/// A surface: a flat triangle, which must have an area; its normal is along (b - a) x (c - a).
/// (u, v): the weights of b and c.
struct Triangle {
  Vec3 a{0, 0, 0};
  Vec3 b{1, 0, 0};
  Vec3 c{0, 1, 0};
  std::optional<SharedMaterial> material{};
};

/// Every primitive there is. A new one is added here; nothing else lists them all.
using Primitive =
    std::variant<Sphere, Box, Plane, HalfPlane, Cylinder, Cone, Torus, Disc, Triangle>;

}  // namespace crt
