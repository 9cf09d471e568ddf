#include "core/prepare/recolour.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <numeric>
#include <vector>

#include "core/compile/flatten.hpp"
#include "core/compile/material_numbering.hpp"
#include "core/geometry/description.hpp"
#include "core/shading/opacity.hpp"

namespace crt::core {

namespace {

bool are_same_maps(const TransformChain* a, const TransformChain* b) {
  if (a == b) return true;
  if (a == nullptr || b == nullptr || !a->is_plain() || !b->is_plain()) return false;
  const Transform one = a->product.rounded();
  const Transform other = b->product.rounded();
  using Bits = std::array<std::uint64_t, 12>;  // 0 and -0 differ
  return std::bit_cast<Bits>(one) == std::bit_cast<Bits>(other);
}

bool are_same_shapes(const EntityNode& a, const EntityNode& b) {
  if (&a == &b) return true;
  const auto* const one = std::get_if<Primitive>(&a.content);
  const auto* const other = std::get_if<Primitive>(&b.content);
  return one != nullptr && other != nullptr && one->index() == other->index() &&
         std::ranges::equal(description_of(*one), description_of(*other));
}

/// Returns whether two entities are the same but for their materials.
bool are_same_but_for_materials(const EntityNode& a, const EntityNode& b) {
  static const EntityWrapper none;
  const auto* one = std::get_if<EntityWrapper>(&a.content);
  const auto* other = std::get_if<EntityWrapper>(&b.content);
  if (!are_same_shapes(one == nullptr ? a : *one->child, other == nullptr ? b : *other->child))
    return false;
  if (one == nullptr) one = &none;
  if (other == nullptr) other = &none;
  return are_same_maps(one->to_parent.get(), other->to_parent.get()) && one->id == other->id &&
         one->user == other->user && one->casts_shadow == other->casts_shadow &&
         one->visible == other->visible;
}

}  // namespace

std::shared_ptr<const MaterialTable> recoloured(const CompiledScene& scene,
                                                const MaterialTable& materials,
                                                const NodeList& nodes,
                                                std::span<const Entity> entities,
                                                std::span<const std::uint32_t> places,
                                                Precision precision, const Workers& workers) {
  // The materials of instances are a part of what they share.
  if (scene.entity_ends.empty() || !scene.instances.empty()) return nullptr;
  for (const std::uint32_t place : places) {
    if (!are_same_but_for_materials(*nodes[place], entities[place].node())) return nullptr;
  }
  std::vector<Entity> others;
  for (const std::uint32_t place : places) others.push_back(entities[place]);
  std::vector<std::uint32_t> all(others.size());
  std::iota(all.begin(), all.end(), 0u);
  const FlatScene flat =
      flatten(others, all, Instancing(), {}, precision, workers, PrimitiveLimit());

  // Its leaves stand in the order of the scene's. Their materials get numbers after all others.
  const auto first = static_cast<std::uint32_t>(materials.list.size());
  std::vector<std::uint32_t> numbers = materials.of_leaves;
  std::size_t next = 0;
  for (const std::uint32_t place : places) {
    const std::uint32_t end = scene.entity_ends[place].leaf;
    for (std::uint32_t i = place == 0 ? 0 : scene.entity_ends[place - 1].leaf; i < end; ++i) {
      if (next == flat.leaves.size()) return nullptr;
      const LeafSource& leaf = flat.leaves[next++];
      if (leaf.has_materials || scene.leaves[i].has_materials ||
          lets_light_in(*materials.list[numbers[i]]) ||
          lets_light_in(*flat.materials[leaf.material]))
        return nullptr;
      numbers[i] = first + leaf.material;
    }
  }
  if (next != flat.leaves.size()) return nullptr;

  MaterialNumbering numbering;
  std::vector<std::uint32_t> renumbered(first + flat.materials.size(), invalid_index);
  for (std::uint32_t i = 0; i < numbers.size(); ++i) {
    std::uint32_t& result = renumbered[numbers[i]];
    if (result == invalid_index) {
      const bool is_new = numbers[i] >= first;
      const std::uint32_t number = is_new ? numbers[i] - first : numbers[i];
      const auto& list = is_new ? flat.materials : materials.list;
      if (scene.leaves[i].has_materials) {
        result = numbering.number(*scene.leaves[i].shape->facet_attributes());
      } else if (number == (is_new ? flat.default_material : materials.default_material)) {
        result = numbering.number(nullptr);
      } else {
        result = numbering.number(&list[number]);
      }
    }
    numbers[i] = result;
  }
  auto table = std::make_shared<MaterialTable>();
  table->list = numbering.take_materials();
  table->default_material = numbering.default_number();
  table->of_leaves = std::move(numbers);
  return table;
}

}  // namespace crt::core
