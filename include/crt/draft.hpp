// A draft is a scene whose picture takes less time.
#pragma once

#include <crt/scene.hpp>

namespace crt {

/// Returns a draft of a scene. Its picture has a pixel for `step` by `step` of the whole one, and
/// at least one across and down. Each pixel is that of a single ray from the camera, without a
/// lens. All else is as in the scene, so PrepareOptions::earlier prepares a draft with little work.
/// Throws Error (invalid_argument) if `step` is below 1.
Scene draft_of(Scene scene, int step);

}  // namespace crt
