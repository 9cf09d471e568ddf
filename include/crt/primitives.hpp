// The primitive shapes are plain values that read like a script:
//   crt::Sphere{.center = {0, 0.5, 0}, .radius = 0.5, .material = red} Lengths are in scene units.
//   Coordinates must be finite and at most 1e100 in magnitude, radii between 1e-100 and 1e100.
//   Making an Entity of them checks the values.
#pragma once

#include <array>
#include <crt/custom.hpp>
#include <crt/field.hpp>
#include <crt/material.hpp>
#include <crt/vec.hpp>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <variant>
#include <vector>

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

/// A Mesh is a solid that triangles enclose, or else a surface. Copies share the triangles. (u, v)
/// are the weights of a triangle's second and third corner, or those of its MeshAttributes.
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

/// A ProfilePoint is a corner of a contour. `bulge` says how the contour comes here from the corner
/// before: straight for 0, and otherwise by an arc of a circle through an angle, of which the bulge
/// is the tangent of a quarter. The arc is counterclockwise (from x to y) for a bulge above 0. So 1
/// is a half circle, and sqrt(2) - 1 a quarter of one.
struct ProfilePoint {
  double x = 0;
  double y = 0;
  double bulge = 0;

  friend bool operator==(const ProfilePoint&, const ProfilePoint&) = default;
};

/// A Contour is a closed line. The bulge of its first corner is that of the piece from the last
/// corner back to the first. A last corner that repeats the first is that piece. Any other corner
/// that repeats the one before, with a bulge of 0, does not count.
using Contour = std::vector<ProfilePoint>;

class Profile;

/// Makes a profile: the region that contours enclose by the even-odd rule. A point is in it if a
/// line from it to infinity crosses an odd number of their pieces. So a contour within another is a
/// hole, whichever way round either goes, and contours may cross themselves and each other.
///
/// An arc lies on a circle whose center and radius are doubles, whichever way it goes the same.
/// They are the nearest to those that the corners and the bulge say. But an arc that is a quarter
/// or three quarters of a circle to 2^-48, from one axis to the other, counts as just that, with
/// its center exactly at the coordinates of its corners. What an arc adds to a polygon, or takes
/// away, is the part of its disc beyond the straight line through its corners. If rounding has put
/// the circle beside a corner, that line closes the gap.
///
/// It takes O(n log n) on the calling thread. Throws Error (invalid_argument) naming the contour
/// and the corner (both count from 0) if a number is not finite or above 1e100 in magnitude, if two
/// corners that follow one another are closer than 1e-100 in both coordinates, if a contour
/// encloses no area, and if an arc is so flat, or so small at its place, that doubles cannot say
/// its circle.
std::shared_ptr<const Profile> make_profile(std::span<const Contour> contours);

/// An Extrusion has all points (x, y, z) for which (x, y) is in the profile and z is between `from`
/// and `to`, which differ by at least 1e-100. A straight piece of the profile makes a flat face, an
/// arc a part of a cylinder. Copies share the profile. On the sides u is the way along the contour
/// and v the height above the lower end. On the ends (u, v) run along x and y across the profile's
/// bounds. All are in [0, 1].
struct Extrusion {
  std::shared_ptr<const Profile> profile{};  ///< from make_profile(); must be given
  double from = 0;
  double to = 1;
  std::optional<SharedMaterial> material{};
};

/// A Revolution has all points that a profile passes as it turns about the y axis. x of the profile
/// is the distance from the axis, nowhere below 0, and y the height. It starts towards +z, and
/// turns by `angle` towards +x. Straight pieces that are not level, and corners off the axis, have
/// at least 1e-100 of height or distance. A straight piece makes a part of a plane, a cylinder or a
/// cone. An arc makes a part of a torus, or of a sphere if its center is on the axis to 2^-48 of
/// its radius. Copies share the profile. On the round sides u is the angle as a share of `angle`,
/// and v the way along the contour. On the two flat ends, which are there if `angle` is less than a
/// whole turn, (u, v) run along x and y across the profile's bounds. All are in [0, 1].
struct Revolution {
  std::shared_ptr<const Profile> profile{};  ///< from make_profile(); must be given
  /// The angle is in radians, at least 1e-100 and at most 2 pi, which is a whole turn.
  double angle = 2 * std::numbers::pi;
  std::optional<SharedMaterial> material{};
};

class HeightGrid;

/// This is the largest number of heights that a grid may have.
inline constexpr std::uint64_t most_heights = std::uint64_t{1} << 27;

/// Makes a grid of heights for height fields, of `columns` along x and `rows` along z. heights[row
/// * columns + column] is the height there. A height is a share of a box, from 0 at its lower y to
/// 1 at its upper. It takes O(n) on the calling thread. Throws Error (invalid_argument) naming the
/// column and the row for a height that is not from 0 to 1, if all heights are 0, if there are
/// fewer than 2 columns or rows, or more than most_heights, and for a wrong number of heights.
std::shared_ptr<const HeightGrid> make_height_grid(std::vector<double> heights,
                                                   std::uint32_t columns, std::uint32_t rows);

