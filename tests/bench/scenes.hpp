// Scenes to measure with, each heavy in one thing.
#pragma once

#include <crt/scene.hpp>

namespace crt::bench {

/// n x n x n separate balls: mostly the acceleration structure.
Scene balls(int n);

/// n x n drilled blocks, eight cutters each: mostly intervals of CSG.
Scene drilled_blocks(int n);

/// Rings, cones and cylinders side by side: mostly the primitives' own equations.
Scene curved(int n);

/// Mirrors and glass under three lights: mostly secondary rays.
Scene glass_and_mirrors();

}  // namespace crt::bench
