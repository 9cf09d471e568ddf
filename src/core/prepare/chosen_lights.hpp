// Surfaces that give light off are lights, and so many lights may be in a scene that a point asks
// only some of them.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/compile/compile.hpp"
#include "core/shading/light_tree.hpp"
#include "core/shading/prepared_material.hpp"
#include "crt/light.hpp"

namespace crt::core {

/// ChosenLights are those of which a point asks one by how much it may matter: pieces of surfaces
/// that give light off and, where the scene has more than `max_asked` lights with an extent, these.
class ChosenLights {
 public:
  static constexpr std::size_t max_asked = 16;

  /// Returns those of a scene, or null if there are none. `table` is that of its materials.
  /// `any_emits` says whether a material gives light off.
  static std::unique_ptr<const ChosenLights> of(const CompiledScene& scene,
                                                const MaterialTable& table,
                                                std::span<const PreparedMaterial> materials,
                                                bool any_emits, std::span<const Light> lights);

  const std::vector<PreparedLight>& lights() const { return lights_; }
  const LightTree& tree() const { return *tree_; }

  /// Returns the number in lights() of a face of a leaf, or invalid_index if no samples are taken
  /// of it.
  std::uint32_t of_face(std::uint32_t leaf, std::uint32_t face) const {
    if (leaf >= of_leaves_.size() || of_leaves_[leaf] == invalid_index) return invalid_index;
    return of_leaves_[leaf] + face;
  }
  /// Returns whether the lights of the scene with an extent are among them. Their numbers are then
  /// counted among these, from 0.
  bool has_lights_of_scene() const { return has_lights_of_scene_; }

  /// Returns the bytes of memory that they take.
  std::size_t bytes() const;

 private:
  ChosenLights() = default;
  /// Adds the faces of a leaf by its number, if it gives light off evenly and has a formula for
  /// them.
  void add_surface(const CompiledScene& scene, std::uint32_t number, std::uint32_t first_material,
                   std::span<const PreparedMaterial> materials);

  std::vector<PreparedLight> lights_;
  std::unique_ptr<const LightTree> tree_;
  std::vector<std::uint32_t> of_leaves_;  ///< the number of face 0, or invalid_index
  bool has_lights_of_scene_ = false;
};

}  // namespace crt::core
