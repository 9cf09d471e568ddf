#include "source/entities.hpp"

#include <array>
#include <vector>

#include "source/shapes.hpp"
#include "source/values.hpp"
#include "text/format.hpp"

namespace crt::source {

namespace {

/// Longer texts get a name.
constexpr std::size_t max_inline = 80;

/// Lists what a node is directly made of.
std::vector<const EntityNode*> children(const EntityNode& node) {
  std::vector<const EntityNode*> result;
  if (const auto* operation = std::get_if<CsgOperation>(&node.content)) {
    for (const EntityPointer& part : operation->parts) result.push_back(part.get());
  } else if (const auto* wrapper = std::get_if<EntityWrapper>(&node.content)) {
    result.push_back(wrapper->child.get());
  }
  return result;
}

/// Lists the maps of a chain in the order in which they are applied.
std::vector<const core::TransformChain*> maps_of(const core::TransformChain& chain) {
  std::vector<const core::TransformChain*> maps;
  std::vector<const core::TransformChain*> open{&chain};
  while (!open.empty()) {
    const core::TransformChain* map = open.back();
    open.pop_back();
    if (map->is_product()) {
      maps.push_back(map);
    } else {
      open.push_back(map->second);
      open.push_back(map->first);
    }
  }
  return maps;
}

bool is_diagonal(const Transform& map) {
  return map == Transform{.row_x = {map.row_x.x, 0, 0},
                          .row_y = {0, map.row_y.y, 0},
                          .row_z = {0, 0, map.row_z.z}};
}

constexpr const char* cpp_functions[] = {"csg_union", "csg_intersection", "csg_difference"};
constexpr const char* python_functions[] = {"crt.union", "crt.intersection", "crt.difference"};
constexpr const char* c_functions[] = {"crt_union_create", "crt_intersection_create",
                                       "crt_difference_create"};
constexpr const char* signs[] = {"+", "^", "-"};

}  // namespace

void EntityWriter::count(const Entity& entity) {
  std::vector<const EntityNode*> open{&entity.node()};
  while (!open.empty()) {
    const EntityNode* node = open.back();
    open.pop_back();
    if (++uses_[node] > 1) continue;
    for (const EntityNode* child : children(*node)) open.push_back(child);
  }
}

std::string EntityWriter::write(const Entity& entity) {
  struct Step {
    const EntityNode* node;
    bool parts_are_written;
  };
  std::vector<Step> open{{&entity.node(), false}};
  while (!open.empty()) {
    const Step step = open.back();
    open.pop_back();
    if (written_.contains(step.node)) continue;
    if (!step.parts_are_written) {
      open.push_back({step.node, true});
      const std::vector<const EntityNode*> parts = children(*step.node);
      for (std::size_t i = parts.size(); i > 0; --i) open.push_back({parts[i - 1], false});
      continue;
    }
    std::string text = value(*step.node);
    const bool is_named = uses_[step.node] > 1 || text.size() > max_inline;
    if (!program_.syntax().is_c() && is_named && step.node != &entity.node())
      text = program_.define("entity", "Entity", text);
    written_[step.node] = std::move(text);
  }
  std::string& text = written_[&entity.node()];
  if (!program_.syntax().is_c() && uses_[&entity.node()] > 1 && text.size() > max_inline)
    text = program_.define("entity", "Entity", text);
  return text;
}

std::string EntityWriter::value(const EntityNode& node) {
  if (const auto* primitive = std::get_if<Primitive>(&node.content)) {
    const std::string shape = shape_value(program_, *primitive);
    const auto& material = material_of(*primitive);
    return program_.syntax().is_c() && material ? with_material(shape, *material) : shape;
  }
  if (const auto* csg = std::get_if<CsgOperation>(&node.content)) return operation(*csg);
  return wrapper(std::get<EntityWrapper>(node.content));
}

std::string EntityWriter::operation(const CsgOperation& operation) {
  const Syntax& syntax = program_.syntax();
  if (operation.parts.empty()) {
    if (syntax.is_c()) return program_.create("entity", "crt_empty_create", {});
    if (syntax.is_script()) return "Sphere { center -> vec3(0, 0, 0) radius -> 0 }";
    return syntax.is_cpp() ? "empty_entity()" : "crt.Empty()";
  }
  std::vector<std::string> parts;
  for (const EntityPointer& part : operation.parts) parts.push_back(written_.at(part.get()));
  const auto kind = static_cast<std::size_t>(operation.op);
  const bool is_difference = operation.op == CsgOperator::difference;
  if (parts.size() == 2 && !syntax.is_c()) {
    return text::format("({} {} {})", parts[0], signs[kind], parts[1]);
  }
  if (syntax.is_script()) return chain(parts, signs[kind]);
  const std::string first = parts.front();
  if (is_difference) parts.erase(parts.begin());
  if (syntax.is_c()) {
    const std::string array = program_.local_array("parts", "crt_entity*", parts);
    std::vector<std::string> arguments{array, std::to_string(parts.size())};
    if (is_difference) arguments.insert(arguments.begin(), first);
    return program_.create("entity", c_functions[kind], std::move(arguments));
  }
  const std::string list =
      syntax.is_cpp() ? joined("std::vector<Entity>{", parts, "}") : syntax.list(parts);
  return text::format("{}({}{})", syntax.is_cpp() ? cpp_functions[kind] : python_functions[kind],
                      is_difference ? first + ", " : "", list);
}

/// Combines parts one by one. A difference takes them away in their order, too.
std::string EntityWriter::chain(const std::vector<std::string>& parts, const char* sign) {
  std::string text = parts.front();
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (text.size() > max_inline) text = program_.define("entity", "Entity", text);
    text = text::format("({} {} {})", text, sign, parts[i]);
  }
  return text;
}

