// libFuzzer gives any bytes to the readers of mesh files. What begins like XML becomes the model of
// a 3MF file, as it would hardly find the checksums of one.
#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include "crt/error.hpp"
#include "crt/mesh_file.hpp"

namespace {

void append(std::string& text, std::size_t number, int bytes) {
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(number >> (8 * i));
}

/// Returns an archive with this model, which is stored as it is.
std::string archive_of(const std::string& model) {
  const std::string name = "3D/3dmodel.model";
  std::string numbers(10, '\0');  // flags, method and time
  append(numbers,
         crc32(0, reinterpret_cast<const Bytef*>(model.data()), static_cast<uInt>(model.size())),
         4);
  append(numbers, model.size(), 4);
  append(numbers, model.size(), 4);
  append(numbers, name.size(), 2);
  append(numbers, 0, 2);
  numbers.erase(0, 2);
  const std::string version(2, '\0');
  std::string archive = "PK\x03\x04" + version + numbers + name + model;
  const std::size_t list = archive.size();
  archive += "PK\x01\x02" + version + version + numbers + std::string(14, '\0') + name;
  const std::size_t size = archive.size() - list;
  archive += "PK\x05\x06" + std::string(4, '\0');
  append(archive, 1, 2);
  append(archive, 1, 2);
  append(archive, size, 4);
  append(archive, list, 4);
  append(archive, 0, 2);
  return archive;
}

/// Makes meshes of what was read, which only fails if no triangle has an area, or if far too many
/// edges lie on one another.
void check_attributes(const crt::MeshFile& mesh) {
  constexpr std::size_t enough = 1000;
  if (mesh.triangles.size() > enough) return;
  for (const double distance : {0.0, 1e-3, 1.0}) {
    try {
      crt::load_mesh(mesh, "mesh", {.weld = distance, .stitch = distance});
    } catch (const crt::Error& error) {
      if (error.argument() != "triangles" && error.argument() != "stitch") std::abort();
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string content(reinterpret_cast<const char*>(data), size);
  if (content.starts_with('<')) content = archive_of(content);
  const auto bytes = std::as_bytes(std::span(content.data(), content.size()));
  // A file is its own library of materials, and there are no pictures.
  const crt::OpenMeshPart open = [&](const std::string& name) {
    if (!name.starts_with("lib")) throw crt::Error(crt::ErrorCode::io, "there is no such file");
    return std::vector<std::byte>(bytes.begin(), bytes.end());
  };
  try {
    const crt::MeshFile mesh = crt::decode_mesh_file(bytes, "mesh.obj", {}, open);
    for (const crt::TriangleIndices& triangle : mesh.triangles) {
      for (const std::uint32_t corner : triangle) {
        if (corner >= mesh.positions.size()) std::abort();
      }
    }
    check_attributes(mesh);
  } catch (const crt::Error& error) {
    // A broken file is an error of this kind alone.
    if (error.code() != crt::ErrorCode::io) std::abort();
  }
  return 0;
}
