#include "lang/compat.hpp"

#include <string>
#include <string_view>
#include <utility>

#include "crt/schema_settings.hpp"
#include "lang/lexer.hpp"
#include "lang/reporter.hpp"

namespace crt::lang {

namespace {

constexpr std::string_view compat_attribute = "compat";
constexpr std::string_view unit_attribute = "unit";

/// Reads the tokens of a script up to an attribute of its Settings, such as `compat -> 2015`.
class SettingSearch {
 public:
  SettingSearch(const SourceMap& sources, const Source& source, std::string_view attribute)
      : attribute_(attribute),
        reporter_(sources, 1),
        lexer_(source, TextKind::script, 0, symbols_, reporter_) {}

  /// Finds the attribute's value, the first token of which is read then.
  bool find() {
    next();
    while (kind_ != Kind::S_YYEOF) {
      if (kind_ != Kind::S_SETTINGS) {
        next();
      } else if (next(); kind_ == Kind::S_LEFT_BRACE) {
        if (next(); is_in_block()) return true;
      }
    }
    return false;
  }
  std::int64_t number() const { return kind_ == Kind::S_INTEGER ? number_ : 0; }
  /// Returns a text that is all of the value: what follows would be a sign otherwise.
  std::optional<std::string> whole_text() {
    if (kind_ != Kind::S_STRING) return {};
    std::string text = text_;
    next();
    const bool ends = kind_ == Kind::S_RIGHT_BRACE || kind_ == Kind::S_IDENTIFIER;
    return ends ? std::optional(std::move(text)) : std::nullopt;
  }

 private:
  using Kind = Grammar::symbol_kind;

  void next() {
    const Grammar::symbol_type token = lexer_.next();
    kind_ = token.kind();
    if (kind_ == Kind::S_IDENTIFIER)
      is_attribute_ = symbols_.name(token.value.as<Symbol>()) == attribute_;
    if (kind_ == Kind::S_INTEGER) number_ = token.value.as<std::int64_t>();
    if (kind_ == Kind::S_STRING) text_ = token.value.as<std::string>();
  }

  /// Called behind the opening brace of a block, it says whether the attribute is in the block, and
  /// not in braces inside it.
  bool is_in_block() {
    for (int depth = 1; depth > 0 && kind_ != Kind::S_YYEOF;) {
      if (depth == 1 && kind_ == Kind::S_IDENTIFIER && is_attribute_) {
        if (next(); kind_ != Kind::S_ARROW) continue;
        next();
        return true;
      }
      if (kind_ == Kind::S_LEFT_BRACE || kind_ == Kind::S_DERIVING_BRACE) ++depth;
      if (kind_ == Kind::S_RIGHT_BRACE) --depth;
      next();
    }
    return false;
  }

  std::string_view attribute_;
  SymbolTable symbols_;
  Reporter reporter_;
  Lexer lexer_;
  int kind_ = Kind::S_START_SCRIPT;
  bool is_attribute_ = false;  ///< the last name
  std::int64_t number_ = 0;    ///< the last whole number
  std::string text_;           ///< the last string
};

}  // namespace

std::int64_t written_compat(const SourceMap& sources, const Source& source) {
  // Most scripts do not have the attribute.
  if (source.text.find(compat_attribute) == std::string::npos) return 0;
  try {
    SettingSearch search(sources, source, compat_attribute);
    return search.find() ? search.number() : 0;
  } catch (const GiveUp&) {
    return 0;  // the parser will report what is wrong with the text
  }
}

std::optional<Unit> unit_of_name(std::string_view name) {
  for (const Unit unit : {Unit::m, Unit::cm, Unit::mm, Unit::in})
    if (schema::script_name_of(unit) == name) return unit;
  return {};
}

std::optional<Unit> written_unit(const SourceMap& sources, const Source& source) {
  if (source.text.find(unit_attribute) == std::string::npos) return Settings{}.unit;
  try {
    SettingSearch search(sources, source, unit_attribute);
    if (!search.find()) return Settings{}.unit;
    const std::optional<std::string> name = search.whole_text();
    return name ? unit_of_name(*name) : std::nullopt;
  } catch (const GiveUp&) {
    return {};
  }
}

}  // namespace crt::lang
