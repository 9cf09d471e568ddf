// These functions say what of a scene its drafts and channels need.
#pragma once

#include <crt/scene.hpp>

namespace crt::studio {

/// Returns the scene for channels that need no light.
Scene geometry_of(Scene scene);

/// Says whether a scene takes one sample a pixel, as the finest draft does.
bool is_its_own_draft(const Scene& scene);

}  // namespace crt::studio
