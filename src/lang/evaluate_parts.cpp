// This file has the interpreter's expressions that take values apart or put them together:
// comprehensions, slices, members, dictionaries and strings with values in them. It also watches
// for divisions of Integers that were not meant as such.
#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "lang/failure.hpp"
#include "lang/interpreter.hpp"
#include "lang/operators.hpp"
#include "lang/suggestion.hpp"
#include "text/format.hpp"

namespace crt::lang {

namespace {

bool has_floats(const Value& value) {
  return std::holds_alternative<double>(value) || std::holds_alternative<Vec3>(value) ||
         std::holds_alternative<Color>(value) || std::holds_alternative<Field>(value);
}

/// Returns the component of a Vec3 or Color that is called so, or the number of them.
template <std::size_t count>
std::size_t component(const std::array<std::string_view, count>& names, std::string_view name) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

}  // namespace

[[gnu::noinline]] Value Interpreter::evaluate_node(const Interpolation& text,
                                                   const Expression& expression) {
  std::string result;
  for (const Expression* part : text.parts) {
    const Value value = evaluate_value(*part);
    result += text_of(context_, part->span, value);
    context_.check_string_size(expression.span, result.size());
  }
  return context_.make_string(expression.span, std::move(result));
}

[[gnu::noinline]] Value Interpreter::evaluate_node(const Comprehension& list,
                                                   const Expression& expression) {
  ListMaker items(context_, expression.span);
  run_clauses(list, 0, items);
  return items.finish();
}

/// Runs the clauses of a comprehension from the next one on, for the values of the names so far.
void Interpreter::run_clauses(const Comprehension& list, std::size_t next, ListMaker& items) {
  check_stack(list.value->span);
  if (next == list.clauses.size()) return items.add(evaluate_value(*list.value));
  const Clause& clause = list.clauses[next];
  if (clause.names.empty()) {
    if (condition(*clause.operand, "'if'")) run_clauses(list, next + 1, items);
    return;
  }
  const Value value = evaluate(*clause.operand);
  const List* const source = std::get_if<List>(&value);
  if (!source) fail(clause.operand->span, "'for' goes through a List, not {}", value);
  const Context::Running running(context_,
                                 {.name = "for", .span = clause.keyword, .is_loop = true});
  std::shared_ptr<Scope> scope;
  for (const Value& item : (*source)->items) {
    context_.step(clause.keyword);
    context_.count_round();
    scope = fresh_scope(std::move(scope));
    bind_names(*scope, clause.names, item, clause.operand->span);
    const Temporarily inside(scope_, scope);
    run_clauses(list, next + 1, items);
  }
}

[[gnu::noinline]] Value Interpreter::evaluate_node(const DictionaryLiteral& dictionary,
                                                   const Expression& expression) {
  Variables entries;
  for (const AttributeSyntax& entry : dictionary.entries)
    entries.set(entry.name.symbol, evaluate_value(*entry.value));
  return context_.make_dictionary(expression.span, std::move(entries));
}

[[gnu::noinline]] Value Interpreter::evaluate_node(const Slice& slice_node,
                                                   const Expression& expression) {
  const Value base = evaluate(*slice_node.base);
  const auto bound = [this](const Expression* part) -> std::optional<std::int64_t> {
    if (!part) return std::nullopt;
    const Value value = evaluate(*part);
    const auto* number = std::get_if<std::int64_t>(&value);
    if (!number) fail(part->span, "a bound of a slice is an Integer, not {}", value);
    return *number;
  };
  const std::optional<std::int64_t> first = bound(slice_node.first);
  const std::optional<std::int64_t> end = bound(slice_node.end);
  return slice(context_, expression.span, base, first, end);
}

[[gnu::noinline]] Value Interpreter::evaluate_node(const Member& member, const Expression&) {
  const Value base = evaluate(*member.base);
  const std::string_view name = context_.symbols.name(member.name.symbol);
  if (const auto* dictionary = std::get_if<Dictionary>(&base))
    return entry(context_, member.name.span, **dictionary, name);
  if (const auto* vector = std::get_if<Vec3>(&base)) {
    constexpr std::array<std::string_view, 3> axes = {"x", "y", "z"};
    const std::size_t axis = component(axes, name);
    if (axis < axes.size()) return (*vector)[static_cast<int>(axis)];
    fail(member.name.span, "a Vec3 has x, y and z, and no '{}'", name);
  }
  if (const auto* color = std::get_if<Color>(&base)) {
    constexpr std::array<std::string_view, 4> names = {"r", "g", "b", "a"};
    const std::array channels = {color->r, color->g, color->b, color->a};
    const std::size_t channel = component(names, name);
    if (channel < channels.size()) return channels[channel];
    fail(member.name.span, "a Color has r, g, b and a, and no '{}'", name);
  }
  fail(member.name.span,
       "{} has no parts with names; a Vec3 has x, y and z, a Color r, g, b and a, and a Dictionary "
       "its entries",
       base);
}

[[gnu::noinline]] Value Interpreter::evaluate_node(const Destructuring& assignment,
                                                   const Expression&) {
  Value value = evaluate_value(*assignment.value);
  Scope items(Scope::Kind::block, nullptr);
  if (assignment.names.size() == 1) {
    const List* const list = std::get_if<List>(&value);
    if (!list || (*list)->items.size() != 1)
      fail(assignment.value->span, "one name in brackets takes the item of a List of one, not {}",
           value);
    items.set(assignment.names[0].symbol, (*list)->items[0]);
  } else {
    bind_names(items, assignment.names, value, assignment.value->span);
  }
  for (const auto& [name, item] : items.variables()) {
    if (!is_overridden(name)) set_variable(name, item);
  }
  return value;
}

/// Says whether any script computes a remainder by what is written at a place: who computes i / 8
/// and i % 8 knows what that is.
bool Interpreter::has_remainder_by(Span divisor) {
  constexpr std::size_t longest = 100;
  const auto text_at = [this](Span span) { return context_.sources.text(span).substr(0, longest); };
  for (; scripts_searched_ < scripts_.size(); ++scripts_searched_) {
    for (const Expression& expression : scripts_[scripts_searched_]->expressions) {
      const auto* chain = std::get_if<Chain>(&expression.node);
      if (!chain) continue;
      for (const ChainLink& link : chain->links) {
        if (link.op == BinaryOperator::remainder) remainders_.insert(text_at(link.operand->span));
      }
    }
  }
  return remainders_.contains(text_at(divisor));
}

/// Computes a link of a chain. Notes divisions of Integers that leave a rest, and finds out whether
/// what comes of them is used as a Float.
[[gnu::noinline]] Value Interpreter::watched_division(const Expression& chain,
                                                      const ChainLink& link, Span left_span,
                                                      const Value& left, const Value& right) {
  Value result = binary(context_, link.op, link.op_span, left, right);
  if (context_.compat == compat_2015) return result;
  const auto* a = std::get_if<std::int64_t>(&left);
  const auto* b = std::get_if<std::int64_t>(&right);
  const Span right_span = link.operand->span;
  if (a && b && std::holds_alternative<std::int64_t>(result)) {
    const bool leaves_rest = link.op == BinaryOperator::divide && *b != -1 && *a % *b != 0;
    if (leaves_rest && !context_.truncation_of(chain.span) && !has_remainder_by(right_span))
      context_.note_truncation(chain.span, {.sign = link.op_span, .dividend = *a, .divisor = *b});
    for (const Span operand : {left_span, right_span}) {
      const Context::Truncation* const inner = context_.truncation_of(operand);
      if (inner && operand != chain.span)
        context_.note_truncation(chain.span, Context::Truncation(*inner));
    }
  } else if (a && has_floats(right)) {
    context_.used_as_float(left_span);
  } else if (b && has_floats(left)) {
    context_.used_as_float(right_span);
  }
  return result;
}

}  // namespace crt::lang
