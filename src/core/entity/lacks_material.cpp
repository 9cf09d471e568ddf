// This file asks whether an entity has parts without a material.
#include <cstddef>
#include <variant>
#include <vector>

#include "core/entity/entity_node.hpp"
#include "crt/validate.hpp"

namespace crt {

bool lacks_material(const Entity& entity) {
  constexpr std::size_t max_nodes = 256;
  std::vector<const EntityNode*> open = {&entity.node()};
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (open.size() > max_nodes) return true;
    const EntityNode::Content& content = open[i]->content;
    if (const auto* wrapper = std::get_if<EntityWrapper>(&content)) {
      if (!wrapper->material) open.push_back(wrapper->child.get());
    } else if (const auto* operation = std::get_if<CsgOperation>(&content)) {
      for (const EntityPointer& part : operation->parts) open.push_back(part.get());
    } else {
      const bool has_material =
          std::visit([](const auto& shape) { return shape.material.has_value(); },
                     std::get<Primitive>(content));
      if (!has_material) return true;
    }
  }
  return false;
}

}  // namespace crt
