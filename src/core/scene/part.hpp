#pragma once

#include <cstdint>

#include "core/csg/entity_node.hpp"

namespace crt::core {

/// A subtree of an entity with all that was decided above it.
struct Part {
  const EntityNode* node = nullptr;
  PreciseTransform to_world;
  const SharedMaterial* material = nullptr;  ///< for leaves without one of their own
  std::uint32_t id = 0;
  bool id_is_final = false;  ///< a with_id above: inner ones no longer count

  /// The part with wrappers around its node opened and applied.
  Part unwrapped() const {
    Part inner = *this;
    while (const auto* wrapper = std::get_if<EntityWrapper>(&inner.node->content)) {
      inner.node = wrapper->child.get();
      inner.to_world = compose(inner.to_world, wrapper->to_parent);
      // An inner material is nearer to the leaves, an outer id nearer to the user.
      if (wrapper->material) inner.material = &*wrapper->material;
      if (wrapper->id && !inner.id_is_final) {
        inner.id = *wrapper->id;
        inner.id_is_final = true;
      }
    }
    return inner;
  }

  /// A child of this part's operation.
  Part child(const EntityPointer& pointer) const {
    Part result = *this;
    result.node = pointer.get();
    return result.unwrapped();
  }
};

}  // namespace crt::core
