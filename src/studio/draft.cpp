#include "studio/draft.hpp"

#include <crt/draft.hpp>
#include <utility>

namespace crt::studio {

Scene geometry_of(Scene scene) {
  scene = draft_of(std::move(scene), 1);
  scene.settings.recursion_depth = 0;
  return scene;
}

bool is_its_own_draft(const Scene& scene) {
  const Settings& settings = scene.settings;
  return settings.supersampling == 1 && settings.target_error == 0 && settings.time_budget == 0 &&
         (settings.dof_samples == 1 || !has_lens(scene.camera));
}

}  // namespace crt::studio
