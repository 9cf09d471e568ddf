// Sections of solids: what a plane has in common with one, as contours of lines and arcs with a
// stated deviation, and as drawings.
//
// Contours come from the equations of the solid. No triangles are made and no rays are shot. The
// answer is the same for any number of threads and on any machine, unless time ends the search. All
// functions are safe from any number of threads at once.
#pragma once

#include <array>
#include <crt/measure.hpp>
#include <crt/primitives.hpp>
#include <crt/scene.hpp>
#include <crt/settings.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace crt {

/// A SectionFrame says where a drawing of a section is in the world. A point (x, y) of the drawing
/// is origin + x x_axis + y y_axis.
///
/// The drawing is as somebody sees it who looks against the normal: x to the right and y up. y_axis
/// is as near to y of the world as can be, and for a plane across y it is z for a normal upwards,
/// and -z for one downwards. The world is left-handed, so x_axis is normal x y_axis.
struct SectionFrame {
  Vec3 origin{0, 0, 0};  ///< the point of the plane that is nearest to the origin
  Vec3 x_axis{1, 0, 0};
  Vec3 y_axis{0, 1, 0};
  Vec3 normal{0, 0, -1};  ///< of length 1
  double offset = 0;      ///< the plane is {p : normal . p = offset}

  /// Returns a point of the drawing in the world.
  Vec3 at(double x, double y) const { return origin + x * x_axis + y * y_axis; }
};

/// A Section is what a plane cuts out of a solid.
struct Section {
  SectionFrame frame{};
  /// Has closed lines of straight pieces and arcs in the coordinates of the drawing, as profiles
  /// have them. Outer ones go counterclockwise, and holes clockwise, so the solid is on the left.
  /// The one that encloses most comes first. make_profile() takes them. Where two are nearer to
  /// each other than the deviation, they may cross.
  std::vector<Contour> contours{};
  /// Proves how well they are known: each point of the true boundary is within this distance of the
  /// contours, and each of their points is within it of the true boundary. It is what was asked for
  /// or less, unless time or a limit ended the search. It is infinite if there may be a part of the
  /// section of which no contour is known, as where a plane merely touches a cylinder. Parts and
  /// holes that are smaller than 2^-36 times the box around the solid do not count.
  double deviation = 0;
  Interval area{};  ///< that of the section surely is in it, in squared scene units
  /// Has the corners of a box in the drawing that holds the contours. Nothing of the section is
  /// farther outside than the deviation. Both are 0 if there is no contour.
  std::array<double, 2> lower{};
  std::array<double, 2> upper{};

  /// Returns whether the plane cuts nothing out of the solid.
  bool empty() const { return contours.empty(); }
};

/// Cuts a solid by the plane {p : normal . p / |normal| = offset}, offset in scene units.
///
/// The contours stay within `deviation` (scene units, above 0) of the true boundary, and have as
/// few lines and arcs as that allows. Straight edges and circles that are just that come out as
/// such: a circle as two arcs. `relative_width` of the options is that of the area.
///
/// A plane that just coincides with a face of the solid cuts what is on the far side of the normal,
/// as close to the plane as can be: that with normal z at the top of a box has the whole box, and
/// at its bottom nothing. There the plane is moved against its normal by 2^-32 of half of the
/// longest side of the box around the solid. So it is where the plane touches the solid, or where
/// an edge lies in it, if more is known then. The frame says where it is in the end. A plane that
/// is not across a coordinate axis is one of the solid turned, which is rounded to about 1e-15 of
/// its coordinates.
///
/// The search ends after 2^16 cells for each part of the solid that is apart from others. Throws
/// Error (invalid_argument) for a normal of no length, numbers that are not finite, a deviation
/// that is not above 0, and for what has no inside or no bounds; else as the other measures do. Of
/// Custom solids nothing is known but their box, so that the deviation is infinite.
Section section(const Entity& entity, const Vec3& normal, double offset, double deviation,
                const MeasureOptions& options = {});

/// A SectionPolyline is a contour as points in the world, without the first again at the end.
using SectionPolyline = std::vector<Vec3>;

/// Returns the contours of a section as points, by cutting arcs into chords. The chords are within
/// `deviation` of the arcs, or within the section's own if that is infinite or below 0. For 0 there
/// are as many as the section's own deviation asks for, but at most 2^12 for a half circle.
std::vector<SectionPolyline> section_polylines(const Section& section, double deviation = 0);

/// SectionDrawing says how a section is drawn.
struct SectionDrawing {
  Unit unit = Unit::m;  ///< what a scene unit is
  /// Is the distance of hatching lines, which run at 45 degrees, in scene units. 0 draws none.
  double hatch = 0;
  /// Is the width of the boundary in SVG, in millimetres of the paper.
  double line_width = 0.35;
};

/// Returns a section as an SVG drawing in the unit of the scene, which prints at a scale of 1:1. y
/// of the drawing is up. Throws Error (invalid_argument) for a hatch or line width below 0 or not
/// finite, and (limit) if there would be more than 10^5 hatching lines.
std::string section_svg(const Section& section, const SectionDrawing& drawing = {});

/// Returns a section as an ASCII DXF drawing of version R12: each contour is a closed POLYLINE with
/// bulges on the layer SECTION, and hatching is lines on the layer HATCH. $INSUNITS says the unit.
/// Throws as section_svg() does.
std::string section_dxf(const Section& section, const SectionDrawing& drawing = {});

/// Writes section_svg() or section_dxf() by the ending of the name, .svg or .dxf, as write_file()
/// writes files. Throws Error (unsupported) for any other ending, and (io) if it cannot be written.
void write_section(const std::filesystem::path& path, const Section& section,
                   const SectionDrawing& drawing = {});

/// Finds out, before there is a section, whether write_section() knows the ending of a name. Throws
/// Error (unsupported).
void check_section_name(const std::filesystem::path& path);

/// Returns a scene that is cut open, as its camera would show it by Camera::section_normal. Solids
/// keep what is against the normal, and their ids; what is no solid stays as it is. Each cut has
/// the plain colour of its entity, with lines at 45 degrees that are turned for every other entity
/// that is cut. `hatch` is their distance, as in Camera. Throws Error (invalid_argument) for a
/// normal of no length or numbers that are not finite, and as bounding_box() does.
Scene sectioned(const Scene& scene, const Vec3& normal, double offset, double hatch = 0);

}  // namespace crt
