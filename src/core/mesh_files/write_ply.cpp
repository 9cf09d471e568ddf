// Writes binary PLY files: G. Turk, The PLY Polygon File Format (1994).
#include <algorithm>

#include "core/mesh_files/surface_writers.hpp"
#include "text/format.hpp"

namespace crt::core {

std::string ply_bytes(const SurfaceFile& file) {
  const SurfaceCounts counts = counts_of(file);
  const bool has_colors = std::any_of(file.parts.begin(), file.parts.end(),
                                      [](const SurfacePart& part) { return part.color; });
  std::string bytes = text::format(
      "ply\nformat binary_little_endian 1.0\ncomment CRT, {}\nelement vertex {}\n"
      "property double x\nproperty double y\nproperty double z\n{}element face {}\n"
      "property list uchar uint vertex_indices\nend_header\n",
      deviation_text(file), counts.positions,
      has_colors ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "",
      counts.triangles);
  constexpr std::size_t bytes_of_position = 27;
  constexpr std::size_t bytes_of_triangle = 13;
  bytes.reserve(bytes.size() + bytes_of_position * counts.positions +
                bytes_of_triangle * counts.triangles);
  for (const SurfacePart& part : file.parts) {
    const Color color = part.color.value_or(grey(1));
    for (const Vec3& position : part.mesh->positions) {
      for (int axis = 0; axis < 3; ++axis) append_bytes(bytes, position[axis] + 0.0);
      if (!has_colors) continue;
      for (const double channel : {color.r, color.g, color.b})
        append_bytes(bytes, srgb_of(channel));
    }
  }
  std::uint32_t first = 0;
  for (const SurfacePart& part : file.parts) {
    for (const auto& corners : part.mesh->triangles) {
      append_bytes(bytes, std::uint8_t{3});
      for (const std::uint32_t corner : corners) append_bytes(bytes, first + corner);
    }
    first += static_cast<std::uint32_t>(part.mesh->positions.size());
  }
  return bytes;
}

}  // namespace crt::core
