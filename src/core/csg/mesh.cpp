#include "crt/mesh.hpp"
#include "core/geometry/mesh/triangles.hpp"

namespace crt {

std::shared_ptr<const MeshTriangles> mesh_triangles(std::span<const Vec3> positions,
                                                    std::span<const TriangleIndices> triangles) {
  return std::make_shared<const MeshTriangles>(positions, triangles);
}

std::shared_ptr<const MeshTriangles> mesh_triangles(std::span<const Vec3> positions,
                                                    std::span<const TriangleIndices> triangles,
                                                    const MeshAttributes& attributes) {
  return std::make_shared<const MeshTriangles>(positions, triangles, &attributes);
}

Entity triangle_mesh(std::span<const Vec3> positions, std::span<const TriangleIndices> triangles) {
  return Mesh{.triangles = mesh_triangles(positions, triangles)};
}

Entity triangle_mesh(std::span<const Vec3> positions, std::span<const TriangleIndices> triangles,
                     const MeshAttributes& attributes) {
  return Mesh{.triangles = mesh_triangles(positions, triangles, attributes)};
}

}  // namespace crt
