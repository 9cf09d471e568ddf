#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "core/entity/entity_node.hpp"

namespace crt::core {

/// A TransformPool has the products of transforms that are applied one after another. A null
/// pointer is no transform at all.
class TransformPool {
 public:
  const TransformChain* composed(const TransformChain* second, const TransformChain* first) {
    if (second == nullptr) return first;
    return first == nullptr ? second : &transforms_.emplace_back(compose(*second, *first));
  }

  /// Returns the bytes of memory it takes.
  std::size_t bytes() const { return transforms_.size() * sizeof(TransformChain); }

 private:
  std::deque<TransformChain> transforms_;
};

/// A Part is a subtree of an entity with all that was decided above it.
struct Part {
  const EntityNode* node = nullptr;
  const TransformChain* to_world = nullptr;  ///< of a TransformPool or of the entity
  const SharedMaterial* material = nullptr;  ///< for leaves without one of their own
  std::uint32_t id = 0;
  bool id_is_final = false;   ///< a with_id above overrides inner ones
  std::uint32_t part_id = 0;  ///< of the innermost with_id, or the entity's place in the scene
  bool has_part_id = false;   ///< from a with_id
  std::optional<std::uint64_t> user{};  ///< of the innermost with_user

  /// Returns the part with the wrappers around its node removed and applied.
  Part unwrapped(TransformPool& pool) const {
    Part inner = *this;
    while (const auto* wrapper = std::get_if<EntityWrapper>(&inner.node->content)) {
      inner.node = wrapper->child.get();
      inner.to_world = pool.composed(inner.to_world, wrapper->to_parent.get());
      // An inner material is nearer to the leaves, an outer id nearer to the user.
      if (wrapper->material) inner.material = &*wrapper->material;
      if (wrapper->id && !inner.id_is_final) {
        inner.id = *wrapper->id;
        inner.id_is_final = true;
      }
      if (wrapper->id) {
        inner.part_id = *wrapper->id;
        inner.has_part_id = true;
      }
      if (wrapper->user) inner.user = wrapper->user;
    }
    return inner;
  }

  /// Returns a child of this part's operation.
  Part child(const EntityPointer& pointer, TransformPool& pool) const {
    Part result = *this;
    result.node = pointer.get();
    return result.unwrapped(pool);
  }

  /// Returns the operation that the part is, or null if it is none.
  const CsgOperation* operation() const { return std::get_if<CsgOperation>(&node->content); }
};

}  // namespace crt::core
