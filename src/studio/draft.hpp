// These functions say what of a scene its drafts and channels need.
#pragma once

#include <crt/scene.hpp>
#include <vector>

namespace crt::studio {

/// Returns the scene for channels that need no light.
Scene geometry_of(Scene scene);

/// Says whether a scene takes one sample a pixel, as the finest draft does.
bool is_its_own_draft(const Scene& scene);

/// Returns drafts that take 4, 16, ... samples a pixel, for a scene with a plain grid. Together
/// they take a third of the samples of the scene's picture at most.
std::vector<Scene> finer_drafts(const Scene& scene);

}  // namespace crt::studio
