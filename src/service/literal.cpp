#include "service/literal.hpp"

#include <optional>
#include <string_view>
#include <variant>

#include "lang/utf8.hpp"
#include "text/format.hpp"

namespace crt::service {

namespace {

/// Returns a number that stands there as digits, perhaps with a sign.
std::optional<double> number_of(const lang::Expression& expression) {
  if (const auto* unary = std::get_if<lang::Unary>(&expression.node)) {
    if (unary->op == lang::UnaryOperator::negation) return std::nullopt;
    const auto* operand = std::get_if<lang::Literal>(&unary->operand->node);
    const std::optional<double> number = operand ? number_of(*unary->operand) : std::nullopt;
    if (!number) return std::nullopt;
    return unary->op == lang::UnaryOperator::minus ? -*number : *number;
  }
  const auto* literal = std::get_if<lang::Literal>(&expression.node);
  double storage = 0;
  const double* number = literal ? lang::as_float(literal->value, storage) : nullptr;
  return number ? std::optional(*number) : std::nullopt;
}

/// Returns the name of the built-in that an expression names, or nothing.
std::string_view builtin_of(const Program& program, const lang::Expression& expression) {
  const auto* name = std::get_if<lang::Name>(&expression.node);
  const lang::NameUse* use = name ? lang::use_at(program.names(), expression.span.begin) : nullptr;
  if (!use || use->declared != lang::NameUse::nothing) return {};
  return program.symbols().name(name->symbol);
}

LiteralKind kind_of_call(std::string_view builtin, std::size_t arguments) {
  if (builtin == "vec3" && arguments == 3) return LiteralKind::vector;
  if (builtin == "rgb" && arguments == 3) return LiteralKind::color;
  if (builtin == "rgba" && arguments == 4) return LiteralKind::color;
  return LiteralKind::none;
}

/// Says what a value is that is no literal.
std::string reason_of(const Program& program, const lang::Expression& value) {
  const auto named = [&](const char* what, const lang::Expression& name) {
    return text::format("{} '{}'", what,
                        lang::abbreviated(std::string(program.text_of(name.span))));
  };
  if (std::holds_alternative<lang::Name>(value.node)) return named("the variable", value);
  if (const auto* call = std::get_if<lang::Call>(&value.node)) {
    if (!std::holds_alternative<lang::Name>(call->callee->node)) return "a call";
    return named("a call of", *call->callee);
  }
  if (const auto* object = std::get_if<lang::ObjectLiteral>(&value.node))
    return text::format("an object {}", program.symbols().name(object->name.symbol));
  if (const auto* derived = std::get_if<lang::DerivedMaterial>(&value.node))
    return named("a copy of", *derived->base);
  if (std::holds_alternative<lang::ListLiteral>(value.node)) return "a list";
  return "a computed value";
}

}  // namespace

void describe_value(const Program& program, const lang::Expression& value,
                    ScriptAttribute& attribute) {
  if (const auto number = number_of(value)) {
    attribute.literal = LiteralKind::number;
    attribute.numbers = {*number};
    return;
  }
  if (const auto* literal = std::get_if<lang::Literal>(&value.node)) {
    if (const auto* boolean = std::get_if<bool>(&literal->value)) {
      attribute.literal = LiteralKind::boolean;
      attribute.numbers = {*boolean ? 1.0 : 0.0};
    } else if (const auto* string = std::get_if<lang::String>(&literal->value)) {
      attribute.literal = LiteralKind::string;
      attribute.text = (*string)->text;
    }
    return;
  }
  if (const auto* call = std::get_if<lang::Call>(&value.node)) {
    attribute.literal = kind_of_call(builtin_of(program, *call->callee), call->arguments.size());
    for (const lang::Expression* argument : call->arguments) {
      const std::optional<double> number = number_of(*argument);
      if (!number) attribute.literal = LiteralKind::none;
      attribute.numbers.push_back(number.value_or(0));
    }
  }
  if (attribute.literal != LiteralKind::none) return;
  attribute.numbers.clear();
  attribute.reason = reason_of(program, value);
}

}  // namespace crt::service
