// The surface of a solid as triangles, for printers and other programs.
#pragma once

#include <array>
#include <crt/measure.hpp>
#include <cstdint>
#include <limits>
#include <vector>

namespace crt {

/// A SurfaceMesh is closed: at each edge of a triangle lies one other, which has it the other way.
struct SurfaceMesh {
  std::vector<Vec3> positions;  ///< of corners
  /// Their places in `positions`, counter-clockwise as seen from outside.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// Each point of the solid's surface is surely within this distance of a triangle, and each point
  /// of a triangle within it of the surface. It is infinite if that is not proved.
  double deviation = std::numeric_limits<double>::infinity();
};

/// Makes a mesh of a solid's surface that is nowhere farther from it than the deviation, which is
/// in scene units and above 0. Corners of triangles lie on the surface, and sharp edges of the
/// solid are edges of triangles, but for rounding. Of the options the width is not used. The mesh
/// is the same, to the last bit, for any number of threads and on any machine, unless time ends the
/// search. That also ends after about two million cells. Then the mesh is as good as it is, and its
/// deviation infinite. So it is where surfaces touch without crossing, or a wall is thinner than
/// the deviation, as far as no cell tells its sides apart. Throws Error as volume() does.
SurfaceMesh tessellate(const Entity& entity, double deviation, const MeasureOptions& options = {});

}  // namespace crt
