#include "format/layout.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <variant>

#include "lang/utf8.hpp"

namespace crt::format {

namespace {

using lang::Span;
using Kind = lang::Grammar::symbol_kind;

std::string_view text_of(const lang::Source& source, Span span) {
  return std::string_view(source.text).substr(span.begin - source.base, span.end - span.begin);
}

std::string_view without_blanks_behind(std::string_view text) {
  return text.substr(0, text.find_last_not_of(" \t\v\f") + 1);
}

/// Finds the operators that stand before their operand, and the colons of slices. The tokens alone
/// do not show which these are.
std::map<std::uint32_t, Role> roles_of_signs(const lang::Script& script) {
  std::map<std::uint32_t, Role> roles;
  for (const lang::Expression& expression : script.expressions) {
    if (std::holds_alternative<lang::Unary>(expression.node))
      roles[expression.span.begin] = Role::prefix;
    if (const auto* slice = std::get_if<lang::Slice>(&expression.node))
      roles[slice->colon.begin] = Role::joint;
  }
  return roles;
}

/// Finds the role of each token in turn.
class Roles {
 public:
  explicit Roles(const lang::Script& script) : signs_(roles_of_signs(script)) {}

  Role next(const lang::Token& token, std::string_view text) {
    const Role role = role_of(token, text);
    if (role == Role::opening_modifiers) ++open_modifiers_;
    if (role == Role::closing_modifiers) --open_modifiers_;
    // Within brackets in a modifier a '>' compares, as outside of modifiers.
    if (is_opening(role)) open_.push_back(std::exchange(open_modifiers_, 0));
    if (is_closing(role) && !open_.empty()) {
      open_modifiers_ = open_.back();
      open_.pop_back();
    }
    before_ = token.kind;
    return role;
  }

 private:
  static bool is_opening(Role role) {
    return role == Role::opening || role == Role::suffix_opening || role == Role::opening_brace;
  }
  static bool is_closing(Role role) { return role == Role::closing || role == Role::closing_brace; }

  Role role_of(const lang::Token& token, std::string_view text) const {
    switch (token.kind) {
      case Kind::S_COMMA:
        return Role::comma;
      case Kind::S_DOT:
      case Kind::S_STRING_MIDDLE:
        return Role::joint;
      case Kind::S_STRING_START:
        return Role::opening;
      case Kind::S_STRING_END:
        return Role::closing;
      case Kind::S_LEFT_PARENTHESIS:
      case Kind::S_LEFT_BRACKET:
        return follows_operand() ? Role::suffix_opening : Role::opening;
      case Kind::S_FIRST_PARENTHESIS:
      case Kind::S_FIRST_BRACKET:
        return Role::opening;
      case Kind::S_LEFT_BRACE:
      case Kind::S_DERIVING_BRACE:
      case Kind::S_DICTIONARY_BRACE:
        return Role::opening_brace;
      case Kind::S_MODIFIER_START:
        return Role::opening_modifiers;
      case Kind::S_RIGHT_PARENTHESIS:
      case Kind::S_RIGHT_BRACKET:
        return Role::closing;
      case Kind::S_RIGHT_BRACE:
        return Role::closing_brace;
      case Kind::S_GREATER:
        return open_modifiers_ > 0 ? Role::closing_modifiers : Role::sign;
      default:
        break;
    }
    if (const auto sign = signs_.find(token.span.begin); sign != signs_.end()) return sign->second;
    const char first = text[0];
    const bool is_sign = std::string_view("+-*/%^!<>=&|?:").find(first) != std::string_view::npos;
    return is_sign ? Role::sign : Role::word;
  }

  bool follows_operand() const {
    return before_ == Kind::S_IDENTIFIER || before_ == Kind::S_STRING ||
           before_ == Kind::S_STRING_END || before_ == Kind::S_RIGHT_PARENTHESIS ||
           before_ == Kind::S_RIGHT_BRACKET;
  }

  std::map<std::uint32_t, Role> signs_;
  int open_modifiers_ = 0;
  std::vector<int> open_;  ///< the modifiers that were open around each open bracket
  lang::Grammar::symbol_kind_type before_ = Kind::S_YYEMPTY;
};

/// Counts lines from piece to piece.
class Lines {
 public:
  explicit Lines(const lang::Source& source) : source_(source) {}

  /// Puts a piece at its place.
  void place(Piece& piece, std::uint32_t offset) {
    std::size_t line = line_;
    const std::vector<std::uint32_t>& starts = source_.line_starts;
    while (line + 1 < starts.size() && starts[line + 1] <= offset) ++line;
    piece.lines_before = line - line_;
    const std::string_view before =
        std::string_view(source_.text).substr(starts[line], offset - starts[line]);
    // Only what is behind another piece is kept in its column, so no long line is counted often.
    if (piece.role == Role::comment) piece.column = lang::count_code_points(before);
    line_ = line;
  }

 private:
  const lang::Source& source_;
  std::size_t line_ = 0;
};

}  // namespace

std::vector<Piece> lay_out(const lang::Source& source, const lang::TokenList& list,
                           const lang::Script& script) {
  std::vector<Piece> pieces;
  pieces.reserve(list.tokens.size() + list.comments.size());
  Roles roles(script);
  Lines lines(source);
  bool before_binds = false;  // the token before goes on with the next one
  auto comment = list.comments.begin();
  const auto add_comments = [&](std::uint32_t end) {
    for (; comment != list.comments.end() && comment->begin < end; ++comment) {
      Piece piece{.role = Role::comment, .text = without_blanks_behind(text_of(source, *comment))};
      lines.place(piece, comment->begin - source.base);
      pieces.push_back(piece);
    }
  };
  for (const lang::Token& token : list.tokens) {
    add_comments(token.span.begin);
    Piece piece{.text = text_of(source, token.span)};
    piece.role = roles.next(token, piece.text);
    piece.continues =
        before_binds || piece.role == Role::sign || piece.role == Role::opening_modifiers;
    before_binds = piece.role == Role::sign || piece.role == Role::prefix;
    lines.place(piece, token.span.begin - source.base);
    pieces.push_back(piece);
  }
  add_comments(source.base + static_cast<std::uint32_t>(source.text.size()) + 1);
  return pieces;
}

}  // namespace crt::format
