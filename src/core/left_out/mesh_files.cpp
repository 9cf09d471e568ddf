// This stands for the readers and writers of mesh files.
#include "crt/error.hpp"
#include "crt/mesh_file.hpp"
#include "crt/surface_mesh.hpp"
#include "text/left_out.hpp"

namespace crt {

namespace {

[[noreturn]] void refuse_mesh_file() {
  throw Error(ErrorCode::unsupported,
              text::left_out("readers and writers of mesh files", "MESH_FILES"));
}

}  // namespace

MeshFile decode_mesh_file(std::span<const std::byte>, const std::string&, std::optional<MeshFormat>,
                          const OpenMeshPart&, const OpenMeshPicture&) {
  refuse_mesh_file();
}

MeshFile read_mesh_file(const std::filesystem::path&, const OpenMeshPart&, const OpenMeshPicture&) {
  refuse_mesh_file();
}

SurfaceMeshFormat surface_mesh_format(const std::filesystem::path&) {
  refuse_mesh_file();
}

std::vector<std::byte> encode_surface_mesh(std::span<const SurfaceMeshPart>, SurfaceMeshFormat,
                                           const SurfaceMeshFileOptions&) {
  refuse_mesh_file();
}

void write_surface_mesh(const std::filesystem::path&, std::span<const SurfaceMeshPart>,
                        const SurfaceMeshFileOptions&) {
  refuse_mesh_file();
}

void write_surface_mesh(const std::filesystem::path&, const SurfaceMesh&,
                        const SurfaceMeshFileOptions&) {
  refuse_mesh_file();
}

}  // namespace crt
