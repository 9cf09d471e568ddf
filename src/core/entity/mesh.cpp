#include "crt/mesh.hpp"

#include <cmath>

#include "core/entity/entity_node.hpp"
#include "core/geometry/checks.hpp"
#include "core/geometry/mesh/repair.hpp"
#include "core/geometry/mesh/triangles.hpp"

namespace crt {

std::shared_ptr<const MeshTriangles> mesh_triangles(std::span<const Vec3> positions,
                                                    std::span<const TriangleIndices> triangles) {
  return std::make_shared<const MeshTriangles>(positions, triangles);
}

std::shared_ptr<const MeshTriangles> mesh_triangles(std::span<const Vec3> positions,
                                                    std::span<const TriangleIndices> triangles,
                                                    const MeshAttributes& attributes,
                                                    const MeshOptions& options) {
  return core::make_mesh_triangles({positions, triangles, attributes}, options,
                                   options.fill.value_or(FillRule::even_odd), {});
}

Entity triangle_mesh(std::span<const Vec3> positions, std::span<const TriangleIndices> triangles) {
  return Mesh{.triangles = mesh_triangles(positions, triangles)};
}

Entity triangle_mesh(std::span<const Vec3> positions, std::span<const TriangleIndices> triangles,
                     const MeshAttributes& attributes, const MeshOptions& options) {
  return Mesh{.triangles = mesh_triangles(positions, triangles, attributes, options)};
}

const MeshReport& mesh_report(const MeshTriangles& triangles) {
  return triangles.report();
}

const MeshReport* mesh_report(const Entity& entity) {
  const EntityNode* node = &entity.node();
  if (const auto* wrapper = std::get_if<EntityWrapper>(&node->content)) node = wrapper->child.get();
  const auto* primitive = std::get_if<Primitive>(&node->content);
  const auto* mesh = primitive == nullptr ? nullptr : std::get_if<Mesh>(primitive);
  return mesh == nullptr ? nullptr : &mesh->triangles->report();
}

}  // namespace crt
