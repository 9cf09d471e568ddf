// These tables of the schema are those of primitives, a row a field (see crt/schema.hpp).
#pragma once

#include <crt/ellipsoid.hpp>
#include <crt/helix.hpp>
#include <crt/polyhedron.hpp>
#include <crt/primitives.hpp>
#include <crt/schema.hpp>
#include <crt/shaped_extrusion.hpp>
#include <crt/sweep.hpp>
#include <crt/thread.hpp>
#include <variant>

/// @cond tables
namespace crt::schema {

/// Each primitive has this row last.
template <class Primitive>
inline constexpr auto material = field("material", &Primitive::material, any,
                                       {.default_text = "a grey of 0.5"}, "");

template <>
inline constexpr auto table<Sphere> = Table{
    "Sphere",
    field("center", &Sphere::center, point, required, ""),
    field("radius", &Sphere::radius, length, required, "at least 0"),
    material<Sphere>,
};

template <>
inline constexpr auto table<Box> = Table{
    "Box",
    field("corner_a", &Box::corner_a, point, required, "any corner"),
    field("corner_b", &Box::corner_b, opposite_to("corner_a"), required, "the opposite one"),
    material<Box>,
};

template <>
inline constexpr auto table<Plane> = Table{
    "Plane",
    field("normal", &Plane::normal, direction, required,
          "points out of the solid; of any length but 0"),
    field("position", &Plane::position, point, required, "a point on the plane"),
    material<Plane>,
};

template <>
inline constexpr auto table<HalfPlane> = Table{
    "HalfPlane",
    field("normal", &HalfPlane::normal, direction, required, "of any length but 0"),
    field("position", &HalfPlane::position, point, required, "a point on the line"),
    field("direction", &HalfPlane::direction, direction, required,
          "the side of the line; not parallel to the normal"),
    material<HalfPlane>,
};

template <>
inline constexpr auto table<Cylinder> = Table{
    "Cylinder",
    field("from", &Cylinder::from, point, {.required = true, .c = "start"},
          "the centre of one end"),
    field("to", &Cylinder::to, apart_from("from"), {.required = true, .c = "end"},
          "the centre of the other"),
    field("radius", &Cylinder::radius, length, required, "at least 0"),
    material<Cylinder>,
};

template <>
inline constexpr auto table<Cone> = Table{
    "Cone",
    field("from", &Cone::from, point, {.required = true, .c = "start"}, "the centre of one end"),
    field("to", &Cone::to, apart_from("from"), {.required = true, .c = "end"},
          "the centre of the other, or the tip"),
    field("radius", &Cone::radius, length, required, "at `from`, at least 0"),
    field("radius2", &Cone::radius2, length_or_zero, {}, "at `to`, at least 0"),
    material<Cone>,
};

template <>
inline constexpr auto table<Capsule> = Table{
    "Capsule",
    field("from", &Capsule::from, point, {.required = true, .c = "start"},
          "the centre of one half sphere"),
    field("to", &Capsule::to, apart_from("from"), {.required = true, .c = "end"},
          "the centre of the other; at least 1e-100 from `from`"),
    field("radius", &Capsule::radius, length, required, "at least 0"),
    material<Capsule>,
};

template <>
inline constexpr auto table<Torus> = Table{
    "Torus",
    field("center", &Torus::center, point, required, ""),
    field("axis", &Torus::axis, direction, required, "across the ring; of any length but 0"),
    field("radius", &Torus::radius, length, required,
          "from the center to the middle of the tube, at least 0"),
    field("thickness", &Torus::thickness, length, required, "the radius of the tube, at least 0"),
    material<Torus>,
};

template <>
inline constexpr auto table<Disc> = Table{
    "Disc",
    field("center", &Disc::center, point, required, ""),
    field("normal", &Disc::normal, direction, required, "of any length but 0"),
    field("radius", &Disc::radius, length, required, "at least 0"),
    material<Disc>,
};

template <>
inline constexpr auto table<Triangle> = Table{
    "Triangle",
    field("a", &Triangle::a, point, required, "a corner"),
    field("b", &Triangle::b, point, required, "a corner"),
    field("c", &Triangle::c, point, required, "a corner; the three are not on a line"),
    material<Triangle>,
};

template <>
inline constexpr auto table<Mesh> = Table{
    "Mesh",
    field("triangles", &Mesh::triangles, made_by("mesh_triangles"), {.in_scripts = false}, ""),
    material<Mesh>,
};

template <>
inline constexpr auto table<Extrusion> = Table{
    "Extrusion",
    field("profile", &Extrusion::profile, made_by("make_profile"), required,
          "one contour, or a List of several"),
    field("from", &Extrusion::from, any, {.in_scripts = false}, ""),
    field("to", &Extrusion::to, any, {.required = true, .script = "height"},
          "how far along z, also below 0"),
    material<Extrusion>,
};

template <>
inline constexpr auto table<Revolution> = Table{
    "Revolution",
    field("profile", &Revolution::profile, made_by("make_profile"), required,
          "as for an [Extrusion](#extrusion), nowhere at x < 0"),
    field("angle", &Revolution::angle, any,
          {.degrees = "must be greater than 0 and at most 360 degrees"},
          "degrees, greater than 0 and at most 360"),
    material<Revolution>,
};

template <>
inline constexpr auto table<HeightField> = Table{
    "HeightField",
    field("heights", &HeightField::heights, made_by("make_height_grid"), required, ""),
    field("corner_a", &HeightField::corner_a, point, required, "any corner of the box"),
    field("corner_b", &HeightField::corner_b, opposite_to("corner_a"), required,
          "the opposite corner"),
    material<HeightField>,
};

template <>
inline constexpr auto table<Quadric> = Table{
    "Quadric",
    field("squares", &Quadric::squares, any, required, "the numbers of x^2, y^2 and z^2"),
    field("products", &Quadric::products, any, {}, "the numbers of x y, x z and y z"),
    field("linear", &Quadric::linear, any, {}, "the numbers of x, y and z"),
    field("constant", &Quadric::constant, any, required, ""),
    material<Quadric>,
};

template <>
inline constexpr auto table<RoundedBox> = Table{
    "RoundedBox",
    field("corner_a", &RoundedBox::corner_a, point, required, "any corner"),
    field("corner_b", &RoundedBox::corner_b, opposite_to("corner_a"), required, "the opposite one"),
    field("radius", &RoundedBox::radius, length_or_zero, required,
          "at least 0, at most half of the shortest side"),
    material<RoundedBox>,
};

template <>
inline constexpr auto table<Implicit> = Table{
    "Implicit",
    field("field", &Implicit::field, any, required, "see below"),
    field("lower", &Implicit::lower, point, required,
          "the corner of the box with the least x, y and z"),
    field("upper", &Implicit::upper, point, required, "the opposite corner"),
    material<Implicit>,
};

template <>
inline constexpr auto table<Custom> = Table{
    "Custom",
    field("shape", &Custom::shape, any, {.in_scripts = false}, ""),
    material<Custom>,
};

// ---- solids that are made of other ones --------------------------------------------------

template <>
inline constexpr auto table<Ellipsoid> = Table{
    "Ellipsoid",
    field("center", &Ellipsoid::center, point, required, ""),
    field("radii", &Ellipsoid::radii, length, required, "along x, y and z, each at least 0"),
    material<Ellipsoid>,
};

template <>
inline constexpr auto table<ShapedExtrusion> = Table{
    "ShapedExtrusion",
    field("profile", &ShapedExtrusion::profile, made_by("make_profile"), required,
          "as for an [Extrusion](#extrusion), without touching"),
    field("height", &ShapedExtrusion::height, length, required, "along z, at least 0"),
    field("twist", &ShapedExtrusion::twist, any, {.degrees = "must be at most 360000 degrees"},
          "degrees by which the upper end is turned, from x to y"),
    field("taper", &ShapedExtrusion::taper, any, {},
          "how many times as large the upper end is, 0.001 to 1000"),
    field("bevel", &ShapedExtrusion::bevel, length_or_zero, {},
          "how far edges at the ends are cut off, at 45 degrees"),
    field("rounding", &ShapedExtrusion::rounding, length_or_zero, {},
          "the radius of edges that are rounded instead"),
    material<ShapedExtrusion>,
};

template <>
inline constexpr auto table<Sweep> = Table{
    "Sweep",
    field("profile", &Sweep::profile, made_by("make_profile"), required,
          "as for an [Extrusion](#extrusion), about the path"),
    field("path", &Sweep::path, any, required,
          "points that are joined by straight lines, at least 2"),
    field("bend", &Sweep::bend, length_or_zero, {},
          "the radius of arcs at points in between; 0 is a mitre"),
    field("up", &Sweep::up, direction, {}, "where y of the profile points at first; else z or x"),
    field("closed", &Sweep::closed, any, {}, "leads back from the last point to the first"),
    material<Sweep>,
};

template <>
inline constexpr auto table<Tube> = Table{
    "Tube",
    field("path", &Tube::path, any, required, "points, at least 2"),
    field("radii", &Tube::radii, any, required, "the radius at each point, or one; 0 is a tip"),
    field("smooth", &Tube::smooth, any, {}, "lets the path be a curve through its points"),
    field("closed", &Tube::closed, any, {}, "leads back from the last point to the first"),
    field("deviation", &Tube::deviation, length_or_zero, {.default_text = "a 1000th of the radius"},
          "how far the pieces of a curve may be off"),
    material<Tube>,
};

template <>
inline constexpr auto table<Thread> = Table{
    "Thread",
    field("from", &Thread::from, point, {.required = true, .c = "start"}, "the centre of one end"),
    field("to", &Thread::to, apart_from("from"), {.required = true, .c = "end"},
          "the centre of the other"),
    field("diameter", &Thread::diameter, length, required, "of the crests, at least 0"),
    field("pitch", &Thread::pitch, length, required,
          "how far a turn leads, from a 10000th of the length to 0.9 diameters"),
    field("left", &Thread::left, any, {}, "turns the other way"),
    material<Thread>,
};

template <>
inline constexpr auto table<Helix> = Table{
    "Helix",
    field("from", &Helix::from, point, {.required = true, .c = "start"},
          "where the line that it winds about begins"),
    field("to", &Helix::to, apart_from("from"), {.required = true, .c = "end"}, "where that ends"),
    field("radius", &Helix::radius, length, required, "from the line to the middle of the wire"),
    field("thickness", &Helix::thickness, length, required,
          "the wire's radius, at most 0.9 of `radius`"),
    field("pitch", &Helix::pitch, length, required, "how far a turn leads"),
    field("left", &Helix::left, any, {}, "winds the other way than a common screw"),
    material<Helix>,
};

template <>
inline constexpr auto table<Polyhedron> = Table{
    "Polyhedron",
    field("points", &Polyhedron::points, any, required, "the corners"),
    field("faces", &Polyhedron::faces, any, required,
          "the corners of each, by their places from 0"),
    material<Polyhedron>,
};

template <>
inline constexpr auto table<Hull> = Table{
    "Hull",
    field("points", &Hull::points, any, required, "at least four that are not in one plane"),
    material<Hull>,
};

/// Lists them all.
using MadeSolids =
    std::variant<Ellipsoid, ShapedExtrusion, Sweep, Tube, Thread, Helix, Polyhedron, Hull>;

}  // namespace crt::schema
/// @endcond
