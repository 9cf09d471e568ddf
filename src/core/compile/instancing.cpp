#include "core/compile/instancing.hpp"

#include <algorithm>
#include <functional>
#include <unordered_set>
#include <vector>

namespace crt::core {

namespace {

/// Copies that are used less often are compiled each for itself, which makes rays faster.
constexpr std::uint64_t fewest_uses = 16;
/// So are copies that have fewer primitives all together.
constexpr std::uint64_t fewest_primitives = std::uint64_t{1} << 15;

/// Counts an entity of several primitives. There may be very many of more than a number holds.
std::uint64_t in_several(const EntityNode& entity) {
  return entity.primitive_count < 2 ? 0 : std::min(entity.primitive_count, fewest_primitives);
}

std::uint64_t counted_primitives(const EntityNode& entity) {
  constexpr std::uint64_t too_many = std::uint64_t{1} << 26;
  return std::min(entity.primitive_count, too_many);
}

const EntityNode& without_wrapper(const EntityNode& node) {
  const auto* const wrapper = std::get_if<EntityWrapper>(&node.content);
  return wrapper == nullptr ? node : *wrapper->child;
}

const CsgOperation* union_of(const EntityNode& node) {
  const auto* const operation = std::get_if<CsgOperation>(&node.content);
  return operation != nullptr && operation->op == CsgOperator::set_union ? operation : nullptr;
}

}  // namespace

bool repeats(const CsgOperation& operation, std::size_t part) {
  const std::size_t first = operation.op == CsgOperator::difference ? 1 : 0;
  return part > first && operation.parts[part] == operation.parts[part - 1];
}

Instancing::Instancing(std::span<const Entity> entities) {
  std::uint64_t primitives = 0;
  for (const Entity& entity : entities) primitives += in_several(entity.node());
  if (primitives < fewest_primitives) return;
  std::vector<const EntityNode*> open;
  const auto use = [&](const EntityNode& wrapped) {
    if (wrapped.primitive_count < 2) return;  // not worth sharing, nor any part of it
    const EntityNode& node = without_wrapper(wrapped);
    if (++uses_[&node] == 1 && union_of(node) != nullptr) open.push_back(&node);
  };
  for (const Entity& entity : entities) {
    use(entity.node());
    while (!open.empty()) {
      const CsgOperation& operation = *union_of(*open.back());
      open.pop_back();
      for (std::size_t i = 0; i < operation.parts.size(); ++i) {
        if (!repeats(operation, i)) use(*operation.parts[i]);
      }
    }
  }
  std::erase_if(uses_, [](const auto& used) {
    const auto& [node, uses] = used;
    // Unions of surfaces are as many objects.
    const bool is_one_object = node->solid || std::holds_alternative<Primitive>(node->content);
    const std::uint64_t count = std::min(node->primitive_count, fewest_primitives);
    return !is_one_object || uses < fewest_uses || count * uses < fewest_primitives;
  });
}

void Instancing::add(const EntityNode& entity, Count& count) {
  count.primitives += counted_primitives(entity);
  count.in_several += in_several(entity);
}

void Instancing::remove(const EntityNode& entity, Count& count) {
  count.primitives -= counted_primitives(entity);
  count.in_several -= in_several(entity);
}

bool Instancing::may_share(const Count& count) {
  return count.in_several >= fewest_primitives;
}

std::vector<const EntityNode*> Instancing::shared_nodes() const {
  std::vector<const EntityNode*> nodes;
  nodes.reserve(uses_.size());
  for (const auto& [node, uses] : uses_) nodes.push_back(node);
  std::sort(nodes.begin(), nodes.end(), std::less<>());
  return nodes;
}

Instancing::Count Instancing::count(std::span<const Entity> entities, std::uint64_t most) const {
  Count result;
  std::unordered_set<const EntityNode*> compiled;
  std::vector<const EntityNode*> open;
  for (const Entity& entity : entities) {
    result.in_several += in_several(entity.node());
    open.push_back(&entity.node());
    while (!open.empty() && result.primitives <= most && result.instances <= most) {
      const EntityNode& node = without_wrapper(*open.back());
      open.pop_back();
      const bool is_shared_node = is_shared(node);
      const CsgOperation* const parts = union_of(node);
      if (is_shared_node) ++result.instances;
      if (parts == nullptr || is_shared_node || uses_.empty()) {
        const bool is_new = !is_shared_node || compiled.insert(&node).second;
        if (is_new) result.primitives += std::min(node.primitive_count, most + 1);
        continue;
      }
      for (std::size_t i = 0; i < parts->parts.size(); ++i) {
        if (!repeats(*parts, i)) open.push_back(parts->parts[i].get());
      }
    }
  }
  return result;
}

}  // namespace crt::core