/// Makes the grid of a picture: a height for each pixel, of which the rows run from upper z, at the
/// top of the picture, to lower z. A height is the mean of red, green and blue as the picture has
/// them. So of a file of 8 or 16 bits it is the stored number as a share of the largest, and
/// gammas do not count. Throws Error (invalid_argument) as the other function does.
std::shared_ptr<const HeightGrid> make_height_grid(const Image& image);

/// A HeightField is a solid in the box between any two opposite corners, which differ by at least
/// 1e-100 in every coordinate. It is below the surface through the heights of a grid, whose first
/// column and row lie at the box's lower x and z, the last ones at the upper. A cell between four
/// heights has two triangles, which meet in the line from its corner at lower x and z to that at
/// upper x and z. A height of 0 is at the bottom, where the solid has no thickness. Copies share
/// the grid. (u, v) run along x and z across the box, or as a Box has them on its sides, in [0, 1].
///
/// The corners of the triangles are doubles. Column i of n + 1 is at the box's lower x plus (i
/// times the width) / n, each step rounded, and the last one at the upper x. Rows are alike. A
/// height h is at the lower y plus h times the box's height, or at the upper y for 1. Where a
/// column or row is not beyond the one before it, there is an Error (invalid_argument).
struct HeightField {
  std::shared_ptr<const HeightGrid> heights{};  ///< from make_height_grid(); must be given
  Vec3 corner_a{-1, 0, -1};
  Vec3 corner_b{1, 1, 1};
  std::optional<SharedMaterial> material{};
};

/// A Quadric has all points (x, y, z) for which
///   squares.x x^2 + squares.y y^2 + squares.z z^2
///   + products.x x y + products.y x z + products.z y z
///   + linear.x x + linear.y y + linear.z z + constant <= 0.
/// So ellipsoids, paraboloids, hyperboloids, cones, cylinders and what is between two planes are
/// quadrics. All but ellipsoids are infinite. The sum must be below 0 at some points and above 0 at
/// others.
///
/// The size of a quadric is the larger of sqrt(|constant| / a) and l / a. Here l is the largest
/// magnitude in `linear`, and a that in `squares` and `products`. If a is 0 the size is |constant|
/// / l, and if all that is 0 it is 1. It must be from 1e-100 to 1e100. In units of this size, no
/// coefficient but 0 may be below 1e-200 of the largest. The coefficients themselves may be any
/// finite numbers. u is the angle about the y axis, from +z towards +x, in [0, 1]. v is y.
struct Quadric {
  Vec3 squares{1, 1, 1};
  Vec3 products{0, 0, 0};  ///< of x y, of x z and of y z
  Vec3 linear{0, 0, 0};
  double constant = -1;
  std::optional<SharedMaterial> material{};
};

/// A RoundedBox is a box whose edges and corners are round: all points within `radius` of an inner
/// box, which is that between the two corners less `radius` on each side. The corners differ by at
/// least 1e-100 in every coordinate. The radius is at most half of the shortest side. One that
/// rounding makes larger, by no more than 2^-50 of the corners' largest coordinate, counts as that
/// half. With a radius of 0 it is a Box. (u, v) are those of a Box between the corners: those of
/// the point that is beside it on the face which its normal is nearest to.
struct RoundedBox {
  Vec3 corner_a{-1, -1, -1};
  Vec3 corner_b{1, 1, 1};
  double radius = 0.25;
  std::optional<SharedMaterial> material{};
};

/// An Implicit has all points between two corners of a box at which a field is at most 0. The
/// corners differ by at least 1e-100 in every coordinate. Where the field has no value is outside.
/// Where a line enters and leaves is proved by interval arithmetic. What that cannot decide within
/// a limit on the work, such as whether a line that grazes enters, is decided by the signs on both
/// sides of the place. RenderStats::undecided counts such rays. (u, v) are those of the box: they
/// run along x and y, in [0, 1], and on the faces of the box as a Box has them.
struct Implicit {
  Field field{};
  Vec3 lower{-1, -1, -1};
  Vec3 upper{1, 1, 1};
  std::optional<SharedMaterial> material{};
};

/// A Custom is a solid of which the program computes what rays cross (crt/custom.hpp). Entities
/// share the shape.
struct Custom {
  std::shared_ptr<const CustomShape> shape{};  ///< must not be null
  std::optional<SharedMaterial> material{};
};

/// A Primitive is any of the primitives. A new one is added here; nothing else lists them all.
using Primitive =
    std::variant<Sphere, Box, Plane, HalfPlane, Cylinder, Cone, Torus, Disc, Triangle, Capsule,
                 Mesh, Extrusion, Revolution, HeightField, Quadric, RoundedBox, Implicit, Custom>;

}  // namespace crt
