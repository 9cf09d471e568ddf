// The CSG tree as a user builds it consists of immutable nodes, which entities share.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "core/math/transform_chain.hpp"
#include "crt/entity.hpp"

namespace crt {

using EntityPointer = std::shared_ptr<const EntityNode>;

enum class CsgOperator { set_union, intersection, difference };

/// A CsgOperation combines at least two parts, none of them empty. A difference takes all others
/// from the first. The empty entity is a union without parts, and no part of anything.
struct CsgOperation {
  CsgOperator op = CsgOperator::set_union;
  std::vector<EntityPointer> parts;
};

/// An EntityWrapper has what is put around an entity: where it is, its material, its numbers, and
/// what meets it.
/// Wrappers never nest. Wrapping one again makes a new one around the same child, so chains of a
/// million transforms cost nothing later.
struct EntityWrapper {
  /// The map is behind a pointer, as most nodes are primitives and all nodes have one size. Null
  /// leaves the child as it is.
  std::shared_ptr<const core::TransformChain> to_parent;
  std::optional<SharedMaterial> material;  ///< for parts without one of their own
  std::optional<std::uint32_t> id;
  std::optional<std::uint64_t> user;  ///< for parts without one of their own
  // These are false at most around what is no part of anything.
  bool casts_shadow = true;
  bool visible = true;
  EntityPointer child;
};

struct EntityNode {
  using Content = std::variant<Primitive, CsgOperation, EntityWrapper>;

  explicit EntityNode(Content new_content);
  EntityNode(const EntityNode&) = delete;
  EntityNode& operator=(const EntityNode&) = delete;
  /// Frees without recursion, however deep the tree is, and without allocating.
  ~EntityNode();

  Content content;
  bool solid = true;
  /// This counts the leaves of the tree below, each path to one. It saturates at the largest value.
  std::uint32_t leaf_count = 1;
  /// This counts the primitives of these leaves likewise. A mesh is as many as it has triangles.
  std::uint64_t primitive_count = 1;

 private:
  EntityPointer next_to_free_;
};

}  // namespace crt
