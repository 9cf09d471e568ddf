// This file has the interpreter's expressions. Each kind has a function of its own that is not
// inlined. That keeps the frame of evaluate() small, of which there can be many on the stack.
#include <optional>
#include <utility>
#include <variant>

#include "lang/attributes.hpp"
#include "lang/builtins.hpp"
#include "lang/failure.hpp"
#include "lang/interpreter.hpp"
#include "lang/operators.hpp"
#include "lang/suggestion.hpp"
#include "text/format.hpp"

namespace crt::lang {

Value Interpreter::evaluate(const Expression& expression) {
  context_.step(expression.span);
  check_stack(expression.span);
  return std::visit([&](const auto& node) { return evaluate_node(node, expression); },
                    expression.node);
}

Value Interpreter::evaluate_node(const Literal& literal, const Expression&) {
  return literal.value;
}

Value Interpreter::evaluate_node(const Length& length, const Expression& expression) {
  return context_.length(expression.span, length.value, length.unit);
}

[[gnu::noinline]] Value Interpreter::evaluate_node(const Name& name, const Expression& expression) {
  const Value* value = scope_->find(name.symbol);
  if (!value) unknown_name(name.symbol, expression.span);
  if (std::holds_alternative<Unknown>(*value)) throw Abandoned{};
  if (context_.has_truncations()) [[unlikely]]
    context_.note_reading(name.symbol, expression.span, *value);
  return *value;
}

[[gnu::noinline]] std::vector<Given> Interpreter::evaluate_attributes(
    const ObjectType& type, const std::vector<AttributeSyntax>& attributes) {
  std::vector<Given> given;
  given.reserve(attributes.size());
  for (const AttributeSyntax& attribute : attributes) {
    const bool is_known = attribute.index < type.attributes.size();
    const bool is_field = is_known && type.attributes[attribute.index].type == field_type;
    Value value = is_field ? evaluate_field(*attribute.value) : evaluate(*attribute.value);
    if (!is_known) continue;  // skipped, as the check has said
    given.push_back({.type = &type.attributes[attribute.index],
                     .name_span = attribute.name.span,
                     .value_span = attribute.value->span,
                     .value = std::move(value)});
  }
  return given;
}

[[gnu::noinline]] Value Interpreter::evaluate_field(const Expression& expression) {
  auto scope = std::make_shared<Scope>(Scope::Kind::border, scope_);
  SymbolTable& symbols = context_.symbols;
  scope->set(symbols.intern("x"), Field::x());
  scope->set(symbols.intern("y"), Field::y());
  scope->set(symbols.intern("z"), Field::z());
  const Temporarily within(scope_, std::move(scope));
  return evaluate(expression);
}

[[gnu::noinline]] Value Interpreter::evaluate_node(const ObjectLiteral& object, const Expression&) {
  const std::vector<Given> given = evaluate_attributes(*object.type, object.attributes);
  return object.type->build({context_, object.name.span, given});
}

[[gnu::noinline]] Value Interpreter::evaluate_node(const DerivedMaterial& derived,
                                                   const Expression&) {
  const Value base = evaluate(*derived.base);
  const auto* material = std::get_if<SharedMaterial>(&base);
  if (!material) {
    fail(derived.base->span,
         "a Material with other attributes needs a Material to begin with, not {}", base);
  }
  const ObjectType& type =
      *find_object_type(material->principled() ? "PrincipledMaterial" : "Material");
  std::vector<AttributeSyntax> attributes = derived.attributes;
  std::vector<bool> is_given(type.attributes.size(), false);
  for (AttributeSyntax& attribute : attributes) {
    const std::string_view name = context_.symbols.name(attribute.name.symbol);
    attribute.index = find_attribute(type, name);
    if (attribute.index == type.attributes.size()) {
      std::vector<std::string_view> known;
      for (const AttributeType& one : type.attributes) known.push_back(one.name);
      fail(attribute.name.span, "{} has no attribute '{}'{}", type.name, name,
           did_you_mean(name, known));
    }
    if (is_given[attribute.index])
      fail(attribute.name.span, "the attribute '{}' is given twice", name);
    is_given[attribute.index] = true;
  }
  const std::vector<Given> given = evaluate_attributes(type, attributes);
  return type.build({context_, derived.base->span, given, material});
}

[[gnu::noinline]] Value Interpreter::evaluate_node(const MacroLiteral& macro,
                                                   const Expression& expression) {
  capture_scopes(expression.span);
  return std::make_shared<const MacroValue>(MacroValue{&macro, scope_});
}

[[gnu::noinline]] Value Interpreter::evaluate_node(const ListLiteral& list,
                                                   const Expression& expression) {
  context_.check_list_size(expression.span, list.items.size());
  std::vector<Value> items;
  items.reserve(list.items.size());
  for (const Expression* item : list.items) items.push_back(evaluate_value(*item));
  return context_.make_list(expression.span, std::move(items));
}

[[gnu::noinline]] Value Interpreter::evaluate_node(const Index& index, const Expression&) {
  const Value base = evaluate(*index.base);
  return item(context_, index.index->span, base, evaluate(*index.index));
}

[[gnu::noinline]] Value Interpreter::evaluate_node(const Unary& unary_node,
                                                   const Expression& expression) {
  return unary(unary_node.op, expression.span, evaluate(*unary_node.operand));
}

[[gnu::noinline]] Value Interpreter::evaluate_node(const Chain& chain,
                                                   const Expression& expression) {
  if (context_.has_truncations()) [[unlikely]]
    context_.forget_truncation(expression.span);
  Value left = evaluate(*chain.first);
  Span left_span = chain.first->span;
  for (const ChainLink& link : chain.links) {
    const Value right = evaluate(*link.operand);
    if (link.op == BinaryOperator::divide || context_.has_truncations()) [[unlikely]] {
      left = watched_division(expression, link, left_span, left, right);
      left_span = expression.span;
    } else {
      left = binary(context_, link.op, link.op_span, left, right);
    }
  }
  return left;
}

[[gnu::noinline]] Value Interpreter::evaluate_node(const Logical& logical, const Expression&) {
  const bool decisive = logical.op == LogicalOperator::disjunction;
  const char* what = decisive ? "'||'" : "'&&'";
  for (const Expression* operand : logical.operands) {
    const Value value = evaluate(*operand);
    const auto* boolean = std::get_if<bool>(&value);
    if (!boolean) fail(operand->span, "{} takes Booleans, not {}", what, value);
    if (*boolean == decisive) return decisive;
  }
  return !decisive;
}

[[gnu::noinline]] Value Interpreter::evaluate_node(const Conditional& conditional,
                                                   const Expression&) {
  return evaluate(condition(*conditional.condition, "'?'") ? *conditional.yes : *conditional.no);
}

/// Evaluates `list = list + more`, if it is that. A list that only the variable has grows in place.
[[gnu::noinline]] std::optional<Value> Interpreter::append_to_variable(
    const Assignment& assignment) {
  const Symbol symbol = assignment.name.symbol;
  const auto* sum = std::get_if<Chain>(&assignment.value->node);
  if (!sum || sum->links.size() != 1 || sum->links[0].op != BinaryOperator::add) return {};
  const auto* name = std::get_if<Name>(&sum->first->node);
  if (!name || name->symbol != symbol) return {};
  const Value* const variable = scope_->find(symbol);
  if (!variable || !std::holds_alternative<List>(*variable)) return {};

  context_.step(assignment.value->span);
  context_.step(sum->first->span);
  const auto& [op, op_span, operand] = sum->links[0];
  const Value list = *variable;
  const Value more = evaluate(*operand);
  Scope& scope = scope_->target_of(symbol);
  const Value* const now = scope.has(symbol) ? scope.find(symbol) : nullptr;
  const List* const kept = now ? std::get_if<List>(now) : nullptr;
  constexpr long variable_and_list = 2;
  if (kept && std::holds_alternative<List>(more) && *kept == std::get<List>(list) &&
      kept->use_count() == variable_and_list) {
    append(context_, op_span, *kept, *std::get<List>(more));
    return list;
  }
  Value value = binary(context_, op, op_span, list, more);
  scope.set(symbol, value);
  return value;
}

[[gnu::noinline]] Value Interpreter::evaluate_node(const Assignment& assignment,
                                                   const Expression&) {
  const Symbol name = assignment.name.symbol;
  if (is_overridden(name)) return *globals_->find(name);
  if (std::optional<Value> list = append_to_variable(assignment)) return std::move(*list);
  Value value = evaluate_value(*assignment.value);
  context_.note_variable(name, assignment.value->span);
  scope_->target_of(name).set(name, value);
  return value;
}

/// Says whether an assignment here would change a variable that was set from outside.
bool Interpreter::is_overridden(Symbol name) const {
  return overridden_.contains(name) && &scope_->target_of(name) == globals_.get();
}

/// Evaluates what must have a value.
Value Interpreter::evaluate_value(const Expression& expression) {
  Value value = evaluate(expression);
  if (std::holds_alternative<Nothing>(value)) fail(expression.span, "this call has no value");
  return value;
}

[[gnu::noinline]] Value Interpreter::evaluate_node(const Modified& modified, const Expression&) {
  const Value base = evaluate(*modified.base);
  const auto* entity = std::get_if<Entity>(&base);
  if (!entity) fail(modified.base->span, "only an Entity takes modifiers, not {}", base);
  Entity result = *entity;
  for (const Modifier& modifier : modified.modifiers) result = modify(result, modifier);
  return result;
}

}  // namespace crt::lang
