// Entities are described for those who show a scene as a tree.
#include "core/entity/entity_node.hpp"
#include "crt/source_code.hpp"
#include "source/shapes.hpp"
#include "text/format.hpp"

namespace crt {

namespace {

using source::Argument;
using source::Syntax;
using Values = std::vector<std::pair<std::string, std::string>>;

constexpr const char* operator_names[] = {"Union", "Intersection", "Difference"};

void add_material(Values& values, const SharedMaterial& material) {
  const Syntax syntax(SourceLanguage::python);
  if (const auto* color = std::get_if<Color>(&material->color)) {
    values.emplace_back("color", syntax.vector(Vec3(color->r, color->g, color->b)));
  } else {
    values.emplace_back("color", "a pattern");
  }
  const auto add = [&](const char* name, double value) {
    if (value != 0) values.emplace_back(name, Syntax::number(value));
  };
  if (const PrincipledMaterial* principled = material.principled()) {
    const auto add_share = [&](const char* name, const Share& share) {
      if (const auto* number = std::get_if<double>(&share)) return add(name, *number);
      values.emplace_back(name, "a pattern");
    };
    add_share("metallic", principled->metallic);
    add_share("roughness", principled->roughness);
    add("transmission", principled->transmission);
    add("coat", principled->coat);
    add("sheen", principled->sheen);
    return;
  }
  add("reflectivity", material->reflectivity);
  add("transparency", material->transparency);
  add("specular", material->specular);
}

EntityDescription description_of(const Primitive& primitive) {
  const source::ShapeCode code = source::shape_code(primitive);
  const Syntax syntax(SourceLanguage::python);
  EntityDescription result{.kind = code.name};
  for (const Argument& argument : code.arguments) {
    if (argument.cpp.empty()) continue;
    const auto* const number = std::get_if<double>(&argument.value);
    result.values.emplace_back(argument.cpp, number != nullptr
                                                 ? Syntax::number(*number)
                                                 : syntax.vector(std::get<Vec3>(argument.value)));
  }
  if (const auto& material = source::material_of(primitive)) add_material(result.values, *material);
  return result;
}

EntityDescription description_of(const EntityNode& node) {
  if (const auto* primitive = std::get_if<Primitive>(&node.content))
    return description_of(*primitive);
  if (const auto* csg = std::get_if<CsgOperation>(&node.content))
    return {.kind =
                csg->parts.empty() ? "Empty" : operator_names[static_cast<std::size_t>(csg->op)]};
  const auto& wrapper = std::get<EntityWrapper>(node.content);
  EntityDescription result{.kind = "Placed"};
  const Syntax syntax(SourceLanguage::python);
  if (wrapper.to_parent) {
    const Transform map = wrapper.to_parent->product.rounded();
    const std::pair<const char*, const Vec3&> rows[] = {
        {"row_x", map.row_x}, {"row_y", map.row_y}, {"row_z", map.row_z}};
    for (const auto& [name, row] : rows) result.values.emplace_back(name, syntax.vector(row));
    result.values.emplace_back("translation", syntax.vector(map.translation));
  }
  if (wrapper.material) add_material(result.values, *wrapper.material);
  if (wrapper.id) result.values.emplace_back("id", std::to_string(*wrapper.id));
  if (wrapper.user) result.values.emplace_back("user", std::to_string(*wrapper.user));
  if (!wrapper.casts_shadow) result.values.emplace_back("shadow", "false");
  if (!wrapper.visible) result.values.emplace_back("visible", "false");
  return result;
}

/// Adds a node and, as long as there are not too many, what it is made of.
void add_descriptions(std::vector<EntityDescription>& list, const EntityNode& entity,
                      std::size_t most) {
  struct Step {
    const EntityNode* node;
    std::size_t parent;
  };
  std::vector<Step> open{{&entity, EntityDescription::no_parent}};
  while (!open.empty()) {
    const Step step = open.back();
    open.pop_back();
    const std::size_t place = list.size();
    list.push_back(description_of(*step.node));
    list.back().parent = step.parent;
    std::vector<Step> parts;
    if (const auto* csg = std::get_if<CsgOperation>(&step.node->content)) {
      for (const EntityPointer& part : csg->parts) parts.push_back({part.get(), place});
    } else if (const auto* wrapper = std::get_if<EntityWrapper>(&step.node->content)) {
      parts.push_back({wrapper->child.get(), place});
    }
    if (list.size() + open.size() + parts.size() > most) continue;
    open.insert(open.end(), parts.rbegin(), parts.rend());
  }
}

/// Turns a number, a vector or words into JSON. There are no other values.
std::string json_of(const std::string& value) {
  if (value.starts_with('(')) return "[" + value.substr(1, value.size() - 2) + "]";
  const bool is_number = value.find_first_of("0123456789") != std::string::npos;
  return is_number ? value : '"' + value + '"';
}

}  // namespace

std::string descriptions_to_json(const std::vector<EntityDescription>& descriptions) {
  std::string text = "[";
  for (const EntityDescription& one : descriptions) {
    const bool is_first = text.size() == 1;
    const bool is_alone = one.parent == EntityDescription::no_parent;
    text += text::format("{}{{\"kind\":\"{}\",\"parent\":{},\"values\":{{", is_first ? "" : ",",
                         one.kind, is_alone ? "null" : std::to_string(one.parent));
    for (const auto& [name, value] : one.values) {
      const char* const comma = &name == &one.values.front().first ? "" : ",";
      text += text::format("{}\"{}\":{}", comma, name, json_of(value));
    }
    text += "}}";
  }
  return text + "]";
}

std::vector<EntityDescription> describe_entities(const Scene& scene, std::size_t most) {
  std::vector<EntityDescription> list;
  for (const Entity& entity : scene.entities) add_descriptions(list, entity.node(), most);
  return list;
}

}  // namespace crt
