// Writes binary STL files: 3D Systems, StereoLithography interface specification (1989).
#include <glm/geometric.hpp>

#include "core/mesh_files/stl.hpp"
#include "core/mesh_files/surface_writers.hpp"

namespace crt::core {

namespace {

using FloatVec = std::array<float, 3>;

FloatVec floats_of(const Vec3& place) {
  return {static_cast<float>(place.x), static_cast<float>(place.y), static_cast<float>(place.z)};
}

void append_floats(std::string& bytes, const FloatVec& numbers) {
  for (const float number : numbers) append_bytes(bytes, number + 0.0f);
}

/// Returns the normal of a triangle, which is 0 for one without area.
FloatVec normal_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  // Coordinates may be so large or small that products of them are no doubles.
  const Vec3 first = b - a;
  const Vec3 second = c - a;
  const double size = std::max(glm::length(first), glm::length(second));
  if (!(size > 0)) return {0, 0, 0};
  const Vec3 across = glm::cross(first / size, second / size);
  const double area = glm::length(across);
  return area > 0 ? floats_of(across / area) : FloatVec{0, 0, 0};
}

}  // namespace

std::string stl_bytes(const SurfaceFile& file) {
  // A header that begins with "solid" would be taken for text.
  std::string bytes = "CRT binary STL, " + deviation_text(file);
  bytes.resize(stl_header_size, ' ');
  const std::uint64_t count = counts_of(file).triangles;
  bytes.reserve(stl_begin_size + count * stl_triangle_size);
  append_bytes(bytes, static_cast<std::uint32_t>(count));
  for (const SurfacePart& part : file.parts) {
    const std::vector<Vec3>& positions = part.mesh->positions;
    for (const auto& [a, b, c] : part.mesh->triangles) {
      append_floats(bytes, normal_of(positions[a], positions[b], positions[c]));
      for (const std::uint32_t corner : {a, b, c})
        append_floats(bytes, floats_of(positions[corner]));
      append_bytes(bytes, std::uint16_t{0});
    }
  }
  return bytes;
}

}  // namespace crt::core
