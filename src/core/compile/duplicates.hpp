// What a scene has twice at one place counts once: the second step of compile().
#pragma once

#include <span>

#include "core/compile/flatten.hpp"

namespace crt::core {

/// Takes out of a flat scene every object that is there before, and of each node of a CSG tree the
/// children that are equal to an earlier child (a + a = a, a ^ a = a): no ray ever sees them. Equal
/// are primitives with the same numbers and the same map to the world, and trees of equal ones. In
/// a tree the first is seen whatever the others are made of; of objects those count as equal that
/// are made of the same materials, or of such as let no light through. `leaves` and `faces` are the
/// scene's, with their surfaces numbered; they are no longer of it if this returns true, which says
/// that something was taken out. O(n log n), and O(n) where no two leaves begin with the same
/// surface.
bool remove_duplicates(FlatScene& scene, std::span<const Leaf> leaves,
                       std::span<const FaceSurface> faces, const Workers& workers = {});

}  // namespace crt::core
