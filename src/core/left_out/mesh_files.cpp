// This stands for the readers of mesh files.
#include "crt/error.hpp"
#include "crt/mesh_file.hpp"
#include "text/left_out.hpp"

namespace crt {

namespace {

[[noreturn]] void refuse_mesh_file() {
  throw Error(ErrorCode::unsupported, text::left_out("readers of mesh files", "MESH_FILES"));
}

}  // namespace

MeshFile decode_mesh_file(std::span<const std::byte>, const std::string&, std::optional<MeshFormat>,
                          const OpenMeshPart&, const OpenMeshPicture&) {
  refuse_mesh_file();
}

MeshFile read_mesh_file(const std::filesystem::path&, const OpenMeshPart&, const OpenMeshPicture&) {
  refuse_mesh_file();
}

}  // namespace crt
