// This part of the lexer knows what neighbouring languages write, and says how CRT writes it. It
// hands on what was meant, so that one mistake gives one error.
#include <algorithm>
#include <array>
#include <cstddef>

#include "lang/builtins.hpp"
#include "lang/lexer.hpp"
#include "lang/objects.hpp"
#include "lang/word_byte.hpp"
#include "text/format.hpp"
#include "text/letters.hpp"

namespace crt::lang {

namespace {

bool is_line_end(unsigned char c) {
  return c == '\n' || c == '\r';
}

template <class List>
bool contains(const List& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

constexpr std::array<std::string_view, 6> words_for_nothing = {"null", "nil", "none",
                                                               "NULL", "Nil", "None"};

/// Returns the name of the object that has these letters, or nothing.
std::string_view object_of(std::string_view small_name) {
  for (const std::string_view block : {"Settings", "Scene"}) {
    if (text::in_small_letters(block) == small_name) return block;
  }
  for (const ObjectType& type : object_types()) {
    if (text::in_small_letters(type.name) == small_name) return type.name;
  }
  return {};
}

}  // namespace

bool is_foreign_modifier(std::string_view word) {
  constexpr std::array<std::string_view, 17> others = {
      "move",  "turn",  "shift",  "spin",      "resize",   "transform",
      "flip",  "color", "colour", "texture",   "pigment",  "finish",
      "shear", "skew",  "hidden", "invisible", "no_shadow"};
  const std::string small = text::in_small_letters(word);
  if (contains(others, small)) return true;
  for (const std::string_view known : {"rotate", "scale", "translate"}) {
    if (!small.starts_with(known)) continue;
    std::string_view axis = std::string_view(small).substr(known.size());
    if (axis.starts_with('_')) axis.remove_prefix(1);
    return axis.empty() || axis == "x" || axis == "y" || axis == "z";
  }
  return false;
}

std::string_view Lexer::first_word_of_line(Span span) const {
  const std::string_view all = source_.text;
  std::size_t begin = all.find_last_of("\r\n", span.begin - source_.base);
  begin = all.find_first_not_of(" \t", begin == std::string_view::npos ? 0 : begin + 1);
  if (begin == std::string_view::npos) return {};
  std::size_t end = begin;
  while (end < all.size() && ((all[end] >= 'a' && all[end] <= 'z') || all[end] == '_')) ++end;
  return all.substr(begin, end - begin);
}

std::string_view Lexer::word_before_brackets(Span span) const {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  const std::string_view all = source_.text;
  std::size_t end = span.begin - source_.base;
  while (end > 0 && blank(all[end - 1])) --end;
  if (end == 0 || all[end - 1] != ')') return {};
  std::size_t open = 0;
  do {
    const char c = all[--end];
    if (c == ')') ++open;
    if (c == '(') --open;
    if (is_line_end(static_cast<unsigned char>(c))) return {};
  } while (open > 0 && end > 0);
  while (end > 0 && blank(all[end - 1])) --end;
  std::size_t begin = end;
  while (begin > 0 && is_word_byte(all[begin - 1])) --begin;
  return all.substr(begin, end - begin);
}

std::optional<Span> Lexer::word_of_modifier() const {
  if (before_last_.kind != Grammar::symbol_kind::S_GREATER) return std::nullopt;
  const std::string_view all = source_.text;
  const std::size_t close = before_last_.span.begin - source_.base;
  const std::size_t open = all.find_last_of("<\r\n", close);
  if (open == std::string_view::npos || all[open] != '<') return std::nullopt;
  const std::size_t begin = all.find_first_not_of(" \t", open + 1);
  std::size_t end = begin;
  while (is_word_byte(all[end])) ++end;
  const std::size_t value = all.find_first_not_of(" \t", end);
  if (end == begin || value == end || value >= close) return std::nullopt;
  return Span{source_.base + static_cast<std::uint32_t>(begin),
              source_.base + static_cast<std::uint32_t>(end)};
}

void Lexer::foreign_comment() {
  reporter_.error(token_span(),
                  text::format("comments begin with '--', not with '{}'", token_text()));
  skip_comment();
}

void Lexer::foreign_block_comment() {
  reporter_.error(token_span(),
                  "comments begin with '--', on each of their lines; there is no '/* */'");
  const std::size_t end = source_.text.find("*/", offset(cursor_) - source_.base);
  if (end == std::string::npos) return skip_comment();
  const Byte* const closing = token_ + (end + 2 - (offset(token_) - source_.base));
  if (std::any_of(cursor_, closing, is_line_end)) first_on_line_ = true;
  cursor_ = closing;
}

/// Says whether '#' begins a colour such as #ff8000, where there is to be a value.
bool Lexer::color_follows() const {
  using Kind = Grammar::symbol_kind;
  constexpr std::array<int, 5> before = {Kind::S_ARROW, Kind::S_ASSIGN, Kind::S_COMMA,
                                         Kind::S_LEFT_PARENTHESIS, Kind::S_LEFT_BRACKET};
  if (std::find(before.begin(), before.end(), last_.kind) == before.end()) return false;
  const std::string_view word = next_word();
  constexpr std::string_view digits = "0123456789abcdefABCDEF";
  return (word.size() == 3 || word.size() == 6) &&
         word.find_first_not_of(digits) == std::string_view::npos;
}

Grammar::symbol_type Lexer::foreign_color() {
  cursor_ += next_word().size();
  reporter_.error(token_span(),
                  text::format("a colour of digits stands in quotes: \"{}\"", token_text()));
  first_on_line_ = false;
  return Grammar::make_INTEGER(0, token_span());
}

/// Reports `i++`, and says whether it was that. Before a value the two signs are what they are.
bool Lexer::refuse_increment() {
  const bool attached =
      last_.kind == Grammar::symbol_kind::S_IDENTIFIER && last_.span.end == offset(token_);
  if (!attached) return false;
  const Byte* const next = next_on_line(cursor_);
  const bool ends = next == limit_ || is_line_end(*next) || *next == ')' || *next == ']' ||
                    *next == '}' || *next == ',' || *next == ';' ||
                    (next[0] == '-' && next[1] == '-');
  if (!ends) return false;
  reporter_.error(token_span(),
                  text::format("there is no '++'; write '{} += 1'", text(last_.span)));
  return true;
}

/// Returns a built-in, or true or false, that is written with capitals.
std::optional<Grammar::symbol_type> Lexer::small_letters_for(std::string_view name) {
  using Token = Grammar::token;
  const std::string small = text::in_small_letters(name);
  const bool is_truth = small == "true" || small == "false";
  const auto known = builtins();
  const bool is_builtin =
      std::any_of(known.begin(), known.end(), [&](const Builtin& b) { return b.name == small; });
  if (!is_truth && !(is_builtin && *next_on_line(cursor_) == '(')) return std::nullopt;
  reporter_.error(token_span(), text::format("this is written in small letters: '{}'", small));
  if (is_truth) return sign(small == "true" ? Token::TRUE : Token::FALSE);
  return Grammar::make_IDENTIFIER(symbols_.intern(small), token_span());
}

/// Returns the token that a word of another language stands for, if it does.
std::optional<Grammar::symbol_type> Lexer::foreign_word(std::string_view name, bool is_capital) {
  using Token = Grammar::token;
  const Byte* const next = next_token_start();
  const bool sets = next[0] == '=' && next[1] != '=';
  if (!is_capital) {
    if ((name == "elseif" || name == "elsif") && *next == '(' &&
        last_.kind == Grammar::symbol_kind::S_RIGHT_BRACE) {
      reporter_.error(token_span(), "another condition is written 'else if' or 'elif'");
      return sign(Token::ELIF);
    }
    // No name can stand before a brace.
    const std::string_view object =
        *next == '{' ? object_of(text::in_small_letters(name)) : std::string_view();
    if (object.empty()) return std::nullopt;
    reporter_.error(token_span(),
                    text::format("objects begin with a capital letter: '{}'", object));
    if (object == "Settings") return sign(Token::SETTINGS);
    if (object == "Scene") return sign(Token::SCENE);
    return Grammar::make_OBJECT_NAME(symbols_.intern(object), token_span());
  }
  // An object's name stands before a brace only.
  if (*next == '{') return std::nullopt;
  const Symbol symbol = symbols_.intern(name);
  if (begins_modifier()) return Grammar::make_IDENTIFIER(symbol, token_span());
  if (sets) {
    std::string small(name);
    small[0] = static_cast<char>(small[0] - 'A' + 'a');
    reporter_.error(token_span(),
                    text::format("names of variables begin with a small letter: '{}'", small));
    capital_variables_.insert(symbol);
  }
  if (capital_variables_.contains(symbol)) return Grammar::make_IDENTIFIER(symbol, token_span());
  if (contains(words_for_nothing, name)) {
    reporter_.error(token_span(),
                    "there is no value for nothing; leave the attribute out, or use an empty List");
    return Grammar::make_INTEGER(0, token_span());
  }
  return small_letters_for(name);
}

}  // namespace crt::lang
