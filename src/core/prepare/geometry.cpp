#include "core/prepare/geometry.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "core/geometry/mesh/mesh.hpp"

namespace crt::core {

namespace {

/// Returns the triangles of a leaf if it is a mesh with warnings that nobody has had, or null.
std::shared_ptr<const MeshTriangles> untold_mesh(const Leaf& leaf) {
  if (leaf.face_count < 2) return nullptr;  // no closed mesh is less, and most primitives are
  const auto* const mesh = dynamic_cast<const MeshShape*>(leaf.shape);
  if (mesh == nullptr) return nullptr;
  const MeshReport& report = mesh->triangles().report();
  return report.reported || report.warnings.empty() ? nullptr : mesh->shared_triangles();
}

}  // namespace

Geometry::Geometry(CompiledScene compiled, Precision of_scene, const Workers& workers)
    : precision(of_scene),
      has_csg(!compiled.programs.empty() || !compiled.prototypes.empty()),
      accelerator(std::move(compiled), workers) {
  list_leaves();
}

Geometry::Geometry(RecompiledScene recompiled, const Geometry& earlier, const Workers& workers)
    : precision(earlier.precision),
      has_csg(!recompiled.scene.programs.empty() || !recompiled.scene.prototypes.empty()),
      accelerator(std::move(recompiled.scene), &earlier.accelerator, recompiled.earlier_objects,
                  workers) {
  list_leaves();
}

void Geometry::list_leaves() {
  const CompiledScene& scene = accelerator.compiled();
  std::set<const MeshTriangles*> seen;
  const auto note_mesh = [&](const Leaf& leaf) {
    std::shared_ptr<const MeshTriangles> mesh = untold_mesh(leaf);
    if (mesh != nullptr && seen.insert(mesh.get()).second) meshes.push_back(std::move(mesh));
  };
  entity_ids.reserve(scene.leaves.size());
  for (const Leaf& leaf : scene.leaves) {
    entity_ids.push_back(leaf.entity_id);
    note_mesh(leaf);
  }
  for (const Prototype& prototype : scene.prototypes)
    std::ranges::for_each(prototype.scene->leaves, note_mesh);
}

}  // namespace crt::core
