// The tree of entities is flattened to lists. This is the first step of compile().
#pragma once

#include <span>
#include <vector>

#include "core/compile/compile.hpp"
#include "core/compile/instancing.hpp"
#include "core/compile/part.hpp"
#include "core/compile/primitive_limit.hpp"
#include "core/tasks/workers.hpp"

namespace crt::core {

/// A LeafSource is what a leaf is to be made of.
struct LeafSource {
  const Primitive* primitive = nullptr;
  std::uint32_t placement = 0;  ///< index into FlatScene::placements
  std::uint32_t material = 0;
  std::uint32_t entity_id = 0;
  std::uint32_t part_id = 0;
  std::uint64_t user = 0;
  bool complemented = false;
  bool has_materials = false;  ///< of facets, which come next
  bool is_mesh = false;
  bool takes_entity_id = false;  ///< as in Leaf
  bool takes_part_id = false;
  bool takes_user = false;
};

/// A PrototypeSource is what instances share: a node, with the material of parts without one.
struct PrototypeSource {
  const EntityNode* node = nullptr;
  const SharedMaterial* material = nullptr;
};

struct FlatScene {
  TransformPool transforms;
  std::vector<LeafSource> leaves;
  std::vector<std::uint32_t> programs_of_leaves;  ///< or no_program
  std::vector<const TransformChain*> placements;
  std::vector<SceneObject> objects;  ///< without bounds
  std::vector<CsgProgram>
      programs;  ///< nodes and parents of leaves only; an AND needs all_children
  std::vector<SharedMaterial> materials;
  std::uint32_t default_material = invalid_index;
  std::vector<EntityEnds> entity_ends;
  Instancing::Count count;                ///< of all entities of the scene
  std::uint64_t expanded_primitives = 0;  ///< of these, in copies that touch others
  std::vector<Instance> instances;
  std::vector<PrototypeSource> prototypes;
};

/// Marks a node that is an AND until its children are counted.
inline constexpr std::uint32_t all_children = 0xffffffffu;

/// Walks through those entities that have these places in a scene, without recursion, however deep
/// they are. The entities must outlive the placements. `instancing` and `count` are those of all.
/// Throws Error (limit) if the scene has too many primitives.
FlatScene flatten(std::span<const Entity> entities, std::span<const std::uint32_t> places,
                  Instancing instancing, const Instancing::Count& count, Precision precision,
                  const Workers& workers, const PrimitiveLimit& limit);
/// Makes one object of a prototype, in its own space.
FlatScene flatten(const PrototypeSource& prototype, Precision precision, const Workers& workers);

}  // namespace crt::core
