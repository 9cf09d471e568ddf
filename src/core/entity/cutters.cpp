#include "crt/cutters.hpp"

#include <utility>

#include "core/entity/entity_node.hpp"

namespace crt {

namespace {

constexpr std::size_t steps_of_cutter = 16;

/// A PlacedNode is a node that is still to be looked at, and how it is moved.
struct PlacedNode {
  EntityPointer node;
  core::PreciseTransform to_world;
  bool is_cutter = false;
};

void push_parts(std::vector<PlacedNode>& stack, const CsgOperation& operation,
                const core::PreciseTransform& to_world) {
  const bool cuts = operation.op == CsgOperator::difference;
  for (std::size_t i = operation.parts.size(); i-- > 0;)
    stack.push_back({operation.parts[i], to_world, cuts && i > 0});
}

}  // namespace

std::vector<Entity> cutters(const Entity& entity, std::size_t most) {
  std::vector<Entity> result;
  std::vector<PlacedNode> stack;
  stack.push_back({entity.shared_node(), core::PreciseTransform(Transform{})});
  for (std::size_t step = 0; step < steps_of_cutter * most && !stack.empty(); ++step) {
    const PlacedNode placed = std::move(stack.back());
    stack.pop_back();
    if (placed.is_cutter) {
      if (result.size() == most) break;
      result.push_back(Entity(placed.node).transformed(placed.to_world.rounded()));
    } else if (const auto* operation = std::get_if<CsgOperation>(&placed.node->content)) {
      push_parts(stack, *operation, placed.to_world);
    } else if (const auto* wrapper = std::get_if<EntityWrapper>(&placed.node->content)) {
      const auto& moves = wrapper->to_parent;
      stack.push_back(
          {wrapper->child, moves ? compose(placed.to_world, moves->product) : placed.to_world});
    }
  }
  return result;
}

}  // namespace crt
