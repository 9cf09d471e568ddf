// This file finds a colour for formats that have one for all of an entity.
#include <algorithm>
#include <variant>

#include "core/entity/entity_node.hpp"
#include "crt/principled.hpp"
#include "crt/surface_mesh.hpp"

namespace crt {

namespace {

/// Returns the material of the first primitive: its own, or else the innermost around it.
std::optional<SharedMaterial> first_material(const Entity& entity) {
  std::optional<SharedMaterial> around;
  const EntityNode* node = &entity.node();
  for (;;) {
    if (const auto* wrapper = std::get_if<EntityWrapper>(&node->content)) {
      if (wrapper->material) around = wrapper->material;
      node = wrapper->child.get();
    } else if (const auto* operation = std::get_if<CsgOperation>(&node->content)) {
      if (operation->parts.empty()) return around;
      node = operation->parts.front().get();
    } else {
      const std::optional<SharedMaterial> own = std::visit(
          [](const auto& shape) { return shape.material; }, std::get<Primitive>(node->content));
      return own ? own : around;
    }
  }
}

}  // namespace

std::optional<Color> plain_color(const Entity& entity) {
  const std::optional<SharedMaterial> material = first_material(entity);
  if (!material) return {};
  const PrincipledMaterial* const principled = material->principled();
  const std::variant<Color, Pattern>& color =
      principled != nullptr ? principled->color : (*material)->color;
  const Color* const plain = std::get_if<Color>(&color);
  if (plain == nullptr) return {};
  return Color{std::clamp(plain->r, 0.0, 1.0), std::clamp(plain->g, 0.0, 1.0),
               std::clamp(plain->b, 0.0, 1.0), std::clamp(plain->a, 0.0, 1.0)};
}

}  // namespace crt
