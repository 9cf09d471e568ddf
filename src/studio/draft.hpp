// A draft is a scene whose picture takes less time.
#pragma once

#include <crt/scene.hpp>

namespace crt::studio {

/// Returns a scene whose picture has a pixel for `step` by `step` of the whole one, and each of a
/// single ray from the camera.
Scene draft_of(Scene scene, int step);

/// Returns the scene for channels that need no light.
Scene geometry_of(Scene scene);

/// Says whether a scene takes one sample a pixel, as the finest draft does.
bool is_its_own_draft(const Scene& scene);

}  // namespace crt::studio
