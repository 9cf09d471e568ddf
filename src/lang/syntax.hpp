// This is the syntax tree. The expressions lie in one array of the Script and point at one another,
// so a tree of any shape is freed without recursion. Chains of left-associative operators are one
// node with many operands. max_nesting bounds the nesting that remains.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "crt/settings.hpp"
#include "lang/source_map.hpp"
#include "lang/symbol.hpp"
#include "lang/value.hpp"

namespace crt::lang {

struct Expression;
struct Statement;
struct ObjectType;

/// Expressions, blocks and brackets nest at most this deep.
constexpr int max_nesting = 200;

/// A Block is statements in braces.
struct Block {
  std::vector<Statement> statements;
  int height = 0;
  /// Reaches from brace to brace. The block of a whole script has none.
  Span span{};
};

/// A NamePlace is a name where it is written.
struct NamePlace {
  Symbol symbol{};
  Span span;
};

// ---- expressions, by their rule numbers in the grammar --------------------------------------

/// A Literal is a number, string or Boolean (rule 23).
struct Literal {
  Value value;
  /// Says that the number is an angle written with its unit, such as 45deg.
  bool is_angle = false;
};

/// A Number is written with a point or an exponent, or with a unit, such as 2.5, 10mm or 45deg.
struct Number {
  double value = 0;
  std::optional<Unit> unit{};
  bool is_angle = false;
};

/// An Interpolation is a string with values in it, "a \{b} c": its parts in their order.
struct Interpolation {
  std::vector<const Expression*> parts;
};

/// A Length is a number with a unit, which the scene's own unit makes a Float of.
struct Length {
  double value = 0;
  Unit unit = Unit::m;
};

/// A Name is that of a variable, constant, macro or built-in (rule 24).
struct Name {
  Symbol symbol{};
};

/// An AttributeSyntax is name -> value (rule 29).
struct AttributeSyntax {
  NamePlace name;
  const Expression* value = nullptr;
  /// The check sets its index in the object's table of attributes.
  std::size_t index = 0;
};

/// An ObjectLiteral is Name { attributes } (rule 25).
struct ObjectLiteral {
  NamePlace name;
  std::vector<AttributeSyntax> attributes;
  /// The check sets the type.
  const ObjectType* type = nullptr;
};

/// A DerivedMaterial is name { attributes }: a copy of a material with other attributes.
struct DerivedMaterial {
  const Expression* base = nullptr;  ///< its name, or that of a member
  std::vector<AttributeSyntax> attributes;
};

/// Parameters are names, each with its default or null.
struct Parameters {
  std::vector<NamePlace> names;
  std::vector<const Expression*> defaults;
};

/// A MacroLiteral is Macro (parameters) { body } (rule 26).
struct MacroLiteral {
  Parameters parameters;
  Block body;
};

/// A ListLiteral is [a, b, c] (rule 8).
struct ListLiteral {
  std::vector<const Expression*> items;
};

/// A Clause of a comprehension is `for names in list`, or `if condition`, which has no names.
struct Clause {
  Span keyword;
  std::vector<NamePlace> names;
  const Expression* operand = nullptr;
};

/// A Comprehension is [value for names in list if condition].
struct Comprehension {
  const Expression* value = nullptr;
  std::vector<Clause> clauses;
};

/// A DictionaryLiteral is {name -> value, ...}.
struct DictionaryLiteral {
  std::vector<AttributeSyntax> entries;
};

/// An Index is base[index] (rule 9).
struct Index {
  const Expression* base = nullptr;
  const Expression* index = nullptr;
};

/// A Slice is base[first:end]. Either bound may be null.
struct Slice {
  const Expression* base = nullptr;
  const Expression* first = nullptr;
  const Expression* end = nullptr;
  Span colon{};
};

/// A Member is base.name.
struct Member {
  const Expression* base = nullptr;
  NamePlace name;
};

/// A Call is callee(arguments) (rule 10).
struct Call {
  const Expression* callee = nullptr;
  std::vector<const Expression*> arguments;
  /// These are the names of the last arguments, which are given as name -> value.
  std::vector<NamePlace> names;

