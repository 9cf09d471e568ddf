#include <fmt/format.h>

#include <vector>

#include "core/geometry/checks.hpp"
#include "core/geometry/triangle/triangle.hpp"
#include "crt/entity.hpp"
#include "crt/error.hpp"

namespace crt {

Entity triangle_mesh(std::span<const Vec3> positions, std::span<const TriangleIndices> triangles) {
  for (const Vec3& position : positions) core::check_coordinates("positions", position);
  std::vector<Entity> faces;
  faces.reserve(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const std::uint32_t index : triangles[i]) {
      if (index < positions.size()) continue;
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("triangle {} has the index {}, but there are {} positions", i, index,
                              positions.size()),
                  "indices");
    }
    const auto [a, b, c] = triangles[i];
    const Triangle triangle{.a = positions[a], .b = positions[b], .c = positions[c]};
    if (core::has_area(triangle)) faces.emplace_back(triangle);
  }
  if (faces.empty()) {
    throw Error(ErrorCode::invalid_argument, "a mesh needs at least one triangle that has an area",
                "triangles");
  }
  return csg_union(faces);
}

}  // namespace crt
