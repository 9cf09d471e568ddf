// The syntax tree. Expressions lie in one row, the Script's, and point at one another, so a tree of
// any shape is freed without recursion. Chains of left-associative operators are one node with many
// operands; what remains to nest is bounded by max_nesting.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <string>
#include <variant>
#include <vector>

#include "lang/source_map.hpp"
#include "lang/symbol.hpp"
#include "lang/value.hpp"

namespace crt::lang {

struct Expression;
struct Statement;
struct ObjectType;

/// Expressions, blocks and brackets within one another.
constexpr int max_nesting = 200;

/// Statements in braces.
struct Block {
  std::vector<Statement> statements;
  int height = 0;
};

/// A name where it is written.
struct NamePlace {
  Symbol symbol{};
  Span span;
};

// ---- expressions, by their rule numbers in the grammar --------------------------------------

/// (23) A number, string or Boolean.
struct Literal {
  Value value;
};

/// (24) A variable, constant, macro or built-in.
struct Name {
  Symbol symbol{};
};

/// (29) name -> value
struct AttributeSyntax {
  NamePlace name;
  const Expression* value = nullptr;
  /// Its number in the object's table of attributes; set by the check.
  std::size_t index = 0;
};

/// (25) Name { attributes }
struct ObjectLiteral {
  NamePlace name;
  std::vector<AttributeSyntax> attributes;
  /// Set by the check.
  const ObjectType* type = nullptr;
};

/// (26) Macro (parameters) { body }
struct MacroLiteral {
  std::vector<NamePlace> parameters;
  Block body;
};

/// (8) [a, b, c]
struct ListLiteral {
  std::vector<const Expression*> items;
};

/// (9) base[index]
struct Index {
  const Expression* base = nullptr;
  const Expression* index = nullptr;
};

/// (10) callee(arguments)
struct Call {
  const Expression* callee = nullptr;
  std::vector<const Expression*> arguments;
};

enum class ModifierKind { scale, translate, rotate };

/// (30) to (32)
struct Modifier {
  ModifierKind kind = ModifierKind::scale;
  const Expression* operand = nullptr;
};

/// (11) base <modifiers>
struct Modified {
  const Expression* base = nullptr;
  std::vector<Modifier> modifiers;
};

enum class UnaryOperator { plus, minus, negation };

/// (12), (13)
struct Unary {
  UnaryOperator op = UnaryOperator::plus;
  const Expression* operand = nullptr;
};

enum class BinaryOperator {
  multiply,
  divide,
  remainder,
  add,
  subtract,
  intersect,
  less,
  less_or_equal,
  greater,
  greater_or_equal,
  equal,
  not_equal,
};

struct ChainLink {
  BinaryOperator op = BinaryOperator::add;
  Span op_span;
  const Expression* operand = nullptr;
};

/// (14) to (16) first op operand op operand ..., from the left.
struct Chain {
  const Expression* first = nullptr;
  std::vector<ChainLink> links;
};

enum class LogicalOperator { conjunction, disjunction };

/// (17), (18) a && b && c, or a || b || c.
struct Logical {
  LogicalOperator op = LogicalOperator::conjunction;
  std::vector<const Expression*> operands;
};

/// (19) condition ? yes : no
struct Conditional {
  const Expression* condition = nullptr;
  const Expression* yes = nullptr;
  const Expression* no = nullptr;
};

/// (20) name = value
struct Assignment {
  NamePlace name;
  const Expression* value = nullptr;
};

using ExpressionNode = std::variant<Literal, Name, ObjectLiteral, MacroLiteral, ListLiteral, Index,
                                    Call, Modified, Unary, Chain, Logical, Conditional, Assignment>;

struct Expression {
  Span span;
  ExpressionNode node;
  /// Levels below it, blocks included; at most max_nesting.
  int height = 0;
};

// ---- statements ---------------------------------------------------------------------------------

struct ExpressionStatement {
  const Expression* expression = nullptr;
};

struct While {
  Span keyword;
  const Expression* condition = nullptr;
  Block body;
};

/// if, any number of else if, and else (whose condition is null).
struct If {
  struct Branch {
    const Expression* condition = nullptr;
    Block body;
  };
  std::vector<Branch> branches;
};

struct For {
  Span keyword;
  NamePlace variable;
  const Expression* list = nullptr;
  Block body;
};

struct SettingsBlock {
  Span keyword;
  std::vector<AttributeSyntax> attributes;
};

struct SceneBlock {
  Span keyword;
  Block body;
};

struct Import {
  Span path_span;
  std::string path;
};

struct Statement {
  Span span;
  std::variant<ExpressionStatement, While, If, For, SettingsBlock, SceneBlock, Import> node;
  int height = 0;
};

/// A parsed text.
struct Script {
  std::deque<Expression> expressions;
  Block statements;
  /// Of a text that is one expression.
  const Expression* expression = nullptr;
};

}  // namespace crt::lang
