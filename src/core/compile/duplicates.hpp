// What a scene has twice at one place counts once. This is the second step of compile().
#pragma once

#include <span>

#include "core/compile/flatten.hpp"

namespace crt::core {

/// Removes duplicates from a flat scene: objects that are there already, and children of a CSG node
/// that are equal to an earlier child (a + a = a, a ^ a = a). No ray ever sees them. Primitives are
/// equal if they have the same numbers and the same map to the world, and trees are equal if their
/// parts are. Objects that other rays pass are no duplicates.
///
/// In a tree the first child is seen whatever the others are made of. Objects count as equal only
/// if they are made of the same materials, or of materials that let no light through.
///
/// `leaves` and `faces` are the scene's, with their surfaces numbered. If this returns true,
/// something was removed, and they do not belong to the scene any more. FlatScene::entity_ends are
/// kept unless an object was removed, as then an entity depends on others. It takes O(n log n), and
/// O(n) where no two leaves begin with the same surface.
bool remove_duplicates(FlatScene& scene, std::span<const Leaf> leaves,
                       std::span<const FaceSurface> faces, const Workers& workers = {});

/// Removes instances that are there already: of one prototype and with one map to the world.
void remove_equal_instances(FlatScene& scene, const Workers& workers = {});

}  // namespace crt::core
