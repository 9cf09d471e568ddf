#include "crt/mesh_file.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "core/base/whole_file.hpp"
#include "core/mesh_files/mesh_builder.hpp"
#include "core/mesh_files/mesh_format.hpp"
#include "core/mesh_files/readers.hpp"
#include "core/mesh_files/refused_mesh.hpp"
#include "crt/error.hpp"

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

MeshFile decode(std::string_view content, const std::string& name,
                std::optional<MeshFormat> format) {
  content = without_byte_order_mark(content);
  if (content.empty()) throw RefusedMesh("it is empty");
  if (!format) format = mesh_format(content, name);
  if (!format) throw RefusedMesh("it is no OBJ, PLY, STL, 3MF or OFF file");
  MeshBuilder mesh;
  read_as(*format, content, mesh);
  MeshFile file = mesh.finish();
  file.format = *format;
  return file;
}

Entity entity_of(const MeshFile& file, const std::string& name) {
  try {
    return triangle_mesh(file.positions, file.triangles);
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("cannot make a mesh of '{}': {}", name, error.what()));
  }
}

}  // namespace

MeshFile decode_mesh_file(std::span<const std::byte> content, const std::string& name,
                          std::optional<MeshFormat> format) {
  const std::string_view text(reinterpret_cast<const char*>(content.data()), content.size());
  try {
    return decode(text, name, format);
  } catch (const RefusedMesh& refusal) {
    throw Error(ErrorCode::io, fmt::format("cannot read '{}': {}", name, refusal.what()));
  }
}

MeshFile read_mesh_file(const std::filesystem::path& path) {
  return decode_mesh_file(read_whole_file(path, most_bytes), path.string());
}

Entity load_mesh(const std::filesystem::path& path) {
  return entity_of(read_mesh_file(path), path.string());
}

Entity load_mesh(std::span<const std::byte> content, const std::string& name) {
  return entity_of(decode_mesh_file(content, name), name);
}

}  // namespace crt
