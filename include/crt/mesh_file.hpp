// Files of triangles made by other programs are read here: OBJ, PLY, STL, 3MF and OFF.
#pragma once

#include <crt/entity.hpp>
#include <crt/vec.hpp>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace crt {

/// Names the formats of mesh files.
enum class MeshFormat {
  obj,       ///< Wavefront OBJ: polygons; text
  ply,       ///< PLY: polygons; text, or binary of either byte order
  stl,       ///< STL: triangles; text or binary
  off,       ///< OFF, also with colours, normals or texture coordinates at vertices; text
  three_mf,  ///< 3MF: the objects that its build lists, in their places
};

/// A MeshFile has what a file says of a surface. Only positions and faces are read, in the numbers
/// and the unit of the file. Whatever else there is (colours, normals, materials) is left alone.
struct MeshFile {
  MeshFormat format = MeshFormat::obj;
  /// The vertices, in the order of the file. Those whose coordinates are equal are one, and -0 is
  /// 0. There is no tolerance.
  std::vector<Vec3> positions;
  /// The faces, in the order of the file. Polygons are cut into triangles.
  std::vector<TriangleIndices> triangles;
  /// How many triangles are left out because two of their corners are equal.
  std::uint64_t dropped_triangles = 0;
};

/// Reads a mesh file. The content shows its format; where it does not, the ending of the name does.
/// Numbers in text become the nearest double, and those in binary stay what they are.
///
/// Throws Error (io) if there is no such file, if it is no mesh file, or if it is broken. The
/// message then has the line or byte. Errors are also: no face at all, an index without a vertex,
/// and a coordinate that is not finite or beyond 1e100. The memory it takes is in proportion to the
/// file's size, whatever the file claims.
MeshFile read_mesh_file(const std::filesystem::path& path);

/// Reads a mesh file from memory, as the function above. Messages call it `name`, whose ending may
/// show the format. It is read as `format` if there is one.
MeshFile decode_mesh_file(std::span<const std::byte> content, const std::string& name,
                          std::optional<MeshFormat> format = {});

/// Reads a mesh file and makes an entity of it by triangle_mesh(). Throws Error as both do.
Entity load_mesh(const std::filesystem::path& path);

/// Makes an entity of a mesh file in memory.
Entity load_mesh(std::span<const std::byte> content, const std::string& name);

}  // namespace crt
