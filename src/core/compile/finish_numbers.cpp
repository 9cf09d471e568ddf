// What depends on the numbers of a whole scene is found here when its lists are there.
#include <algorithm>
#include <tuple>

#include "core/compile/compile.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

/// Lists the faces of a leaf of many that lie on surfaces of leaves before it.
std::unique_ptr<const SharedFaces> shared_faces_of(const Leaf& leaf,
                                                   std::span<const FaceSurface> faces) {
  SharedFaces shared;
  for (std::uint32_t face = 0; face < leaf.face_count; ++face) {
    const std::uint32_t surface = faces[leaf.first_face + face].surface;
    if (surface < leaf.first_face) shared.faces.push_back({surface, leaf.face_at(face)});
  }
  if (shared.faces.empty()) return nullptr;
  std::sort(shared.faces.begin(), shared.faces.end(), [](const auto& a, const auto& b) {
    return std::tie(a.surface, a.face) < std::tie(b.surface, b.face);
  });
  return std::make_unique<const SharedFaces>(std::move(shared));
}

}  // namespace

void list_shared_faces(Leaf& leaf, std::span<const FaceSurface> faces) {
  if (leaf.face_count > Leaf::few_faces) leaf.shared_faces = shared_faces_of(leaf, faces);
}

void finish_numbers(CompiledScene& scene) {
  std::uint64_t first_leaf = scene.leaves.size();
  std::vector<std::uint32_t> of_instances;
  of_instances.reserve(scene.instances.size());
  for (const Instance& instance : scene.instances) {
    of_instances.push_back(static_cast<std::uint32_t>(first_leaf));
    first_leaf += scene.prototypes[instance.prototype].scene->leaves.size();
    if (first_leaf < invalid_index) continue;
    throw Error(
        ErrorCode::limit,
        text::format("the instances of the scene have more than {} primitives", invalid_index),
        "entities");
  }
  for (SceneObject& object : scene.objects) {
    if (object.is_instance()) object.first_leaf = of_instances[object.instance];
    if (!object.is_csg()) continue;
    const std::span<const Leaf> leaves = scene.leaves_of(object);
    const std::uint32_t begin = leaves.front().first_face;
    const std::uint32_t end = leaves.back().first_face + leaves.back().face_count;
    const auto faces = std::span(scene.face_surfaces).subspan(begin, end - begin);
    object.shares_surfaces = std::any_of(
        faces.begin(), faces.end(), [&](const FaceSurface& face) { return face.surface < begin; });
  }
}

}  // namespace crt::core
