// Files of triangles made by other programs are read here: OBJ, PLY, STL, 3MF and OFF.
#pragma once

#include <crt/entity.hpp>
#include <crt/image.hpp>
#include <crt/mesh.hpp>
#include <crt/vec.hpp>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
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

/// A MeshFile has what a file says of a surface, in the numbers and the unit of the file. Of what
/// there is beside positions and faces, normals and (u, v) at vertices are read (OBJ, PLY) and
/// materials (OBJ with MTL). Whatever else there is (groups, colours of vertices) is left alone.
struct MeshFile {
  MeshFormat format = MeshFormat::obj;
  /// The vertices, in the order of the file. Those whose coordinates are equal are one, and -0 is
  /// 0. There is no tolerance.
  std::vector<Vec3> positions;
  /// The faces, in the order of the file. Polygons are cut into triangles.
  std::vector<TriangleIndices> triangles;
  /// How many triangles are left out because two of their corners are equal.
  std::uint64_t dropped_triangles = 0;
  /// This has normals, (u, v) and materials, as far as the file has any.
  MeshAttributes attributes{};
  /// These say, a line each, what was left out, such as files that it names and that could not be
  /// read, and what of the file was not as its format wants it.
  std::vector<std::string> warnings{};
};

/// Returns the content of a file that a mesh file names, such as a picture. Throws Error if it
/// cannot be had, and then there is a warning with the error's message.
using OpenMeshPart = std::function<std::vector<std::byte>(const std::string& name)>;

/// Returns a picture that a mesh file names. Throws Error if it cannot be had. For ErrorCode::io
/// and unsupported there is then a warning with the error's message, and anything else comes out.
using OpenMeshPicture = std::function<std::shared_ptr<const Image>(const std::string& name)>;

/// Reads a mesh file. The content shows its format; where it does not, the ending of the name does.
/// Numbers in text become the nearest double, and those in binary stay what they are.
///
/// Throws Error (io) if there is no such file, if it is no mesh file, or if it is broken. The
/// message then has the line or byte. Errors are also: no face at all, an index without a vertex,
/// and a coordinate that is not finite or beyond 1e100. The memory it takes is in proportion to the
/// file's size, whatever the file claims. Files that it names are opened by `open`. Without that
/// they are looked for in its directory and those below, and nowhere else. Pictures come from
/// `open_picture`. Without that they are decoded from what `open` gives, and may have
/// affordable_image_pixels() together, beyond which there is an Error (limit).
MeshFile read_mesh_file(const std::filesystem::path& path, const OpenMeshPart& open = {},
                        const OpenMeshPicture& open_picture = {});

/// Reads a mesh file from memory, as the function above. Messages call it `name`, whose ending may
/// show the format. It is read as `format` if there is one. Without `open` no file is opened.
MeshFile decode_mesh_file(std::span<const std::byte> content, const std::string& name,
                          std::optional<MeshFormat> format = {}, const OpenMeshPart& open = {},
                          const OpenMeshPicture& open_picture = {});

/// Makes an entity of what was read, by triangle_mesh(). Messages call the file `name`. Throws
/// Error as that does.
Entity load_mesh(const MeshFile& file, const std::string& name, const MeshOptions& options = {});

/// Reads a mesh file and makes an entity of it. `smooth` is that of MeshAttributes. Throws Error as
/// both functions do.
Entity load_mesh(const std::filesystem::path& path, std::optional<double> smooth = {},
                 const MeshOptions& options = {});

/// Makes an entity of a mesh file in memory.
Entity load_mesh(std::span<const std::byte> content, const std::string& name,
                 const MeshOptions& options = {});

}  // namespace crt
