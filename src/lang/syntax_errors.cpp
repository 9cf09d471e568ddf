// This file puts syntax errors into the words of a user.
#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "lang/suggestion.hpp"
#include "lang/tree_builder.hpp"
#include "text/format.hpp"

namespace crt::lang {

namespace {

using Names = std::set<std::string>;

// The names are those of the tokens in grammar.y.
constexpr std::array expression_starts = {"a whole number",
                                          "a number",
                                          "a string",
                                          "a string up to a value",
                                          "{ of a dictionary",
                                          "a name",
                                          "an object's name",
                                          "Macro",
                                          "true",
                                          "false",
                                          "(",
                                          "( first on its line",
                                          "[",
                                          "[ first on its line",
                                          "!",
                                          "+",
                                          "-"};
constexpr std::array operators = {"**",
                                  "+=",
                                  "-=",
                                  "*=",
                                  "/=",
                                  "+",
                                  "-",
                                  "*",
                                  "/",
                                  "%",
                                  "^",
                                  "<",
                                  ">",
                                  "<=",
                                  ">=",
                                  "==",
                                  "!=",
                                  "&&",
                                  "||",
                                  "?",
                                  "=",
                                  "(",
                                  "[",
                                  ".",
                                  "< before a modifier",
                                  "{ behind a name"};
constexpr std::array statement_starts = {"while",    "if",    "for",  "import", "return",
                                         "Settings", "Scene", "else", "elif"};

template <class List>
void erase(Names& names, const List& list) {
  for (const char* name : list) names.erase(name);
}

/// Replaces groups of tokens by what a user calls them.
std::vector<std::string> in_words(const std::vector<std::string>& expected) {
  Names names(expected.begin(), expected.end());
  const bool statement = names.contains("while");
  const bool whole_expression = names.contains("a whole number");
  const bool after_operand = names.contains("*");
  const bool attribute = names.contains("a name") && names.contains("}") && !whole_expression;
  std::vector<std::string> words;
  if (statement) {
    words.emplace_back("a statement");
    erase(names, statement_starts);
  }
  if (whole_expression || statement) {
    if (!statement) words.emplace_back("an expression");
    erase(names, expression_starts);
    erase(names, operators);
  }
  // The '=' of a parameter's default is an error of its own. What may be left out is not expected.
  if (names.contains(",") && !after_operand) erase(names, std::array{"=", "->"});
  if (after_operand) names.erase("->");
  if (names.contains("]")) erase(names, std::array{"for", ":"});
  if (names.erase("a string between values") > 0) {
    names.erase("the end of a string");
    names.insert("}");
  }
  // A name at the beginning of a modifier is an error of its own.
  if (names.contains("rotate") && !whole_expression && !statement) names.erase("a name");
  if (attribute) {
    words.emplace_back("an attribute");
    names.erase("a name");
  }
  // In a list of modifiers '>' closes the list, and is no comparison.
  const bool closes_modifiers = names.contains(">") && !names.contains("<");
  if (after_operand) erase(names, operators);
  if (closes_modifiers) names.insert(">");
  for (const char* name : {"a whole number", "a number", "a string", "a name", "an object's name"})
    if (names.erase(name) > 0) words.emplace_back(name);
  if (names.erase("the end of the script") > 0 && words.empty() && names.empty() && !after_operand)
    words.emplace_back("the end of the script");
  names.erase("( first on its line");
  for (const std::string& name : names) words.push_back("'" + name + "'");
  if (words.empty() && after_operand) words.emplace_back("an operator");
  return words;
}

}  // namespace

std::string TreeBuilder::describe_found(Span place, const std::string& found) const {
  constexpr std::size_t longest_shown = 30;
  if (found == "the end of the script") return found;
  if (found == "a string" || found == "a string up to a value") return "string";
  const std::string text(lexer_.text(place).substr(0, longest_shown));
  return "'" + text + "'";
}

/// Says whether `place` is on a later line than the last syntax error. Other errors on the same
/// line mostly follow from the first.
bool TreeBuilder::is_past_error(Span place) const {
  return !last_error_line_end_ || place.begin > *last_error_line_end_;
}

/// Says in which line a brace stands that is open, if that is another line.
std::string TreeBuilder::open_brace(Span place) {
  const std::vector<Span>& open = lexer_.open_brackets();
  if (open.empty() || lexer_.text(open.back()) != "{") return {};
  const int line = reporter_.line_of(lexer_.brace_to_blame());
  if (line == reporter_.line_of(place)) return {};
  has_named_brace_ = true;
  return text::format("; the '{{' in line {} is open", line);
}

void TreeBuilder::syntax_error(Span place, const std::string& found,
                               const std::vector<std::string>& expected) {
  if (const std::optional<Span> word = lexer_.word_of_modifier();
      word && contains(expected, "a whole number")) {
    last_error_line_end_ = lexer_.line_end(place);
    return unknown_modifier(*word);
  }
  const std::vector<Span>& open = lexer_.open_brackets();
  const bool at_end = found == "the end of the script";
  // That a brace is open was said, and what comes of it needs no other error.
  if (has_named_brace_ && (found == "}" || at_end)) return;
  const std::vector<std::string> words = in_words(expected);
  std::string message = "unexpected " + describe_found(place, found);
  const bool wants_arrow = expected.size() == 1 && expected[0] == "->";
  if (wants_arrow) {
    message += found == "=" ? "; an attribute is given with '->'"
                            : "; expected '->' after the attribute's name";
  } else if (found == "->") {
    message += "; attributes stand in an object's braces, and a variable is set with '='";
  } else if (const std::string known = hint(place, found, expected); !known.empty()) {
    message += known;
  } else if (!words.empty()) {
    message += "; expected " + enumerate(words);
    const bool lacks_brace = words.front() == "an attribute";
    if (lacks_brace) message += open_brace(place);
  }
  last_error_line_end_ = lexer_.line_end(place);
  if (at_end && !open.empty()) {
    const bool is_brace = lexer_.text(open.back()) == "{";
    const Span blamed = is_brace ? lexer_.brace_to_blame() : open.back();
    reporter_.error(blamed, text::format("this '{}' is never closed", lexer_.text(blamed)));
    return;
  }
  if (contains({"Settings", "Scene", "import"}, found) && !contains(expected, found) &&
      contains(expected, "while"))
    message =
        text::format("'{}' stands at the top level only, in no braces{}", found, open_brace(place));
  reporter_.error(place, message);
}

}  // namespace crt::lang
