// The density of a solid is what the materials of its parts say.
#include <optional>
#include <set>
#include <utility>
#include <variant>
#include <vector>

#include "core/entity/entity_node.hpp"
#include "crt/error.hpp"
#include "crt/measure.hpp"
#include "text/format.hpp"

namespace crt {

namespace core {

namespace {

/// Finds the densities of the parts that a solid is made of, each node once for what is around it.
class DensitySearch {
 public:
  double find(const Entity& entity) {
    add(&entity.node(), 0);
    while (!open_.empty()) {
      const auto [node, around] = open_.back();
      open_.pop_back();
      look_at(*node, around);
    }
    return found_.value_or(0);
  }

 private:
  void add(const EntityNode* node, double around) {
    if (seen_.emplace(node, around).second) open_.emplace_back(node, around);
  }

  void look_at(const EntityNode& node, double around) {
    if (const auto* wrapper = std::get_if<EntityWrapper>(&node.content)) {
      add(wrapper->child.get(), wrapper->material ? (*wrapper->material)->density : around);
    } else if (const auto* operation = std::get_if<CsgOperation>(&node.content)) {
      for (const EntityPointer& part : operation->parts) {
        add(part.get(), around);
        if (operation->op != CsgOperator::set_union) break;
      }
    } else {
      const std::optional<SharedMaterial> own = std::visit(
          [](const auto& shape) { return shape.material; }, std::get<Primitive>(node.content));
      take(own ? (*own)->density : around);
    }
  }

  void take(double density) {
    if (found_.value_or(density) != density) {
      throw Error(
          ErrorCode::invalid_argument,
          text::format("parts of it have different densities, such as {} and {} kg/m3: make "
                       "them entities of their own",
                       *found_, density));
    }
    found_ = density;
  }

  std::vector<std::pair<const EntityNode*, double>> open_;
  std::set<std::pair<const EntityNode*, double>> seen_;
  std::optional<double> found_;
};

}  // namespace

}  // namespace core

double density(const Entity& entity) {
  return core::DensitySearch().find(entity);
}

}  // namespace crt