  std::size_t unnamed() const { return arguments.size() - names.size(); }
};

enum class ModifierKind { scale, translate, rotate, mirror, matrix, material, id, shadow, visible };

/// Returns the word that a modifier begins with.
std::string_view word_of(ModifierKind kind);

/// A Modifier is scale, translate, rotate (rules 30 to 32) or another of these with its operand:
/// rotate 45 axis v about p.
struct Modifier {
  ModifierKind kind = ModifierKind::scale;
  const Expression* operand = nullptr;
  const Expression* axis = nullptr;   ///< null if it is not said
  const Expression* about = nullptr;  ///< likewise

  /// Returns all that are said.
  std::array<const Expression*, 3> operands() const { return {operand, axis, about}; }
};

/// Modified is base <modifiers> (rule 11).
struct Modified {
  const Expression* base = nullptr;
  std::vector<Modifier> modifiers;
};

enum class UnaryOperator { plus, minus, negation };

/// Unary is an operator before its operand (rules 12 and 13).
struct Unary {
  UnaryOperator op = UnaryOperator::plus;
  const Expression* operand = nullptr;
};

enum class BinaryOperator {
  power,
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

/// A Chain is first op operand op operand ..., from the left (rules 14 to 16).
struct Chain {
  const Expression* first = nullptr;
  std::vector<ChainLink> links;
};

enum class LogicalOperator { conjunction, disjunction };

/// Logical is a && b && c, or a || b || c (rules 17 and 18).
struct Logical {
  LogicalOperator op = LogicalOperator::conjunction;
  std::vector<const Expression*> operands;
};

/// A Conditional is condition ? yes : no (rule 19).
struct Conditional {
  const Expression* condition = nullptr;
  const Expression* yes = nullptr;
  const Expression* no = nullptr;
};

/// An Assignment is name = value (rule 20).
struct Assignment {
  NamePlace name;
  const Expression* value = nullptr;
};

/// A Destructuring is [a, b] = value.
struct Destructuring {
  std::vector<NamePlace> names;
  const Expression* value = nullptr;
};

using ExpressionNode =
    std::variant<Literal, Length, Interpolation, Name, ObjectLiteral, DerivedMaterial, MacroLiteral,
                 ListLiteral, Comprehension, DictionaryLiteral, Index, Slice, Member, Call,
                 Modified, Unary, Chain, Logical, Conditional, Assignment, Destructuring>;

struct Expression {
  Span span;
  ExpressionNode node;
  /// Counts the levels below it, blocks included. It is at most max_nesting.
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

/// An If has one branch for if, any number for else if, and one for else (whose condition is null).
struct If {
  struct Branch {
    const Expression* condition = nullptr;
    Block body;
  };
  std::vector<Branch> branches;
};

/// A For is for (names in list) { ... }. Several names take the items of each item.
struct For {
  Span keyword;
  std::vector<NamePlace> variables;
  const Expression* list = nullptr;
  Block body;
};

/// A Jump is a break or a continue, unless there is a variable of that name.
struct Jump {
  Span keyword;
  bool is_break = true;
  const Expression* name = nullptr;
};

/// A Return ends a macro's call, with a value or without.
struct Return {
  Span keyword;
  const Expression* value = nullptr;
  /// Without a value it may also be a variable of that name.
  const Expression* name = nullptr;
};

struct SettingsBlock {
  Span keyword;
  std::vector<AttributeSyntax> attributes;
};

struct SceneBlock {
  Span keyword;
  Block body;
};

/// An Import is import "path", or import "path" as name.
struct Import {
  Span path_span;
  std::string path;
  std::optional<NamePlace> name{};
};

struct Statement {
  Span span;
  std::variant<ExpressionStatement, While, If, For, Jump, Return, SettingsBlock, SceneBlock, Import>
      node;
  int height = 0;
};

/// A Script is a parsed text.
struct Script {
  std::deque<Expression> expressions;
  Block statements;
  /// This is set for a text that is one expression.
  const Expression* expression = nullptr;
};

}  // namespace crt::lang
