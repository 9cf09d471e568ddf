#include "lang/partial_parse.hpp"

#include <limits>

#include "lang/lexer.hpp"
#include "lang/tree_builder.hpp"

namespace crt::lang {

TokenList read_tokens(const Source& source, int compat, SymbolTable& symbols, Reporter& reporter) {
  TokenList list;
  Lexer lexer(source, TextKind::script, compat, symbols, reporter);
  lexer.tolerate({.comments = &list.comments});
  lexer.next();  // says what the text is, and is not in the text
  for (;;) {
    const Grammar::symbol_type token = lexer.next();
    if (token.kind() == Grammar::symbol_kind::S_YYEOF) break;
    list.tokens.push_back({token.kind(), token.location});
  }
  list.open_brackets = lexer.open_brackets();
  return list;
}

PartialScript parse_partially(const Source& source, PartialEnd end, int compat,
                              SymbolTable& symbols, Reporter& reporter) {
  // The caller bounds the text, and with it the tree.
  std::size_t memory_left = std::numeric_limits<std::size_t>::max();
  Lexer lexer(source, TextKind::script, compat, symbols, reporter);
  lexer.tolerate({.ends_at_cursor = end == PartialEnd::cursor, .closes_brackets = true});
  TreeBuilder tree(lexer, reporter, memory_left);
  PartialScript result;
  try {
    Grammar(lexer, tree).parse();
  } catch (const GiveUp&) {
    // It was reported. What is in the tree has no owner.
    return result;
  }
  result.expected = tree.take_expected();
  result.script = tree.take();
  return result;
}

}  // namespace crt::lang
