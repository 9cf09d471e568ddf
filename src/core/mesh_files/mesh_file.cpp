#include "crt/mesh_file.hpp"

#include <string>
#include <string_view>

#include "core/base/whole_file.hpp"
#include "core/mesh_files/mesh_builder.hpp"
#include "core/mesh_files/mesh_format.hpp"
#include "core/mesh_files/readers.hpp"
#include "core/mesh_files/refused_mesh.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt {

namespace {

using namespace core;

constexpr std::size_t most_bytes = std::size_t{1} << 33;

std::string_view without_byte_order_mark(std::string_view content) {
  constexpr std::string_view mark = "\xef\xbb\xbf";
  return content.starts_with(mark) ? content.substr(mark.size()) : content;
}

void read_as(MeshFormat format, std::string_view content, MeshBuilder& mesh) {
  switch (format) {
    case MeshFormat::obj:
      return read_obj(content, mesh);
    case MeshFormat::ply:
      return read_ply(content, mesh);
    case MeshFormat::stl:
      return read_stl(content, mesh);
    case MeshFormat::off:
      return read_off(content, mesh);
    case MeshFormat::three_mf:
      return read_three_mf(content, mesh);
  }
}

MeshFile decode(std::string_view content, const std::string& name, std::optional<MeshFormat> format,
                const OpenMeshPart& open, const OpenMeshPicture& open_picture) {
  content = without_byte_order_mark(content);
  if (content.empty()) throw RefusedMesh("it is empty");
  if (!format) format = mesh_format(content, name);
  if (!format) throw RefusedMesh("it is no OBJ, PLY, STL, 3MF or OFF file");
  MeshBuilder mesh(open, open_picture);
  read_as(*format, content, mesh);
  MeshFile file = mesh.finish();
  file.format = *format;
  return file;
}

/// Returns what opens files in a directory and those below.
OpenMeshPart opener_in(const std::filesystem::path& directory) {
  return [directory](const std::string& name) {
    const std::filesystem::path path = std::filesystem::path(name).lexically_normal();
    if (path.empty() || path.has_root_path() || *path.begin() == "..") {
      throw Error(ErrorCode::io,
                  text::format("'{}' lies outside the directory of the mesh file", name));
    }
    return read_whole_file(directory / path, most_bytes);
  };
}

}  // namespace

MeshFile decode_mesh_file(std::span<const std::byte> content, const std::string& name,
                          std::optional<MeshFormat> format, const OpenMeshPart& open,
                          const OpenMeshPicture& open_picture) {
  const std::string_view text(reinterpret_cast<const char*>(content.data()), content.size());
  try {
    return decode(text, name, format, open, open_picture);
  } catch (const RefusedMesh& refusal) {
    throw Error(ErrorCode::io, text::format("cannot read '{}': {}", name, refusal.what()));
  }
}

MeshFile read_mesh_file(const std::filesystem::path& path, const OpenMeshPart& open,
                        const OpenMeshPicture& open_picture) {
  return decode_mesh_file(read_whole_file(path, most_bytes), path.string(), {},
                          open ? open : opener_in(path.parent_path()), open_picture);
}

}  // namespace crt
