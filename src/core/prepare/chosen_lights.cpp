#include "core/prepare/chosen_lights.hpp"

#include <algorithm>

#include "core/base/invalid_index.hpp"

namespace crt::core {

namespace {

/// Larger meshes would take too much memory.
constexpr std::uint32_t max_faces = 1u << 17;

/// Returns what a material gives off, if it is the same everywhere.
Rgb even_emission(const PreparedMaterial& material) {
  const bool varies = material.principled && material.principled->emission;
  return varies || !material.opaque ? Rgb(0) : rgb(material.description->emission);
}

}  // namespace

std::unique_ptr<const ChosenLights> ChosenLights::of(const CompiledScene& scene,
                                                     const MaterialTable& table,
                                                     std::span<const PreparedMaterial> materials,
                                                     bool any_emits,
                                                     std::span<const Light> lights) {
  std::unique_ptr<ChosenLights> result(new ChosenLights);
  std::vector<PreparedLight>& chosen = result->lights_;
  for (const Light& light : lights) {
    const PreparedLight prepared(light, FalloffModel::light);
    if (prepared.has_extent()) chosen.push_back(prepared);
  }
  result->has_lights_of_scene_ = chosen.size() > max_asked;
  if (!result->has_lights_of_scene_) chosen.clear();
  if (any_emits) {
    for (const SceneObject& object : scene.objects) {
      if (object.is_csg() || object.is_instance()) continue;
      result->add_surface(scene, object.first_leaf, table.of_leaves[object.first_leaf], materials);
    }
  }
  if (chosen.empty()) return nullptr;
  auto tree = std::make_unique<LightTree>(chosen);
  if (tree->empty()) return nullptr;
  result->tree_ = std::move(tree);
  return result;
}

void ChosenLights::add_surface(const CompiledScene& scene, std::uint32_t number,
                               std::uint32_t first_material,
                               std::span<const PreparedMaterial> materials) {
  const Leaf& leaf = scene.leaves[number];
  const auto of_leaf = materials.subspan(first_material, leaf.material_count());
  const auto shines = [](const PreparedMaterial& material) {
    return even_emission(material) != Rgb(0);
  };
  if (leaf.face_count > max_faces || leaf.complemented ||
      std::none_of(of_leaf.begin(), of_leaf.end(), shines))
    return;
  SurfacePieces pieces = leaf.shape->pieces();
  for (SurfacePiece& piece : pieces) {
    const std::optional<SurfacePiece> placed = placed_piece(piece, *leaf.placement);
    if (!placed) return;
    piece = *placed;
  }
  if (pieces.empty()) return;
  if (of_leaves_.empty()) of_leaves_.assign(scene.leaves.size(), invalid_index);
  of_leaves_[number] = static_cast<std::uint32_t>(lights_.size());
  for (std::uint32_t face = 0; face < pieces.size(); ++face) {
    const Rgb radiance = even_emission(materials[first_material + leaf.material_place(face)]);
    lights_.emplace_back(pieces[face], radiance, !leaf.of_solid);
  }
}

std::size_t ChosenLights::bytes() const {
  return lights_.capacity() * sizeof(PreparedLight) + tree_->bytes() +
         of_leaves_.capacity() * sizeof(std::uint32_t);
}

}  // namespace crt::core
