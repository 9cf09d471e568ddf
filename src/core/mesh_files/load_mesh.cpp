// What mesh files hold becomes meshes here.
#include <string>
#include <utility>

#include "core/geometry/mesh/repair.hpp"
#include "crt/error.hpp"
#include "crt/mesh_file.hpp"
#include "text/format.hpp"

namespace crt {

using namespace core;

Entity load_mesh(const MeshFile& file, const std::string& name, const MeshOptions& options) {
  try {
    const GivenMesh given{file.positions, file.triangles, file.attributes};
    MeshReport report{.name = name, .warnings = file.warnings};
    return Mesh{.triangles = make_mesh_triangles(given, options, options.fill, std::move(report))};
  } catch (const Error& error) {
    throw Error(error.code(), text::format("cannot make a mesh of '{}': {}", name, error.what()),
                error.argument());
  }
}

Entity load_mesh(const std::filesystem::path& path, std::optional<double> smooth,
                 const MeshOptions& options) {
  MeshFile file = read_mesh_file(path);
  file.attributes.smooth = smooth;
  return load_mesh(file, path.string(), options);
}

Entity load_mesh(std::span<const std::byte> content, const std::string& name,
                 const MeshOptions& options) {
  return load_mesh(decode_mesh_file(content, name), name, options);
}

}  // namespace crt
