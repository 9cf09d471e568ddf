// The primitive shapes are plain values that read like a script:
//   crt::Sphere{.center = {0, 0.5, 0}, .radius = 0.5, .material = red} Lengths are in scene units.
//   Coordinates must be finite and at most 1e100 in magnitude, radii between 1e-100 and 1e100.
//   Making an Entity of them checks the values.
#pragma once

#include <array>
#include <crt/material.hpp>
#include <crt/vec.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <variant>

namespace crt {

/// A Sphere is all points within `radius` of `center`. (u, v) are longitude about y and latitude,
/// both in [0, 1].
struct Sphere {
  Vec3 center{0, 0, 0};
  double radius = 1;
  std::optional<SharedMaterial> material{};
};

/// A Box is axis-parallel, between any two opposite corners, which must differ by at least 1e-100
/// in every coordinate. (u, v) run across each face, in [0, 1].
struct Box {
  Vec3 corner_a{-1, -1, -1};
  Vec3 corner_b{1, 1, 1};
  std::optional<SharedMaterial> material{};
};

/// A Plane is the half-space behind a plane. `normal` (any length but 0) points out of the solid.
/// (u, v) are scene units from `position` along two directions in the plane.
struct Plane {
  Vec3 normal{0, 1, 0};
  Vec3 position{0, 0, 0};
  std::optional<SharedMaterial> material{};
};

/// A HalfPlane is a surface: the half of the plane through `position` across `normal`. It lies on
/// the `direction` side of the line through `position`, within the plane, across `direction`.
struct HalfPlane {
  Vec3 normal{0, 1, 0};
  Vec3 position{0, 0, 0};
  /// The direction must not be parallel to `normal`. Its part across the normal counts.
  Vec3 direction{1, 0, 0};
  std::optional<SharedMaterial> material{};
};

/// A Cylinder is a solid between the centres of its two caps, at least 1e-100 apart. On the side
/// (u, v) are angle about the axis and height, both in [0, 1]. On the caps they are angle and
/// distance from the axis.
struct Cylinder {
  Vec3 from{0, 0, 0};
  Vec3 to{0, 1, 0};
  double radius = 1;
  std::optional<SharedMaterial> material{};
};

/// A Cone is a solid cone or frustum with `radius` at `from` and `radius2` (0 or more: 0 is a
/// point) at `to`. The two points are at least 1e-100 apart. (u, v) are as for the cylinder. Equal
/// radii are legal.
struct Cone {
  Vec3 from{0, 0, 0};
  Vec3 to{0, 1, 0};
  double radius = 1;
  double radius2 = 0;
  std::optional<SharedMaterial> material{};
};

/// A Capsule is all points within `radius` of the straight line between `from` and `to`, which are
/// at least 1e-100 apart: a cylinder that ends in half spheres. u is the angle about the axis as
/// for the cylinder. v is the way along the surface from the tip beyond `from` to that beyond `to`.
/// Both are in [0, 1].
struct Capsule {
  Vec3 from{0, 0, 0};
  Vec3 to{0, 1, 0};
  double radius = 1;
  std::optional<SharedMaterial> material{};
};

/// A Torus is all points within `thickness` of the circle of the given `radius` about `center`
/// across `axis`. It is a ring (thickness < radius), a horn (equal) or a spindle torus (larger; it
/// has no hole and no hollow inside). (u, v) are the angles about the axis and about the ring, both
/// in [0, 1].
struct Torus {
  Vec3 center{0, 0, 0};
  Vec3 axis{0, 1, 0};
  double radius = 1;
  double thickness = 0.25;
  std::optional<SharedMaterial> material{};
};

/// A Disc is a surface: the flat disc about `center` across `normal`. (u, v) are angle and
/// distance, in [0, 1].
struct Disc {
  Vec3 center{0, 0, 0};
  Vec3 normal{0, 1, 0};
  double radius = 1;
  std::optional<SharedMaterial> material{};
};

/// A Triangle is a flat surface, which must have an area. Its normal is along (b - a) x (c - a).
/// (u, v) are the weights of b and c.
struct Triangle {
  Vec3 a{0, 0, 0};
  Vec3 b{1, 0, 0};
  Vec3 c{0, 1, 0};
  std::optional<SharedMaterial> material{};
};

class MeshTriangles;

/// Names the corners of a triangle of a mesh by their places in the list of positions.
using TriangleIndices = std::array<std::uint32_t, 3>;

/// A Mesh is a solid that triangles enclose, or else a surface: see mesh_triangles(). Copies share
/// the triangles. (u, v) are the weights of a triangle's second and third corner.
struct Mesh {
  std::shared_ptr<const MeshTriangles> triangles{};  ///< from mesh_triangles(); must be given
  std::optional<SharedMaterial> material{};
};

/// Makes triangles with shared corners for meshes. Corners are one if their coordinates are equal,
/// and only then. The triangles enclose a solid if each of their edges belongs to an even number of
/// them. Inside is every point from which a line to infinity crosses an odd number of triangles,
/// however these are turned and wherever they pass through one another. If each edge also runs as
/// often in one direction as in the other, normals are turned out of the solid; all others are
/// along (b - a) x (c - a). Triangles without an area are left out of what rays meet, but count
/// where they fill a gap between edges. It takes O(n log n) on the calling thread. Throws Error
/// (invalid_argument) for an index that is out of range, for coordinates as Triangle does, and if
/// no triangle has an area.
std::shared_ptr<const MeshTriangles> mesh_triangles(std::span<const Vec3> positions,
                                                    std::span<const TriangleIndices> triangles);

/// A Primitive is any of the primitives. A new one is added here; nothing else lists them all.
using Primitive = std::variant<Sphere, Box, Plane, HalfPlane, Cylinder, Cone, Torus, Disc, Triangle,
                               Capsule, Mesh>;

}  // namespace crt
