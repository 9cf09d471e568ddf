// The grammar's actions call this. It builds the tree's nodes, bounds their nesting and number, and
// puts syntax errors into words.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lang/lexer.hpp"
#include "lang/nesting.hpp"
#include "lang/reporter.hpp"
#include "lang/syntax.hpp"

namespace crt::lang {

class TreeBuilder {
 public:
  /// `memory_left` is the number of bytes that the tree may still hold. It shrinks.
  TreeBuilder(const Lexer& lexer, Reporter& reporter, std::size_t& memory_left)
      : lexer_(lexer), reporter_(reporter), memory_left_(memory_left) {}

  /// Pays for the names in a text of so many bytes.
  void charge_source(std::size_t bytes);

  /// Returns the finished tree.
  Script take() { return std::move(script_); }

  // The following functions are for the grammar.

  /// Opens something that can hold itself, at `place`.
  Nesting enter(Span place);

  Expression* literal(Span span, Value value) {
    return expression(span, Literal{std::move(value)});
  }
  Expression* number(Span span, const Number& number) {
    if (number.unit) return expression(span, Length{number.value, *number.unit});
    return expression(span, Literal{number.value, number.is_angle});
  }
  static Value string(std::string text);

  Expression* expression(Span span, ExpressionNode node);
  Expression* chain(Expression* left, BinaryOperator op, Span op_span, const Expression* right);
  Expression* logical(LogicalOperator op, Expression* left, const Expression* right);
  /// Builds `target = value`. Where `target` is neither a name nor a list of names, that is an
  /// error, and a comparison.
  Expression* assignment(Span span, Expression* target, Span op_span, const Expression* value);
  /// Builds `target op= value`, which is `target = target op value`.
  Expression* assignment(Span span, Expression* target, BinaryOperator op, Span op_span,
                         const Expression* value);
  Expression* macro(Span span, Parameters parameters, Block body);
  static Parameters parameter(Parameters parameters, const AttributeSyntax& parameter);
  Expression* member(Span span, const Expression* base, NamePlace name) {
    return expression(span, Member{base, name});
  }
  /// Returns a piece of a string with values in it.
  Expression* text(Span span, std::string text) { return literal(span, string(std::move(text))); }
  Expression* interpolation(Span span, const Expression* first,
                            std::vector<const Expression*> parts, const Expression* last);
  Call argument(Call call, const Expression* value);
  static Call argument(Call call, NamePlace name, const Expression* value);
  Expression* call(Span span, const Expression* callee, Call call);
  Expression* comprehension(Span span, const Expression* value, std::vector<Clause> clauses);
  Expression* dictionary(Span span, std::vector<AttributeSyntax> entries);
  /// Returns the name that the text of a string is.
  NamePlace key(Span span, const std::string& text) { return {lexer_.intern(text), span}; }

  template <class Node>
  Statement statement(Span span, Node node) {
    return finish_statement(Statement{span, std::move(node)});
  }
  void unknown_modifier(Span name);
  /// Returns a modifier with what follows its operand: `axis` or `about`.
  Modifier modifier_with(const Modifier& modifier, Span name, const Expression* operand);
  void refuse_default(Span equals);
  Statement expression_statement(Span span, const Expression* expression);
  static If branch(If branches, const Expression* condition, Block body);
  Block append(Block block, Statement statement);

  void finish(Block statements) { script_.statements = std::move(statements); }
  void finish(const Expression* expression) { script_.expression = expression; }

  bool is_past_error(Span place) const;
  void syntax_error(Span place, const std::string& found, const std::vector<std::string>& expected);

  /// Keeps what the grammar would take where the text ends at the cursor.
  void expect_at_cursor(std::vector<std::string> expected) { expected_ = std::move(expected); }
  std::vector<std::string> take_expected() { return std::move(expected_); }

 private:
  Statement finish_statement(Statement statement);
  void refuse_repeated(const std::vector<NamePlace>& names, const char* message);
  void check_height(Span span, int height);
  void charge(std::size_t bytes, Span span);
  std::string hint(Span place, const std::string& found,
                   const std::vector<std::string>& expected) const;
  std::string open_brace(Span place);
  std::string describe_found(Span place, const std::string& found) const;

  const Lexer& lexer_;
  Reporter& reporter_;
  std::size_t& memory_left_;
  int depth_ = 0;
  std::optional<std::uint32_t> last_error_line_end_;
  bool has_named_brace_ = false;  ///< an error said which brace is not closed
  std::vector<std::string> expected_;
  Script script_;
};

}  // namespace crt::lang
