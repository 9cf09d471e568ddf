// The lexer turns text into tokens. re2c makes the automata of the blocks in special comments. The
// text ends in a NUL that is not part of it (re2c's end-of-input rule `$` distinguishes the two).
// Patterns match UTF-8. Bytes that are none fall to the rule `*`.
#include "lang/lexer.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "lang/utf8.hpp"
#include "lang/word_byte.hpp"
#include "text/format.hpp"

namespace crt::lang {

namespace {

using Token = Grammar::token;

/// So many brackets may wait to be closed. The parser takes no more.
constexpr std::size_t max_open_brackets = 1000;
constexpr std::size_t max_forgotten_brackets = 8;
/// No name needs to be longer.
constexpr std::size_t longest_name = 255;

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

struct Keyword {
  std::string_view text;
  Token::token_kind_type kind;
};

constexpr std::array keywords = {
    Keyword{"Settings", Token::SETTINGS}, Keyword{"Scene", Token::SCENE},
    Keyword{"Macro", Token::MACRO},       Keyword{"scale", Token::SCALE},
    Keyword{"translate", Token::TRANSLATE}, Keyword{"rotate", Token::ROTATE},
    Keyword{"true", Token::TRUE},         Keyword{"false", Token::FALSE},
    Keyword{"while", Token::WHILE},       Keyword{"if", Token::IF},
    Keyword{"else", Token::ELSE},         Keyword{"for", Token::FOR},
    Keyword{"in", Token::IN},             Keyword{"import", Token::IMPORT},
};

const unsigned char* bytes(const std::string& text) {
  return reinterpret_cast<const unsigned char*>(text.data());
}

}  // namespace

Lexer::Lexer(const Source& source, TextKind kind, int compat, SymbolTable& symbols,
             Reporter& reporter)
    : source_(source),
      symbols_(symbols),
      reporter_(reporter),
      cursor_(bytes(source.text)),
      limit_(bytes(source.text) + source.text.size()),
      token_(cursor_),
      start_(kind == TextKind::script ? Token::START_SCRIPT : Token::START_EXPRESSION),
      compat_(compat) {
  if (source.text.starts_with(byte_order_mark)) cursor_ += byte_order_mark.size();
}

std::uint32_t Lexer::offset(const Byte* position) const {
  return source_.base + static_cast<std::uint32_t>(position - bytes(source_.text));
}

std::string_view Lexer::text(Span span) const {
  return std::string_view(source_.text).substr(span.begin - source_.base, span.end - span.begin);
}

std::uint32_t Lexer::line_end(Span span) const {
  const std::size_t end = source_.text.find_first_of("\r\n", span.begin - source_.base);
  return source_.base + static_cast<std::uint32_t>(std::min(end, source_.text.size()));
}

std::string_view Lexer::token_text() const { return text(token_span()); }

Grammar::symbol_type Lexer::next() {
  using Kind = Grammar::symbol_kind;
  Grammar::symbol_type token = scan();
  const auto kind = token.kind();
  before_last_ = std::exchange(last_, {kind, token.location});
  const bool opens = kind == Kind::S_LEFT_PARENTHESIS || kind == Kind::S_FIRST_PARENTHESIS;
  const bool continues =
      (for_tokens_ == 1 && opens) || (for_tokens_ == 2 && kind == Kind::S_IDENTIFIER);
  for_tokens_ = continues ? for_tokens_ + 1 : (kind == Kind::S_FOR ? 1 : 0);
  return token;
}

Grammar::symbol_type Lexer::scan() {
  if (!std::exchange(started_, true)) {
    token_ = cursor_;
    return Grammar::symbol_type(start_, token_span());
  }
  for (;;) {
    token_ = cursor_;
    const Byte* marker = cursor_;
    /*!re2c
      re2c:define:YYCTYPE = Byte;
      re2c:define:YYCURSOR = cursor_;
      re2c:define:YYLIMIT = limit_;
      re2c:define:YYMARKER = marker;
      re2c:yyfill:enable = 0;
      re2c:eof = 0;
      re2c:encoding:utf8 = 1;

      digits = [0-9]+;
      exponent = [eE] [+-]? digits;
      other_letter = [\u00C0-\u1FFF\u3040-\uD7FF\uF900-\uFAFF];

      $        { return ending(); }
      *        { not_utf8(); continue; }
      "--"     { skip_comment(); continue; }
      "//"     { foreign_comment(); continue; }
      "/*"     { foreign_block_comment(); continue; }
      "#"      { if (color_follows()) return foreign_color();
                 foreign_comment();
                 continue; }
      [ \t\v\f]+               { continue; }
      "\r\n" | "\n" | "\r"     { if (value_is_open()) return unclosed_value();
                                 first_on_line_ = true;
                                 continue; }

      [a-zA-Z_] [A-Za-z0-9_]*  { return word(); }
      // This is meant as a name, but has letters that names do not have.
      ([A-Za-z0-9_] | other_letter)* ([_] | other_letter) ([A-Za-z0-9_] | other_letter)*
                               { return wrong_word(); }
      digits                   { return whole_number(); }
      digits "." digits? exponent? | "." digits exponent? | digits exponent
                               { return decimal_number(); }
      "\""                     { return string(Token::STRING, Token::STRING_START); }
      "'" [^'"\r\n]* "'"        { return single_quoted(); }

      "{"      { return opening(kind_of_brace()); }
      "("      { return opening(first_on_line_ ? Token::FIRST_PARENTHESIS
                                               : Token::LEFT_PARENTHESIS); }
      "["      { return opening(first_on_line_ ? Token::FIRST_BRACKET : Token::LEFT_BRACKET); }
      "}"      { if (closes_value()) return string(Token::STRING_END, Token::STRING_MIDDLE);
                 if (closes_passed_over()) continue;
                 return closing(Token::RIGHT_BRACE, '{'); }
      ")"      { return closing(Token::RIGHT_PARENTHESIS, '('); }
      "]"      { return closing(Token::RIGHT_BRACKET, '['); }
      "<"      { return less(); }
      ">"      { return greater(); }
      "<="     { return sign(Token::LESS_EQUAL); }
      ">="     { return sign(Token::GREATER_EQUAL); }
      "=="     { return sign(Token::EQUAL); }
      "!="     { return sign(Token::NOT_EQUAL); }
      "&&"     { return sign(Token::AND); }
      "||"     { return sign(Token::OR); }
      "->"     { return sign(Token::ARROW); }
      "**"     { return sign(Token::POWER); }
      "+="     { return sign(Token::ADD_ASSIGN); }
      "-="     { return sign(Token::SUBTRACT_ASSIGN); }
      "*="     { return sign(Token::MULTIPLY_ASSIGN); }
      "/="     { return sign(Token::DIVIDE_ASSIGN); }
      "++"     { if (refuse_increment()) continue;
                 cursor_ = token_ + 1;
                 return sign(Token::PLUS); }
      "+"      { return sign(Token::PLUS); }
      "-"      { return sign(Token::MINUS); }
      "*"      { return sign(Token::STAR); }
      "/"      { return sign(Token::SLASH); }
      "%"      { return sign(Token::PERCENT); }
      "^"      { return sign(Token::CARET); }
      "!"      { return sign(Token::NOT); }
      "?"      { return sign(Token::QUESTION); }
      ":"      { return sign(Token::COLON); }
      "="      { return sign(Token::ASSIGN); }
      ","      { return sign(Token::COMMA); }
      "."      { if (member_follows()) return sign(Token::DOT);
                 unexpected_character();
                 continue; }

      // This is last, as the first of several patterns that match the same text wins.
      [^]      { unexpected_character(); continue; }
    */
  }
}

/// Gives out what the tolerance adds behind the text, then the end.
Grammar::symbol_type Lexer::ending() {
  if (std::exchange(tolerance_.ends_at_cursor, false)) return sign(Token::CURSOR);
  if (value_is_open()) return unclosed_value();
  if (!tolerance_.closes_brackets) return sign(Token::END);
  while (closes_passed_over()) continue;
  if (open_brackets_.empty()) return sign(Token::END);
  const char bracket = text(open_brackets_.back())[0];
  reporter_.error(open_brackets_.back(), "this bracket is never closed");
  open_brackets_.pop_back();
  const Span behind{offset(limit_), offset(limit_) + 1};
  return Grammar::symbol_type(bracket == '{'   ? Token::RIGHT_BRACE
                              : bracket == '(' ? Token::RIGHT_PARENTHESIS
                                               : Token::RIGHT_BRACKET,
                              behind);
}

Grammar::symbol_type Lexer::sign(Token::token_kind_type kind) {
  first_on_line_ = false;
  return Grammar::symbol_type(kind, token_span());
}

Grammar::symbol_type Lexer::opening(Token::token_kind_type kind) {
  if (open_brackets_.size() < max_open_brackets) open_brackets_.push_back(token_span());
  return sign(kind);
}

/// Closes a brace that the parser has passed over, if this one does.
bool Lexer::closes_passed_over() {
  if (open_brackets_.empty()) return false;
  const std::uint32_t open = open_brackets_.back().begin;
  // A brace that was closed by another kind of bracket is not waited for.
  while (!passed_over_.empty() && passed_over_.back().begin > open) passed_over_.pop_back();
  if (passed_over_.empty() || passed_over_.back().begin != open) return false;
  open_brackets_.pop_back();
  passed_over_.pop_back();
  first_on_line_ = false;
  return true;
}

/// Returns how many blanks the line of a token begins with, or none for a token far from there.
std::size_t Lexer::indentation(Span span) const {
  constexpr std::size_t far = 1000;
  const std::size_t place = span.begin - source_.base;
  const std::string_view before =
      std::string_view(source_.text).substr(0, place).substr(place - std::min(place, far));
  const std::size_t line_end = before.find_last_of("\r\n");
  if (line_end == std::string_view::npos && place > far) return 0;
  const std::string_view line = before.substr(line_end + 1);
  return std::min(line.find_first_not_of(" \t"), line.size());
}

Span Lexer::brace_to_blame() const {
  return shallower_close_.value_or(open_brackets_.back());
}

Grammar::symbol_type Lexer::closing(Token::token_kind_type kind, char opening_bracket) {
  // Brackets that were opened within this pair and never closed are forgotten with it. They are at
  // most a few, as the closing bracket may have no partner.
  const std::size_t size = open_brackets_.size();
  for (std::size_t i = size; i > size - std::min(size, max_forgotten_brackets); --i) {
    if (!open_values_.empty() && open_brackets_[i - 1].begin == open_values_.back()) break;
    if (text(open_brackets_[i - 1])[0] != opening_bracket) continue;
    const Span partner = open_brackets_[i - 1];
    if (opening_bracket == '{' && i > 1 && !shallower_close_ && first_on_line_) {
      const std::size_t blanks = indentation(token_span());
      const bool is_shallower =
          blanks < indentation(partner) && blanks <= indentation(open_brackets_[i - 2]);
      if (is_shallower) shallower_close_ = partner;
    }
    open_brackets_.resize(i - 1);
    break;
  }
  forget_closed_modifiers();
  return sign(kind);
}

Grammar::symbol_type Lexer::word() {
  const std::string_view name = token_text().substr(0, longest_name);
  if (name.size() < token_text().size())
    reporter_.error(token_span(), "names have at most 255 letters, digits and '_'");
  if (last_.kind == Grammar::symbol_kind::S_DOT) {
    first_on_line_ = false;
    return Grammar::make_IDENTIFIER(symbols_.intern(name), token_span());
  }
  const auto* keyword =
      std::find_if(keywords.begin(), keywords.end(),
                   [name](const Keyword& k) { return k.text == name; });
  // Before an arrow every word is the name of an attribute.
  const bool is_attribute = keyword != keywords.end() && arrow_follows();
  const bool is_keyword = keyword != keywords.end() && !is_attribute &&
                          (compat_ != compat_2015 || is_keyword_of_2015(keyword->kind));
  if (is_keyword) return sign(keyword->kind);
  if (const std::optional<Token::token_kind_type> kind = keyword_by_place(name)) return sign(*kind);
  first_on_line_ = false;
  const bool is_capital = name[0] >= 'A' && name[0] <= 'Z';
  if (!arrow_follows()) {
    if (std::optional<Grammar::symbol_type> meant = foreign_word(name, is_capital))
      return std::move(*meant);
  }
  if (!is_capital || is_attribute)
    return Grammar::make_IDENTIFIER(symbols_.intern(name), token_span());
  return Grammar::make_OBJECT_NAME(symbols_.intern(name), token_span());
}

Grammar::symbol_type Lexer::wrong_word() {
  const bool only_begins_wrong = std::all_of(token_, cursor_, is_word_byte);
  reporter_.error(token_span(),
                  only_begins_wrong
                      ? "names begin with a letter"
                      : "names consist of the letters a to z and A to Z, digits and '_'");
  first_on_line_ = false;
  return Grammar::make_IDENTIFIER(symbols_.intern(token_text().substr(0, longest_name)),
                                  token_span());
}

Grammar::symbol_type Lexer::single_quoted() {
  reporter_.error(token_span(), "strings stand in double quotes");
  first_on_line_ = false;
  return Grammar::make_STRING(std::string(), token_span());
}

void Lexer::skip_comment() {
  // A comment may hold anything, and need not be UTF-8.
  while (cursor_ < limit_ && *cursor_ != '\n' && *cursor_ != '\r') ++cursor_;
  if (tolerance_.comments) tolerance_.comments->push_back(token_span());
}

void Lexer::not_utf8() {
  reporter_.error(token_span(), "this byte is not UTF-8, the encoding of scripts");
}

void Lexer::unexpected_character() {
  std::size_t position = 0;
  const std::optional<char32_t> character = decode_utf8(token_text(), position);
  std::string message = "unexpected character " + describe_code_point(character.value_or(0));
  if (character == U';') message += "; nothing ends a statement here";
  if (character == U'\'') message += "; strings stand in double quotes";
  if (character == U'&') message += "; 'and' is '&&'";
  if (character == U'|') message += "; 'or' is '||'";
  reporter_.error(token_span(), message);
}

}  // namespace crt::lang
