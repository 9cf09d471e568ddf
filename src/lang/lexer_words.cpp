// This part of the lexer looks ahead, to say which words are keywords where.
#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "lang/lexer.hpp"
#include "lang/word_byte.hpp"

namespace crt::lang {

namespace {

using Terminal = Grammar::token;

/// No more modifiers can lie within one another.
constexpr std::size_t max_open_modifiers = 1000;

struct Word {
  std::string_view text;
  Terminal::token_kind_type kind;
};

/// These words have a meaning at the beginning of a modifier alone.
constexpr std::array modifier_words = {
    Word{"material", Terminal::MATERIAL}, Word{"id", Terminal::ID},
    Word{"matrix", Terminal::MATRIX},     Word{"shadow", Terminal::SHADOW},
    Word{"visible", Terminal::VISIBLE},   Word{"mirror", Terminal::MIRROR},
};

}  // namespace

/// Returns the kind of a word that is a keyword in some places only, and a name in all others.
std::optional<Terminal::token_kind_type> Lexer::keyword_by_place(std::string_view name) const {
  if (compat_ == compat_2015) return std::nullopt;
  if (begins_modifier()) {
    const auto* modifier = std::find_if(modifier_words.begin(), modifier_words.end(),
                                        [name](const Word& k) { return k.text == name; });
    if (modifier != modifier_words.end()) return modifier->kind;
  }
  if (name == "elif" && last_.kind == Grammar::symbol_kind::S_RIGHT_BRACE &&
      *next_on_line(cursor_) == '(')
    return Terminal::ELIF;
  if (name == "return" && may_begin_statement() &&
      (value_follows(cursor_, true) || *next_on_line(cursor_) == '{'))
    return Terminal::RETURN;
  if (name == "as" && last_.kind == Grammar::symbol_kind::S_STRING &&
      before_last_.kind == Grammar::symbol_kind::S_IMPORT && is_word_byte(*next_on_line(cursor_)))
    return Terminal::AS;
  return std::nullopt;
}

const Lexer::Byte* Lexer::next_token_start() const {
  const Byte* position = cursor_;
  for (;;) {
    const std::string_view blanks = " \t\v\f\r\n";
    while (position < limit_ && blanks.find(static_cast<char>(*position)) != std::string_view::npos)
      ++position;
    // The NUL behind the end lets one look a byte ahead.
    if (position == limit_ || position[0] != '-' || position[1] != '-') return position;
    while (position < limit_ && *position != '\n' && *position != '\r') ++position;
  }
}

std::string_view Lexer::next_word() const {
  const Byte* begin = next_token_start();
  const Byte* end = begin;
  while (is_word_byte(*end)) ++end;
  return text({offset(begin), offset(end)});
}

/// Returns the first byte from `position` on that is no blank. It may be a line end.
const Lexer::Byte* Lexer::next_on_line(const Byte* position) const {
  const std::string_view blanks = " \t\v\f";
  while (position < limit_ && blanks.find(static_cast<char>(*position)) != std::string_view::npos)
    ++position;
  return position;
}

/// Says whether what follows a word that ends at `end` can only begin a value: not what continues
/// an expression that the word is a name in. A bracket or sign does if a blank is before it, and
/// none behind the sign. Signs count only if they `may_be_signed`.
bool Lexer::value_follows(const Byte* end, bool may_be_signed) const {
  const Byte* const next = next_on_line(end);
  // The NUL behind the end lets one look a byte ahead.
  switch (*next) {
    case '"':
      return true;
    case '.':
      return next[1] >= '0' && next[1] <= '9';
    case '(':
    case '[':
      return next > end;
    case '!':
      return may_be_signed && next[1] != '=';
    case '+':
    case '-':
      return may_be_signed && next > end && next[1] != next[0] && next[1] != '=' &&
             next[1] != '>' && next_on_line(next + 1) == next + 1;
    default:
      return is_word_byte(*next);
  }
}

bool Lexer::modifier_follows() const {
  if (tolerance_.ends_at_cursor && next_token_start() == limit_) return true;
  const std::string_view next = next_word();
  if (next == "scale" || next == "translate" || next == "rotate") return true;
  if (compat_ == compat_2015) return false;
  const bool is_modifier = std::any_of(modifier_words.begin(), modifier_words.end(),
                                       [next](const Word& k) { return k.text == next; });
  const bool is_foreign = !is_modifier && is_foreign_modifier(next);
  if (!is_modifier && !is_foreign) return false;
  const Byte* const behind = next_token_start() + next.size();
  return value_follows(behind, false) && (is_modifier || is_closed_on_line(behind));
}

/// Says whether a '>' that is no part of another sign follows on the line, and not far away.
bool Lexer::is_closed_on_line(const Byte* position) const {
  constexpr std::ptrdiff_t far = 1000;
  const Byte* const end = position + std::min(far, limit_ - position);
  for (; position < end && *position != '\n' && *position != '\r'; ++position) {
    if (position[0] == '>' && position[-1] != '-' && position[1] != '=') return true;
  }
  return false;
}

/// Says whether a modifier begins here: behind the '<' or a comma of modifiers.
bool Lexer::begins_modifier() const {
  if (last_.kind == Grammar::symbol_kind::S_MODIFIER_START) return true;
  return last_.kind == Grammar::symbol_kind::S_COMMA && !open_modifiers_.empty() &&
         open_modifiers_.back() == open_brackets_.size();
}

/// Says whether the token before can end a statement or open a block.
bool Lexer::may_begin_statement() const {
  switch (last_.kind) {
    case Grammar::symbol_kind::S_LEFT_BRACE:
    case Grammar::symbol_kind::S_DERIVING_BRACE:
    case Grammar::symbol_kind::S_RIGHT_BRACE:
    case Grammar::symbol_kind::S_RIGHT_PARENTHESIS:
    case Grammar::symbol_kind::S_RIGHT_BRACKET:
    case Grammar::symbol_kind::S_IDENTIFIER:
    case Grammar::symbol_kind::S_INTEGER:
    case Grammar::symbol_kind::S_FLOAT:
    case Grammar::symbol_kind::S_STRING:
    case Grammar::symbol_kind::S_STRING_END:
    case Grammar::symbol_kind::S_TRUE:
    case Grammar::symbol_kind::S_FALSE:
    case Grammar::symbol_kind::S_GREATER:
    case Grammar::symbol_kind::S_START_SCRIPT:
      return true;
    default:
      return false;
  }
}

Grammar::symbol_type Lexer::less() {
  if (!modifier_follows()) return sign(Terminal::LESS);
  if (open_modifiers_.size() < max_open_modifiers) open_modifiers_.push_back(open_brackets_.size());
  return sign(Terminal::MODIFIER_START);
}

/// Forgets modifiers that lie in brackets which are closed.
void Lexer::forget_closed_modifiers() {
  while (!open_modifiers_.empty() && open_modifiers_.back() > open_brackets_.size())
    open_modifiers_.pop_back();
}

Grammar::symbol_type Lexer::greater() {
  if (!open_modifiers_.empty() && open_modifiers_.back() == open_brackets_.size())
    open_modifiers_.pop_back();
  return sign(Terminal::GREATER);
}

/// Says whether a '{' is between a name and an attribute.
bool Lexer::derivation_follows() const {
  if (last_.kind != Grammar::symbol_kind::S_IDENTIFIER || compat_ == compat_2015) return false;
  const std::string_view name = next_word();
  const Byte* position = next_token_start() + name.size();
  while (*position == ' ') ++position;
  return !name.empty() && position[0] == '-' && position[1] == '>';
}

/// Says whether a '.' is between a value and the name of a part of it.
bool Lexer::member_follows() const {
  using Kind = Grammar::symbol_kind;
  const bool is_behind_value =
      last_.span.end == offset(token_) &&
      (last_.kind == Kind::S_IDENTIFIER || last_.kind == Kind::S_RIGHT_PARENTHESIS ||
       last_.kind == Kind::S_RIGHT_BRACKET || last_.kind == Kind::S_RIGHT_BRACE);
  // At the end of a text that is still being written, the name may be what comes next.
  return is_behind_value && (cursor_ == limit_ || is_word_byte(*cursor_));
}

/// Returns what a '{' begins. It is a dictionary where a value is to be.
Terminal::token_kind_type Lexer::kind_of_brace() const {
  using Kind = Grammar::symbol_kind;
  if (derivation_follows()) return Terminal::DERIVING_BRACE;
  constexpr std::array<int, 21> before_value = {Kind::S_ASSIGN,
                                                Kind::S_ARROW,
                                                Kind::S_COMMA,
                                                Kind::S_LEFT_PARENTHESIS,
                                                Kind::S_FIRST_PARENTHESIS,
                                                Kind::S_LEFT_BRACKET,
                                                Kind::S_FIRST_BRACKET,
                                                Kind::S_RETURN,
                                                Kind::S_QUESTION,
                                                Kind::S_COLON,
                                                Kind::S_IN,
                                                Kind::S_PLUS,
                                                Kind::S_EQUAL,
                                                Kind::S_NOT_EQUAL,
                                                Kind::S_ADD_ASSIGN,
                                                Kind::S_STRING_START,
                                                Kind::S_STRING_MIDDLE,
                                                Kind::S_AND,
                                                Kind::S_OR,
                                                Kind::S_IF,
                                                Kind::S_START_EXPRESSION};
  const bool is_value =
      std::find(before_value.begin(), before_value.end(), last_.kind) != before_value.end();
  return is_value && compat_ != compat_2015 ? Terminal::DICTIONARY_BRACE : Terminal::LEFT_BRACE;
}

bool Lexer::arrow_follows() const {
  const Byte* position = next_token_start();
  return position[0] == '-' && position[1] == '>';
}

/// Says whether a word is a keyword in a script of 2015, when there were no control statements and
/// no imports.
bool Lexer::is_keyword_of_2015(Terminal::token_kind_type kind) const {
  const Byte* const next = next_token_start();
  switch (kind) {
    case Terminal::WHILE:
    case Terminal::IF:
    case Terminal::FOR:
      // First on its line a '(' continues nothing.
      return *next == '(' &&
             std::none_of(cursor_, next, [](Byte c) { return c == '\n' || c == '\r'; });
    case Terminal::ELSE:
      return *next == '{' || next_word() == "if";
    case Terminal::IN: {
      constexpr int tokens_before = 3;
      return for_tokens_ == tokens_before;
    }
    case Terminal::IMPORT:
      return *next == '"';
    default:
      return true;
  }
}

}  // namespace crt::lang
