#include "lang/parser.hpp"

#include "lang/grammar.hpp"
#include "lang/lexer.hpp"
#include "lang/tree_builder.hpp"

namespace crt::lang {

Script parse(const Source& source, TextKind kind, int compat, SymbolTable& symbols,
             Reporter& reporter, std::size_t& memory_left) {
  Lexer lexer(source, kind, compat, symbols, reporter);
  TreeBuilder tree(lexer, reporter, memory_left);
  tree.charge_source(source.text.size());
  Grammar(lexer, tree).parse();
  return tree.take();
}

}  // namespace crt::lang
