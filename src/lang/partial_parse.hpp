// This parses texts that are still being written, for editors, and lists the tokens of a text.
#pragma once

#include <string>
#include <vector>

#include "lang/grammar.hpp"
#include "lang/reporter.hpp"
#include "lang/source_map.hpp"
#include "lang/symbol.hpp"
#include "lang/syntax.hpp"

namespace crt::lang {

/// A Token is a piece of a text with what it is.
struct Token {
  Grammar::symbol_kind_type kind = Grammar::symbol_kind::S_YYEMPTY;
  Span span{};
};

/// TokenList has all of a text but its blanks. A place in it is in a token, a comment or neither.
struct TokenList {
  std::vector<Token> tokens{};
  std::vector<Span> comments{};
  /// Lists the brackets that are open at the end, outermost first.
  std::vector<Span> open_brackets{};
};

/// Reads the tokens of a text. Bytes that begin none go to the reporter. Throws GiveUp when that
/// has enough.
TokenList read_tokens(const Source& source, int compat, SymbolTable& symbols, Reporter& reporter);

/// A PartialScript is what the parser made of a text that need not be whole.
struct PartialScript {
  /// Statements with syntax errors are left out, and brackets at the end closed.
  Script script;
  /// Names what the grammar takes at the end, by the names of its tokens. It is empty if that was
  /// not asked for, or the parser cannot say because of an error just before.
  std::vector<std::string> expected;
};

enum class PartialEnd {
  text,    ///< the text ends where it ends
  cursor,  ///< it goes on, and what may come is asked
};

/// Parses as much of a text as there is. Errors go to the reporter, and the tree may be used all
/// the same, but not run. A text beyond the limits gives an empty tree.
PartialScript parse_partially(const Source& source, PartialEnd end, int compat,
                              SymbolTable& symbols, Reporter& reporter);

}  // namespace crt::lang
