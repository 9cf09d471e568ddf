// Checks surface meshes and writes them in the format of their file's name.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <new>

#include "core/mesh_files/surface_writers.hpp"
#include "crt/elementary.hpp"
#include "crt/error.hpp"
#include "crt/file.hpp"
#include "text/format.hpp"
#include "text/letters.hpp"
#include "text/utf8.hpp"

namespace crt {

namespace core {

namespace {

constexpr double largest_coordinate_of_files = 1e100;

[[noreturn]] void refuse_surface(const std::string& complaint, const char* field) {
  throw Error(ErrorCode::invalid_argument, complaint, field);
}

void check_positions(const SurfaceMesh& mesh, double most) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const double number = mesh.positions[i][axis];
      if (std::abs(number) <= most) continue;
      refuse_surface(text::format("position {} of a mesh has the coordinate {}; the format has "
                                  "finite ones up to {}",
                                  i, number, most),
                     "positions");
    }
  }
}

void check_triangles(const SurfaceMesh& mesh) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& corners = mesh.triangles[i];
    if (*std::max_element(corners.begin(), corners.end()) < mesh.positions.size()) continue;
    refuse_surface(
        text::format("triangle {} of a mesh has a corner that is none of its {} positions", i,
                     mesh.positions.size()),
        "triangles");
  }
}

void check_color(const Color& color) {
  for (const double channel : {color.r, color.g, color.b, color.a})
    if (!(channel >= 0 && channel <= 1))
      refuse_surface("the channels of a part's colour must be from 0 to 1", "color");
}

/// Returns the largest coordinate that files of a format have.
double most_of(SurfaceMeshFormat format) {
  const bool has_floats = format == SurfaceMeshFormat::stl || format == SurfaceMeshFormat::glb;
  constexpr double most_float = 1e38;
  return has_floats ? most_float : largest_coordinate_of_files;
}

/// Returns a name that all formats can have: UTF-8 in one line.
std::string clean_name(const std::string& name, std::size_t number) {
  if (name.empty()) return text::format("part {}", number);
  std::string clean = name;
  const bool is_text = text::is_utf8(clean);
  for (char& letter : clean) {
    const auto byte = static_cast<unsigned char>(letter);
    constexpr unsigned char first_printable = 0x20;
    constexpr unsigned char removed = 0x7f;
    if (byte < first_printable || byte == removed || (!is_text && byte > removed)) letter = '_';
  }
  return clean;
}

SurfaceFile checked_file(std::span<const SurfaceMeshPart> parts, SurfaceMeshFormat format,
                         const SurfaceMeshFileOptions& options) {
  SurfaceFile file{.parts = {}, .unit = options.unit, .deviation = 0};
  file.parts.reserve(parts.size());
  for (const SurfaceMeshPart& part : parts) {
    if (part.mesh == nullptr) refuse_surface("a part of a file has no mesh", "mesh");
    const std::optional<Color>& color = part.color ? part.color : options.color;
    if (color) check_color(*color);
    check_triangles(*part.mesh);
    check_positions(*part.mesh, most_of(format));
    const std::size_t number = file.parts.size() + 1;
    if (part.mesh->triangles.empty()) continue;
    file.parts.push_back({.mesh = part.mesh,
                          .name = clean_name(part.name.empty() ? options.name : part.name, number),
                          .color = color});
    file.deviation = std::max(file.deviation, part.mesh->deviation);
  }
  if (file.parts.empty())
    refuse_surface("there are no triangles to write: the solid has no surface", "triangles");
  check_room(format, counts_of(file));
  return file;
}

std::string surface_bytes(const SurfaceFile& file, SurfaceMeshFormat format) {
  switch (format) {
    case SurfaceMeshFormat::stl:
      return stl_bytes(file);
    case SurfaceMeshFormat::obj:
      return obj_bytes(file);
    case SurfaceMeshFormat::ply:
      return ply_bytes(file);
    case SurfaceMeshFormat::three_mf:
      return three_mf_bytes(file);
    case SurfaceMeshFormat::glb:
      return glb_bytes(file);
  }
  refuse_surface("the format of a surface mesh must be one that there is", "format");
}

std::string encoded_surface(std::span<const SurfaceMeshPart> parts, SurfaceMeshFormat format,
                            const SurfaceMeshFileOptions& options) {
  try {
    return surface_bytes(checked_file(parts, format, options), format);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::out_of_memory, "there is not enough memory for the file of a mesh");
  }
}

}  // namespace