std::string EntityWriter::wrapper(const EntityWrapper& wrapper) {
  std::string text = written_.at(wrapper.child.get());
  if (wrapper.to_parent) text = placed(std::move(text), *wrapper.to_parent);
  if (wrapper.material) text = with_material(text, *wrapper.material);
  if (wrapper.user) text = with_user(text, *wrapper.user);
  if (!wrapper.casts_shadow) text = without(text, "shadow");
  if (!wrapper.visible) text = without(text, "visible");
  if (!wrapper.id) return text;
  const std::string id = std::to_string(*wrapper.id);
  if (program_.syntax().is_c())
    return program_.create("entity", "crt_entity_with_id", {text, id + "U"});
  if (program_.syntax().is_script()) return modified(text, "id", id);
  return called(text, text::format("with_id({})", id));
}

/// Scripts have no such numbers, as nothing in them could ask for one.
std::string EntityWriter::with_user(const std::string& text, std::uint64_t user) {
  const std::string number = std::to_string(user);
  if (program_.syntax().is_script()) return text;
  if (program_.syntax().is_c())
    return program_.create("entity", "crt_entity_with_user", {text, number + "U"});
  return called(text,
                text::format("with_user({}{})", number, program_.syntax().is_cpp() ? "U" : ""));
}

std::string EntityWriter::without(const std::string& text, std::string_view what) {
  const Syntax& syntax = program_.syntax();
  if (syntax.is_script()) return modified(text, what, "false");
  if (syntax.is_c())
    return program_.create("entity", text::format("crt_entity_with_{}", what), {text, "0"});
  return called(text, text::format("with_{}({})", what, syntax.is_cpp() ? "false" : "False"));
}

std::string EntityWriter::placed(std::string entity, const core::TransformChain& chain) {
  for (const core::TransformChain* map : maps_of(chain)) {
    if (!map->is_plain()) {
      program_.warn_once(
          "transforms that are nested, and together are more than doubles can say, are "
          "rounded: single pixels may differ");
    }
    entity = placed_by(entity, map->product.rounded());
  }
  return entity;
}

std::string EntityWriter::placed_by(const std::string& entity, const Transform& map) {
  const Syntax& syntax = program_.syntax();
  const auto& [x, y, z, t] = map;
  const std::array<std::array<double, 4>, 3> rows{
      {{x.x, x.y, x.z, t.x}, {y.x, y.y, y.z, t.y}, {z.x, z.y, z.z, t.z}}};
  if (syntax.is_c()) {
    std::vector<std::string> numbers;
    for (const auto& row : rows) {
      for (const double number : row) numbers.push_back(Syntax::number(number));
    }
    return program_.create("entity", "crt_entity_with_transform",
                           {entity, joined("(const double[]){", numbers, "}")});
  }
  const bool moves = map == Transform{.translation = t};
  if (moves || is_diagonal(map)) {
    const std::string vector = syntax.vector(moves ? t : Vec3(x.x, y.y, z.z));
    if (syntax.is_script()) return modified(entity, moves ? "translate" : "scale", vector);
    if (syntax.is_python())
      return called(entity, text::format("{}({})", moves ? "moved" : "scaled", vector));
    return called(entity, text::format("transformed({}({}))", moves ? "translate" : "scale",
                                       moves ? vector : "Vec3" + vector));
  }
  if (syntax.is_python() || syntax.is_script()) {
    std::vector<std::string> lists;
    lists.reserve(rows.size());
    for (const auto& row : rows) lists.push_back(syntax.list(number_items(row)));
    if (syntax.is_script()) return modified(entity, "matrix", syntax.list(lists));
    return called(entity, "transformed(" + syntax.list(lists) + ")");
  }
  return called(
      entity, text::format("transformed({{.row_x = {}, .row_y = {}, .row_z = {}, "
                           ".translation = {}}})",
                           syntax.vector(x), syntax.vector(y), syntax.vector(z), syntax.vector(t)));
}

std::string EntityWriter::with_material(const std::string& entity, const SharedMaterial& material) {
  const std::string name = material_name(program_, material);
  const bool is_principled = material.principled() != nullptr;
  if (program_.syntax().is_c()) {
    return program_.create(
        "entity", is_principled ? "crt_entity_with_principled" : "crt_entity_with_material",
        {entity, "&" + name});
  }
  if (program_.syntax().is_script()) return modified(entity, "material", name);
  return called(entity, text::format("with_material({})", name));
}

/// Puts a modifier behind an entity.
std::string EntityWriter::modified(const std::string& entity, std::string_view modifier,
                                   const std::string& operand) const {
  if (modifier != "scale" && modifier != "translate")
    program_.refuse_in_2015(text::format("'<{} ...>'", modifier));
  return text::format("{} <{} {}>", entity, modifier, operand);
}

/// Calls a member of an entity. In C++ a primitive has none.
std::string EntityWriter::called(const std::string& entity, const std::string& call) const {
  const bool is_primitive = program_.syntax().is_cpp() && entity.ends_with('}');
  return is_primitive ? text::format("Entity({}).{}", entity, call)
                      : text::format("{}.{}", entity, call);
}

}  // namespace crt::source
