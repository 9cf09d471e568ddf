// These are scenes to measure with, each heavy in one thing.
#pragma once

#include <crt/scene.hpp>

namespace crt::bench {

/// Makes n x n x n separate balls, which mostly use the acceleration structure.
Scene balls(int n);

/// Makes n x n drilled blocks, eight cutters each, which mostly use intervals of CSG.
Scene drilled_blocks(int n);

/// Makes rings, cones and cylinders side by side, which mostly use the primitives' own equations.
Scene curved(int n);

/// Makes mirrors and glass under three lights, which mostly use secondary rays.
Scene glass_and_mirrors();

}  // namespace crt::bench
