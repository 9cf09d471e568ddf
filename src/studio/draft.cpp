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

std::vector<Scene> finer_drafts(const Scene& scene) {
  const Settings& settings = scene.settings;
  if (settings.target_error > 0 || settings.time_budget > 0) return {};
  const bool draws_lens = has_lens(scene.camera) && settings.dof_samples > 1;
  const int samples =
      settings.supersampling * settings.supersampling * (draws_lens ? settings.dof_samples : 1);
  std::vector<Scene> drafts;
  for (int side = 2; 4 * side * side <= samples; side *= 2) {
    Settings& of_draft = drafts.emplace_back(scene).settings;
    of_draft.supersampling = draws_lens ? 1 : side;
    of_draft.dof_samples = draws_lens ? side * side : 1;
  }
  return drafts;
}

}  // namespace crt::studio
