// The lexer turns text into tokens.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "crt/settings.hpp"
#include "lang/grammar.hpp"
#include "lang/reporter.hpp"
#include "lang/source_map.hpp"
#include "lang/symbol.hpp"
#include "lang/tolerance.hpp"

namespace crt::lang {

/// A Lexer hands out the tokens of a source, one a call. Bytes that begin no token are reported and
/// skipped, so the parser never sees them.
class Lexer {
 public:
  /// `compat` is that of ScriptOptions. In scripts of 2015 the words that have become keywords
  /// since are names wherever they cannot be keywords.
  Lexer(const Source& source, TextKind kind, int compat, SymbolTable& symbols, Reporter& reporter);

  Grammar::symbol_type next();

  /// Takes the text for one that is still being written, see tolerance.hpp.
  void tolerate(const Tolerance& tolerance) { tolerance_ = tolerance; }

  /// Returns the text of a piece of this source.
  std::string_view text(Span span) const;

  int compat() const { return compat_; }

  Symbol intern(std::string_view name) const { return symbols_.intern(name); }

  /// Returns the place before everything.
  Span start() const { return {source_.base, source_.base}; }

  /// Returns where the line ends that the span begins on.
  std::uint32_t line_end(Span span) const;

  /// Returns the token before the last one that was handed out.
  Span before_last() const { return before_last_.span; }

  /// Returns the first word of the line that the span begins on.
  std::string_view first_word_of_line(Span span) const;

  /// Returns the word before `(...)`, if that stands before the span on its line.
  std::string_view word_before_brackets(Span span) const;

  /// Returns the word in `<word value>` if the token before the last one is that '>'.
  std::optional<Span> word_of_modifier() const;

  /// Returns the brackets that are open now, outermost first.
  const std::vector<Span>& open_brackets() const { return open_brackets_; }

  /// Returns the brace that most likely is the one that was not closed, if more are open than are
  /// closed: the first whose block ends as far left as the one around it, else the innermost.
  Span brace_to_blame() const;

  /// Takes the brace that was handed out last, which begins nothing, and the one that closes it for
  /// blanks. So one mistake gives one error.
  void pass_over_block() { passed_over_.push_back(last_.span); }

 private:
  using Byte = unsigned char;

  Span token_span() const { return {offset(token_), offset(cursor_)}; }
  std::uint32_t offset(const Byte* position) const;
  std::string_view token_text() const;

  Grammar::symbol_type scan();
  Grammar::symbol_type ending();
  Grammar::symbol_type sign(Grammar::token::token_kind_type kind);
  Grammar::symbol_type less();
  Grammar::symbol_type greater();
  Grammar::symbol_type opening(Grammar::token::token_kind_type kind);
  Grammar::symbol_type closing(Grammar::token::token_kind_type kind, char opening_bracket);
  bool closes_passed_over();
  std::size_t indentation(Span span) const;
  Grammar::symbol_type word();
  Grammar::symbol_type wrong_word();
  Grammar::symbol_type single_quoted();
  Grammar::symbol_type whole_number();
  Grammar::symbol_type decimal_number();
  Grammar::symbol_type string(Grammar::token::token_kind_type whole,
                              Grammar::token::token_kind_type up_to_value);
  Grammar::symbol_type string_token(Grammar::token::token_kind_type kind, std::string value);
  bool value_is_open();
  Grammar::symbol_type unclosed_value();
  bool closes_value();
  void escape(std::string& value);
  std::optional<std::uint32_t> hexadecimal_unit();
  void unicode_escape(std::string& value, const Byte* start);
  std::optional<Number> unit_after_number(double value);

  void unexpected_character();
  void not_utf8();

  // What other languages write: lexer_foreign.cpp.
  void foreign_comment();
  void foreign_block_comment();
  bool color_follows() const;
  Grammar::symbol_type foreign_color();
  std::optional<Grammar::symbol_type> foreign_word(std::string_view name, bool is_capital);
  std::optional<Grammar::symbol_type> small_letters_for(std::string_view name);
  bool refuse_increment();

  void skip_comment();
  /// Returns where the next token begins, past blanks, line ends and comments.
  const Byte* next_token_start() const;
  const Byte* next_on_line(const Byte* position) const;
  bool value_follows(const Byte* end, bool may_be_signed) const;
  bool modifier_follows() const;
  bool is_closed_on_line(const Byte* position) const;
  bool begins_modifier() const;
  void forget_closed_modifiers();
  bool may_begin_statement() const;
  bool arrow_follows() const;
  bool derivation_follows() const;
  bool member_follows() const;
  Grammar::token::token_kind_type kind_of_brace() const;
  std::string_view next_word() const;
  std::optional<Grammar::token::token_kind_type> keyword_by_place(std::string_view name) const;
  bool is_keyword_of_2015(Grammar::token::token_kind_type kind) const;

  struct Last {
    int kind = Grammar::symbol_kind::S_YYEMPTY;
    Span span;
  };

  const Source& source_;
  SymbolTable& symbols_;
  Reporter& reporter_;
  const Byte* cursor_;
  const Byte* limit_;
  const Byte* token_;
  Grammar::token::token_kind_type start_;
  int compat_;
  bool started_ = false;
  bool first_on_line_ = true;
  std::vector<Span> open_brackets_;
  std::vector<Span> passed_over_;  ///< braces that begin nothing
  /// Where the brackets begin that are open around values in strings. They are open brackets, too.
  std::vector<std::uint32_t> open_values_;
  std::optional<Span> shallower_close_;  ///< see brace_to_blame()
  Tolerance tolerance_;
  std::vector<std::size_t> open_modifiers_;  ///< counts the brackets around each open list
  std::set<Symbol> capital_variables_;       ///< those that were reported where they are set
  Last last_;
  Last before_last_;
  int for_tokens_ = 0;  ///< so many tokens of `for (name` came last
};

/// Says whether a word looks like a modifier of another language, such as rotateY.
bool is_foreign_modifier(std::string_view word);

}  // namespace crt::lang
