#include "lang/tree_builder.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "text/format.hpp"

namespace crt::lang {

namespace {

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

int height_of(const Expression* expression) {
  return expression ? expression->height + 1 : 0;
}

int height_of(const std::vector<const Expression*>& expressions) {
  int height = 0;
  for (const Expression* expression : expressions) height = std::max(height, height_of(expression));
  return height;
}

int height_of(const std::vector<AttributeSyntax>& attributes) {
  int height = 0;
  for (const AttributeSyntax& attribute : attributes)
    height = std::max(height, height_of(attribute.value));
  return height;
}

int height_of(const std::vector<Modifier>& modifiers) {
  int height = 0;
  for (const Modifier& modifier : modifiers)
    for (const Expression* operand : modifier.operands())
      if (operand) height = std::max(height, height_of(operand));
  return height;
}

int height_of(const Block& block) {
  return block.height + 1;
}

int height_of_node(const ExpressionNode& node) {
  return std::visit(
      Overloaded{
          [](const Literal&) { return 0; },
          [](const Length&) { return 0; },
          [](const Name&) { return 0; },
          [](const ObjectLiteral& object) { return height_of(object.attributes); },
          [](const DerivedMaterial& material) {
            return std::max(height_of(material.base), height_of(material.attributes));
          },
          [](const MacroLiteral& macro) {
            return std::max(height_of(macro.body), height_of(macro.parameters.defaults));
          },
          [](const ListLiteral& list) { return height_of(list.items); },
          [](const Interpolation& text) { return height_of(text.parts); },
          [](const Comprehension& list) {
            int height = height_of(list.value);
            for (const Clause& clause : list.clauses)
              height = std::max(height, height_of(clause.operand));
            return height;
          },
          [](const DictionaryLiteral& dictionary) { return height_of(dictionary.entries); },
          [](const Slice& slice) {
            return std::max({height_of(slice.base), height_of(slice.first), height_of(slice.end)});
          },
          [](const Member& member) { return height_of(member.base); },
          [](const Index& index) {
            return std::max(height_of(index.base), height_of(index.index));
          },
          [](const Call& call) {
            return std::max(height_of(call.callee), height_of(call.arguments));
          },
          [](const Modified& m) { return std::max(height_of(m.base), height_of(m.modifiers)); },
          [](const Unary& unary) { return height_of(unary.operand); },
          [](const Chain& chain) { return height_of(chain.first); },
          [](const Logical& logical) { return height_of(logical.operands); },
          [](const Conditional& c) {
            return std::max({height_of(c.condition), height_of(c.yes), height_of(c.no)});
          },
          [](const Assignment& assignment) { return height_of(assignment.value); },
          [](const Destructuring& assignment) { return height_of(assignment.value); },
      },
      node);
}

int height_of_node(const Statement& statement) {
  return std::visit(
      Overloaded{
          [](const ExpressionStatement& s) { return height_of(s.expression); },
          [](const While& loop) {
            return std::max(height_of(loop.condition), height_of(loop.body));
          },
          [](const If& choice) {
            int height = 0;
            for (const If::Branch& branch : choice.branches)
              height = std::max({height, height_of(branch.condition), height_of(branch.body)});
            return height;
          },
          [](const For& loop) { return std::max(height_of(loop.list), height_of(loop.body)); },
          [](const Jump& jump) { return height_of(jump.name); },
          [](const Return& result) {
            return std::max(height_of(result.value), height_of(result.name));
          },
          [](const SettingsBlock& settings) { return height_of(settings.attributes); },
          [](const SceneBlock& scene) { return height_of(scene.body); },
          [](const Import&) { return 0; },
      },
      statement.node);
}

/// Returns the names of [a, b], or nothing if it has anything else in it.
std::optional<std::vector<NamePlace>> names_of(const ListLiteral& list) {
  std::vector<NamePlace> names;
  for (const Expression* item : list.items) {
    const auto* name = std::get_if<Name>(&item->node);
    if (!name) return std::nullopt;
    names.push_back({name->symbol, item->span});
  }
  return names;
}

}  // namespace

void TreeBuilder::charge_source(std::size_t bytes) {
  // A byte of text costs at most this much memory besides the tree's nodes: with different names,
  // as short as can be.
  constexpr std::size_t memory_of_a_byte = 24;
  charge(bytes * memory_of_a_byte, lexer_.start());
}

Nesting TreeBuilder::enter(Span place) {
  check_height(place, depth_ + 1);
  return Nesting(depth_);
}

void TreeBuilder::check_height(Span span, int height) {
  if (height <= max_nesting) return;
  reporter_.error(span, text::format("nested more than {} levels deep", max_nesting),
                  ErrorCode::limit);
  throw GiveUp{};
}

void TreeBuilder::charge(std::size_t bytes, Span span) {
  if (bytes > memory_left_) {
    reporter_.error(span, "the script is too long for the memory that its limits allow",
                    ErrorCode::limit);
    throw GiveUp{};
  }
  memory_left_ -= bytes;
}

Value TreeBuilder::string(std::string text) {
  return std::make_shared<const StringValue>(StringValue{std::move(text)});
}

Expression* TreeBuilder::expression(Span span, ExpressionNode node) {
  charge(sizeof(Expression), span);
  const int height = height_of_node(node);
  check_height(span, height);
  return &script_.expressions.emplace_back(Expression{span, std::move(node), height});
}

Expression* TreeBuilder::chain(Expression* left, BinaryOperator op, Span op_span,
                               const Expression* right) {
  // A chain is evaluated from the left whatever its operators are, so that a * b + c continues
  // where a * b ends. An operand on the right that binds tighter is a chain of its own.
  const Span span{left->span.begin, right->span.end};
  if (!std::holds_alternative<Chain>(left->node)) left = expression(span, Chain{left, {}});
  charge(sizeof(ChainLink), span);
  check_height(right->span, height_of(right));
  std::get<Chain>(left->node).links.push_back({op, op_span, right});
  left->span = span;
  left->height = std::max(left->height, height_of(right));
  return left;
}

Expression* TreeBuilder::logical(LogicalOperator op, Expression* left, const Expression* right) {
  const Span span{left->span.begin, right->span.end};
  const auto* same = std::get_if<Logical>(&left->node);
  if (!same || same->op != op) left = expression(span, Logical{op, {left}});
  charge(sizeof(right), span);  // NOLINT(bugprone-sizeof-expression): the size of a pointer
  check_height(right->span, height_of(right));
  std::get<Logical>(left->node).operands.push_back(right);
  left->span = span;
  left->height = std::max(left->height, height_of(right));
  return left;
}

Expression* TreeBuilder::assignment(Span span, Expression* target, Span op_span,
                                    const Expression* value) {
  if (const auto* name = std::get_if<Name>(&target->node))
    return expression(span, Assignment{{name->symbol, target->span}, value});
  const auto* list = std::get_if<ListLiteral>(&target->node);
  if (auto names = list && !list->items.empty() ? names_of(*list) : std::nullopt) {
    refuse_repeated(*names, "two of these variables are the same");
    return expression(span, Destructuring{std::move(*names), value});
  }
  const bool is_part = std::holds_alternative<Index>(target->node) ||
                       std::holds_alternative<Slice>(target->node) ||
                       std::holds_alternative<Member>(target->node);
  reporter_.error(target->span, is_part ? "only a variable can be assigned, as values never change"
                                        : "only a variable can be assigned; to compare, write "
                                          "'=='");
  return chain(target, BinaryOperator::equal, op_span, value);
}

Expression* TreeBuilder::assignment(Span span, Expression* target, BinaryOperator op, Span op_span,
                                    const Expression* value) {
  const auto* name = std::get_if<Name>(&target->node);
  if (name) value = chain(expression(target->span, *name), op, op_span, value);
  return assignment(span, target, op_span, value);
}

/// Makes a statement of an expression. `return` alone may end a macro, and `break` and `continue`
/// a loop.
Statement TreeBuilder::expression_statement(Span span, const Expression* expression) {
  if (!std::holds_alternative<Name>(expression->node))
    return statement(span, ExpressionStatement{expression});
  const std::string_view word = lexer_.text(span);
  if (word == "return") return statement(span, Return{span, nullptr, expression});
  if ((word == "break" || word == "continue") && lexer_.compat() != compat_2015)
    return statement(span, Jump{span, word == "break", expression});
  return statement(span, ExpressionStatement{expression});
}

void TreeBuilder::refuse_repeated(const std::vector<NamePlace>& names, const char* message) {
  std::vector<Symbol> seen;
  seen.reserve(names.size());
  for (const NamePlace& name : names) seen.push_back(name.symbol);
  std::sort(seen.begin(), seen.end());
  for (const NamePlace& name : names) {
    const auto same = std::equal_range(seen.begin(), seen.end(), name.symbol);
    if (same.second - same.first < 2) continue;
    reporter_.error(name.span, message);
    break;
  }
}

Expression* TreeBuilder::macro(Span span, Parameters parameters, Block body) {
  refuse_repeated(parameters.names, "two parameters of a macro have this name");
  return expression(span, MacroLiteral{std::move(parameters), std::move(body)});
}

Parameters TreeBuilder::parameter(Parameters parameters, const AttributeSyntax& parameter) {
  parameters.names.push_back(parameter.name);
  parameters.defaults.push_back(parameter.value);
  return parameters;
}

Expression* TreeBuilder::interpolation(Span span, const Expression* first,
                                       std::vector<const Expression*> parts,
                                       const Expression* last) {
  parts.insert(parts.begin(), first);
  parts.push_back(last);
  return expression(span, Interpolation{std::move(parts)});
}

Call TreeBuilder::argument(Call call, const Expression* value) {
  if (!call.names.empty())
    reporter_.error(value->span, "arguments without a name stand before those with one");
  else
    call.arguments.push_back(value);
  return call;
}

Call TreeBuilder::argument(Call call, NamePlace name, const Expression* value) {
  call.arguments.push_back(value);
  call.names.push_back(name);
  return call;
}

Expression* TreeBuilder::call(Span span, const Expression* callee, Call call) {
  call.callee = callee;
  refuse_repeated(call.names, "two arguments have this name");
  return expression(span, std::move(call));
}

Expression* TreeBuilder::comprehension(Span span, const Expression* value,
                                       std::vector<Clause> clauses) {
  for (const Clause& clause : clauses)
    refuse_repeated(clause.names, "two of these variables are the same");
  return expression(span, Comprehension{value, std::move(clauses)});
}

Expression* TreeBuilder::dictionary(Span span, std::vector<AttributeSyntax> entries) {
  std::vector<NamePlace> names;
  names.reserve(entries.size());
  for (const AttributeSyntax& entry : entries) names.push_back(entry.name);
  refuse_repeated(names, "two entries of a dictionary have this name");
  return expression(span, DictionaryLiteral{std::move(entries)});
}

Statement TreeBuilder::finish_statement(Statement statement) {
  statement.height = height_of_node(statement);
  check_height(statement.span, statement.height);
  return statement;
}

If TreeBuilder::branch(If branches, const Expression* condition, Block body) {
  branches.branches.push_back({condition, std::move(body)});
  return branches;
}

Block TreeBuilder::append(Block block, Statement statement) {
  // A growing vector holds up to about twice what is in it.
  charge(2 * sizeof(Statement), statement.span);
  block.height = std::max(block.height, statement.height);
  block.statements.push_back(std::move(statement));
  return block;
}

}  // namespace crt::lang