SurfaceCounts counts_of(const SurfaceFile& file) {
  SurfaceCounts counts;
  for (const SurfacePart& part : file.parts) {
    counts.positions += part.mesh->positions.size();
    counts.triangles += part.mesh->triangles.size();
    ++counts.parts;
  }
  return counts;
}

void check_bytes(std::string_view format, std::uint64_t bytes) {
  constexpr std::uint64_t most_bytes = 0xffffffff;
  if (bytes <= most_bytes) return;
  throw Error(ErrorCode::limit,
              text::format("{} has room for 4 GiB, and this mesh takes {} bytes: make it coarser, "
                           "or write another format, such as PLY",
                           format, bytes));
}

void check_room(SurfaceMeshFormat format, const SurfaceCounts& counts) {
  constexpr std::uint64_t most_numbers = 0xfffffffe;
  if (format == SurfaceMeshFormat::glb) {
    constexpr std::uint64_t bytes_of_position = 12;
    constexpr std::uint64_t bytes_of_triangle = 12;
    check_bytes("glTF", bytes_of_position * std::min(counts.positions, most_numbers) +
                            bytes_of_triangle * std::min(counts.triangles, most_numbers));
  }
  // All count corners with 32 bits, or are read by programs that do.
  if (counts.positions <= most_numbers && counts.triangles <= most_numbers) return;
  throw Error(ErrorCode::limit, text::format("a file has room for {} triangles and as many "
                                             "corners, and this mesh has {} and {}",
                                             most_numbers, counts.triangles, counts.positions));
}

std::string_view unit_name(Unit unit) {
  switch (unit) {
    case Unit::m:
      return "m";
    case Unit::cm:
      return "cm";
    case Unit::mm:
      return "mm";
    case Unit::in:
      return "in";
  }
  refuse_surface("the unit of a surface mesh must be one that there is", "unit");
}

std::string deviation_text(const SurfaceFile& file) {
  if (!std::isfinite(file.deviation)) return text::format("unit: {}", unit_name(file.unit));
  return text::format("unit: {}, deviation at most {:.6g}", unit_name(file.unit), file.deviation);
}

void append_number(std::string& text, double number) {
  char letters[32];
  // A zero has no sign, as readers take it.
  const auto [end, error] = std::to_chars(letters, letters + sizeof letters, number + 0.0);
  text.append(letters, end);
}

void append_number(std::string& text, std::uint64_t number) {
  char letters[24];
  const auto [end, error] = std::to_chars(letters, letters + sizeof letters, number);
  text.append(letters, end);
}

std::uint8_t srgb_of(double linear) {
  constexpr double end_of_line = 0.0031308;
  const double value =
      linear <= end_of_line ? 12.92 * linear : 1.055 * elementary::pow(linear, 1 / 2.4) - 0.055;
  return byte_of(value);
}

std::uint8_t byte_of(double coverage) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(coverage, 0.0, 1.0)));
}

}  // namespace core

SurfaceMeshFormat surface_mesh_format(const std::filesystem::path& path) {
  const std::string ending = text::in_small_letters(path.extension().string());
  if (ending == ".stl") return SurfaceMeshFormat::stl;
  if (ending == ".obj") return SurfaceMeshFormat::obj;
  if (ending == ".ply") return SurfaceMeshFormat::ply;
  if (ending == ".3mf") return SurfaceMeshFormat::three_mf;
  if (ending == ".glb") return SurfaceMeshFormat::glb;
  throw Error(ErrorCode::unsupported,
              text::format("'{}' has no ending of a mesh file that can be written: .stl, .obj, "
                           ".ply, .3mf or .glb",
                           path.string()));
}

std::vector<std::byte> encode_surface_mesh(std::span<const SurfaceMeshPart> parts,
                                           SurfaceMeshFormat format,
                                           const SurfaceMeshFileOptions& options) {
  const std::string bytes = core::encoded_surface(parts, format, options);
  const auto all = std::as_bytes(std::span(bytes));
  return {all.begin(), all.end()};
}

void write_surface_mesh(const std::filesystem::path& path, std::span<const SurfaceMeshPart> parts,
                        const SurfaceMeshFileOptions& options) {
  const SurfaceMeshFormat format = surface_mesh_format(path);
  check_writable(path);
  write_file(path, core::encoded_surface(parts, format, options));
}

void write_surface_mesh(const std::filesystem::path& path, const SurfaceMesh& mesh,
                        const SurfaceMeshFileOptions& options) {
  const SurfaceMeshPart part{.mesh = &mesh};
  write_surface_mesh(path, std::span(&part, 1), options);
}

}  // namespace crt
