#include "crt/draft.hpp"

#include <algorithm>

#include "crt/error.hpp"

namespace crt {

Scene draft_of(Scene scene, int step) {
  if (step < 1)
    throw Error(ErrorCode::invalid_argument, "the step of a draft must be at least 1", "step");
  Settings& settings = scene.settings;
  settings.width = std::max(1, settings.width / step);
  settings.height = std::max(1, settings.height / step);
  settings.supersampling = settings.dof_samples = 1;
  settings.target_error = settings.time_budget = 0;
  scene.camera.aperture = scene.camera.lens_radius = 0;
  return scene;
}

}  // namespace crt
