// Modes show a scene in a light of the studio's own: its materials, or its shapes in clay.
#pragma once

#include <crt/prepared_scene.hpp>
#include <crt/scene.hpp>
#include <functional>

namespace crt::studio {

/// Says in what light a scene is shown, and of what material.
enum class ViewMode {
  rendered,  ///< as it is
  material,  ///< its materials in a studio, whose light passes all that is in the way
  clay,      ///< all in a grey without gloss, below a soft sky
};

/// Returns the material of what a section cuts, which no mode replaces.
const SharedMaterial& cut_material();

/// Returns the scene in the light of a mode. That does not turn with the camera, but faces what
/// `front`, the scene's own camera, looks at. Entities are other ones in ViewMode::material.
Scene scene_in_mode(Scene scene, ViewMode mode, const Camera& front);

/// Returns PrepareOptions::material of a mode.
std::function<SharedMaterial(const SharedMaterial&)> materials_of(ViewMode mode);

}  // namespace crt::studio
