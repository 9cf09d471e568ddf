#include "lang/compat.hpp"

#include <string_view>

#include "lang/lexer.hpp"
#include "lang/reporter.hpp"

namespace crt::lang {

namespace {

constexpr std::string_view compat_attribute = "compat";

/// Reads the tokens of a script up to its Settings' `compat -> 2015`.
class CompatSearch {
 public:
  CompatSearch(const SourceMap& sources, const Source& source)
      : reporter_(sources, 1), lexer_(source, TextKind::script, 0, symbols_, reporter_) {}

  std::int64_t number() {
    next();
    while (kind_ != Kind::S_YYEOF) {
      if (kind_ != Kind::S_SETTINGS) {
        next();
      } else if (next(); kind_ == Kind::S_LEFT_BRACE) {
        if (next(); is_in_block()) return number_;
      }
    }
    return 0;
  }

 private:
  using Kind = Grammar::symbol_kind;

  void next() {
    const Grammar::symbol_type token = lexer_.next();
    kind_ = token.kind();
    if (kind_ == Kind::S_IDENTIFIER)
      is_attribute_ = symbols_.name(token.value.as<Symbol>()) == compat_attribute;
    if (kind_ == Kind::S_INTEGER) number_ = token.value.as<std::int64_t>();
  }

  /// Called behind the opening brace of a block, it says whether the attribute is in the block, and
  /// not in braces inside it.
  bool is_in_block() {
    for (int depth = 1; depth > 0 && kind_ != Kind::S_YYEOF;) {
      if (depth == 1 && kind_ == Kind::S_IDENTIFIER && is_attribute_) {
        if (next(); kind_ != Kind::S_ARROW) continue;
        if (next(); kind_ == Kind::S_INTEGER) return true;
        continue;
      }
      if (kind_ == Kind::S_LEFT_BRACE || kind_ == Kind::S_DERIVING_BRACE) ++depth;
      if (kind_ == Kind::S_RIGHT_BRACE) --depth;
      next();
    }
    return false;
  }

  SymbolTable symbols_;
  Reporter reporter_;
  Lexer lexer_;
  int kind_ = Kind::S_START_SCRIPT;
  bool is_attribute_ = false;  ///< the last name
  std::int64_t number_ = 0;    ///< the last whole number
};

}  // namespace

std::int64_t written_compat(const SourceMap& sources, const Source& source) {
  // Most scripts do not have the attribute.
  if (source.text.find(compat_attribute) == std::string::npos) return 0;
  try {
    return CompatSearch(sources, source).number();
  } catch (const GiveUp&) {
    return 0;  // the parser will report what is wrong with the text
  }
}

}  // namespace crt::lang
