#include "core/prepare/geometry.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "core/geometry/mesh/mesh.hpp"

namespace crt::core {

namespace {

/// Returns the triangles of a mesh that has warnings which nobody has had, or null.
std::shared_ptr<const MeshTriangles> untold_mesh(const Leaf& leaf) {
  const auto& mesh = dynamic_cast<const MeshShape&>(*leaf.shape);
  const MeshReport& report = mesh.triangles().report();
  return report.reported || report.warnings.empty() ? nullptr : mesh.shared_triangles();
}

}  // namespace

Geometry::Geometry(CompiledScene compiled, Precision of_scene, const Workers& workers)
    : precision(of_scene),
      has_csg(!compiled.programs.empty() || !compiled.prototypes.empty()),
      accelerator(std::move(compiled), workers) {
  list_meshes();
}

Geometry::Geometry(RecompiledScene recompiled, const Geometry& earlier, const Workers& workers)
    : precision(earlier.precision),
      has_csg(!recompiled.scene.programs.empty() || !recompiled.scene.prototypes.empty()),
      accelerator(std::move(recompiled), &earlier.accelerator, workers) {
  list_meshes();
}

void Geometry::list_meshes() {
  const CompiledScene& compiled = accelerator.compiled();
  std::set<const MeshTriangles*> seen;
  const auto list_those_of = [&](const CompiledScene& scene) {
    for (const std::uint32_t leaf : scene.meshes) {
      std::shared_ptr<const MeshTriangles> mesh = untold_mesh(scene.leaves[leaf]);
      if (mesh != nullptr && seen.insert(mesh.get()).second) meshes.push_back(std::move(mesh));
    }
  };
  list_those_of(compiled);
  for (const Prototype& prototype : compiled.prototypes) list_those_of(*prototype.scene);
}

}  // namespace crt::core
