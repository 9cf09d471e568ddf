#include "service/material_kind.hpp"

#include <set>
#include <variant>

namespace crt::service {

namespace {

/// Variables that stand for variables, and materials derived from derived ones, are followed so
/// far.
constexpr int max_steps = 40;

/// Returns what a variable stands for, or what a material is derived from, or null.
const lang::Expression* origin_of(const Program& program, const lang::Expression& expression) {
  if (const auto* derived = std::get_if<lang::DerivedMaterial>(&expression.node))
    return derived->base;
  const auto* member = std::get_if<lang::Member>(&expression.node);
  if (!member && !std::holds_alternative<lang::Name>(expression.node)) return nullptr;
  const lang::DeclaredName* name =
      program.declared_at(member ? member->name.span : expression.span);
  return name && name->kind == lang::NameKind::variable ? name->value : nullptr;
}

}  // namespace

const lang::ObjectType* material_type(const Program& program, const lang::Expression& expression) {
  const lang::Expression* origin = &expression;
  for (int step = 0; origin && step < max_steps; ++step) {
    if (const auto* object = std::get_if<lang::ObjectLiteral>(&origin->node)) {
      const std::string_view name = program.symbols().name(object->name.symbol);
      const bool is_material = name == "Material" || name == "PrincipledMaterial";
      return is_material ? lang::find_object_type(name) : nullptr;
    }
    origin = origin_of(program, *origin);
  }
  return nullptr;
}

std::vector<const lang::AttributeSyntax*> inherited_attributes(
    const Program& program, const lang::DerivedMaterial& material) {
  std::set<lang::Symbol> seen;
  std::vector<const lang::AttributeSyntax*> result;
  for (const lang::AttributeSyntax& attribute : material.attributes)
    seen.insert(attribute.name.symbol);
  const auto add = [&](const std::vector<lang::AttributeSyntax>& attributes) {
    for (const lang::AttributeSyntax& attribute : attributes) {
      if (attribute.value && seen.insert(attribute.name.symbol).second)
        result.push_back(&attribute);
    }
  };
  const lang::Expression* origin = material.base;
  for (int step = 0; origin && step < max_steps; ++step) {
    if (const auto* derived = std::get_if<lang::DerivedMaterial>(&origin->node))
      add(derived->attributes);
    if (const auto* object = std::get_if<lang::ObjectLiteral>(&origin->node))
      add(object->attributes);
    origin = origin_of(program, *origin);
  }
  return result;
}

}  // namespace crt::service
