// This file finds what is not wrong with a scene but most likely not meant.
#include <algorithm>
#include <string>
#include <vector>

#include "core/geometry/mesh/mesh.hpp"
#include "core/prepare/geometry.hpp"
#include "core/prepare/prepared_data.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::core {

void PreparedData::warn_of_no_light() {
  warnings_.emplace_back(
      scene_.lights.empty() ? "the scene has no lights: only mirrors, glass and the background show"
                            : "the scene has no lights: a head light shines from the camera");
}

/// Warns if the lens has no effect, and if the camera is on a surface or within what is opaque. A
/// scene where the latter takes long to find out is not warned of.
void PreparedData::warn_of_camera() {
  // In a scene of 2015 every camera has a lens.
  const Camera& camera = scene_.camera;
  if (has_lens(camera) && scene_.settings.dof_samples == 1 && scene_.settings.compat == 0) {
    warnings_.push_back(
        text::format("the camera's {} has no effect, as dofsamples is 1: all is sharp",
                     camera.aperture > 0 ? "aperture" : "lensradius"));
  }
  if (scene_.camera.projection == Projection::orthographic) return;
  constexpr std::uint64_t few_steps = 4096;
  const StepRules rules{.most = few_steps, .poll = {}};
  RayWorkspace work;
  work.csg.steps.rules = &rules;
  try {
    const Vec3& position = scene_.camera.position;
    if (is_on_surface(position, work)) {
      warnings_.emplace_back(
          "the camera is on the surface of an object: rounding decides what it sees");
      return;
    }
    std::vector<RayHit> exits;
    containing_solids(
        {.origin = position, .direction = normalize(scene_.camera.pointing - position)}, exits,
        work);
    const bool is_enclosed = std::any_of(exits.begin(), exits.end(), [this](const RayHit& exit) {
      return materials_[hit_material(exit)].opaque && !is_passed(exit.object, passing_camera);
    });
    if (is_enclosed)
      warnings_.emplace_back(
          "the camera is inside an object that is not transparent: it sees that from within");
  } catch (const Error&) {
  }
}

/// Tells what is known of meshes that programs have made, once for each.
void PreparedData::warn_of_meshes() {
  for (const auto& mesh : entities_.geometry->meshes) {
    const MeshReport& report = mesh->report();
    const std::string name = report.name.empty() ? "a mesh" : text::format("'{}'", report.name);
    for (const std::string& warning : report.warnings)
      warnings_.push_back(text::format("{}: {}", name, warning));
  }
}

}  // namespace crt::core
