// The surface of a solid as triangles, and files of it for other programs: STL, OBJ, PLY, 3MF and
// glTF.
//
// Files have the numbers of the scene (those of glTF are in metres). In most programs space is
// right-handed: they show left and right exchanged, as CRT does with their files. What is to look
// there as in a picture is scaled by (1, 1, -1) before.
#pragma once

#include <array>
#include <crt/color.hpp>
#include <crt/entity.hpp>
#include <crt/measure.hpp>
#include <crt/settings.hpp>
#include <crt/vec.hpp>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace crt {

/// A SurfaceMesh is the surface of a solid as triangles.
struct SurfaceMesh {
  std::vector<Vec3> positions;  ///< the corners, each once, in scene units
  /// Each has the places of its corners a, b and c. The cross product of b - a and c - a points out
  /// of the solid: in a right-handed space they are counter-clockwise from outside.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// Each point of the solid's surface is surely within this distance of a triangle, and each point
  /// of a triangle within it of the surface. It is infinite if that is not proved.
  double deviation = std::numeric_limits<double>::infinity();
};

/// Makes a mesh of a solid's surface that is nowhere farther from it than the deviation, in scene
/// units and above 0. The mesh is closed: at each edge of a triangle lies one other. Corners lie on
/// the surface, and sharp edges of the solid are edges of triangles, but for rounding. Of the
/// options the width is not used. The mesh is the same, to the last bit, for any number of threads
/// and on any machine, unless time ends the search. That also ends after about a million boxes.
/// Then the mesh is as good as it is, and its deviation infinite. So it is where surfaces touch
/// without crossing, or where nothing is known of them, as of Custom shapes. So it is, too, where
/// a gap or a film is no thicker than 1e-12 of the coordinates: the faces beside it are taken as
/// one. A Mesh or HeightField by itself has its own triangles, if each is known to face out of the
/// solid or into it. Throws Error as volume() does. Any thread may call it.
SurfaceMesh tessellate(const Entity& entity, double deviation, const MeasureOptions& options = {});

/// Returns a deviation that fits the size of solids: a thousandth of the longest side of the box
/// around all of them that have one. Throws Error as bounding_box() does.
double usual_deviation(std::span<const Entity> entities);

/// Returns a colour for all of an entity, as files have it: that of its first part, with channels
/// cut to [0, 1]. There is none where that has no material or a pattern.
std::optional<Color> plain_color(const Entity& entity);

/// Names the formats that surfaces are written in.
enum class SurfaceMeshFormat {
  stl,       ///< STL, binary: triangles alone, of floats
  obj,       ///< Wavefront OBJ: text, an object for each part
  ply,       ///< PLY, binary, of doubles; colours at vertices
  three_mf,  ///< 3MF: unit, an object for each part with its name and colour
  glb,       ///< glTF 2.0, binary: metres, of floats, a node for each part with a base colour
};

/// A SurfaceMeshPart is one of several meshes in a file.
struct SurfaceMeshPart {
  const SurfaceMesh* mesh = nullptr;  ///< must live as long as the call that it is given to
  std::string name{};                 ///< UTF-8; empty: "part" and its number, from 1 on
  /// Linear RGB, each in [0, 1], as is the coverage a. OBJ and STL have no colours.
  std::optional<Color> color{};
};

/// SurfaceMeshFileOptions say what a file says beside the triangles.
struct SurfaceMeshFileOptions {
  /// This is the unit of the positions. 3MF has it as it is, and glTF is in metres. The others name
  /// it in a comment that programs do not read.
  Unit unit = Unit::m;
  std::optional<Color> color{};  ///< as in SurfaceMeshPart, of what has none of its own
  std::string name{};            ///< likewise
};

/// Returns the format that the ending of a name says: .stl, .obj, .ply, .3mf or .glb, in small or
/// capital letters. Throws Error (unsupported) for another.
SurfaceMeshFormat surface_mesh_format(const std::filesystem::path& path);

/// Returns the bytes of a file with several parts. Formats without parts (STL, PLY) have all
/// triangles, one part's after another's. Parts without triangles are left out. The largest
/// deviation of a part stands in a comment or the like. Any thread may call it.
///
/// Throws Error: invalid_argument for a mesh without a corner that a triangle has, a coordinate
/// that is not finite, beyond 1e100 or beyond what floats hold if the format has these, no triangle
/// at all, or a colour out of range; limit for what the format has no room for (2^32 - 1 triangles
/// of STL, 4 GiB of 3MF and glTF); out_of_memory. `unsupported` comes of a build without mesh
/// files.
std::vector<std::byte> encode_surface_mesh(std::span<const SurfaceMeshPart> parts,
                                           SurfaceMeshFormat format,
                                           const SurfaceMeshFileOptions& options = {});

/// Writes a file with several parts, in the format that its ending says, as write_file() does: all
/// of it or none. Throws Error as the functions above, and as write_file() does.
void write_surface_mesh(const std::filesystem::path& path, std::span<const SurfaceMeshPart> parts,
                        const SurfaceMeshFileOptions& options = {});

/// Writes a file of one mesh.
void write_surface_mesh(const std::filesystem::path& path, const SurfaceMesh& mesh,
                        const SurfaceMeshFileOptions& options = {});

}  // namespace crt
