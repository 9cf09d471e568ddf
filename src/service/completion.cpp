#include "service/completion.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <variant>

#include "lang/builtins.hpp"
#include "lang/objects.hpp"
#include "lang/settings.hpp"
#include "lang/word_byte.hpp"
#include "service/completion_items.hpp"
#include "service/material_kind.hpp"
#include "text/format.hpp"

namespace crt::service {

namespace {

using Kind = lang::Grammar::symbol_kind;

/// A CutText is the script up to the word that the cursor is in, with what the front end makes of
/// it.
struct CutText {
  lang::SourceMap sources;
  lang::SymbolTable symbols;
  const lang::Source* source = nullptr;
  lang::TokenList tokens;
  std::set<std::string, std::less<>> expected;

  CutText(std::string text, int compat, const std::filesystem::path& directory) {
    source = &sources.add("cut", std::move(text), directory);
    lang::Reporter unheard(sources, std::numeric_limits<std::size_t>::max());
    tokens = lang::read_tokens(*source, compat, symbols, unheard);
    for (std::string& name :
         lang::parse_partially(*source, lang::PartialEnd::cursor, compat, symbols, unheard)
             .expected)
      expected.insert(std::move(name));
  }

  bool expects(std::string_view name) const { return expected.contains(name); }
  std::uint32_t end() const { return static_cast<std::uint32_t>(source->text.size()); }
};

/// Says whether the text ends within a comment or a string, where nothing is completed.
bool ends_in_text(const CutText& cut) {
  const auto& [tokens, comments, open] = cut.tokens;
  if (!comments.empty() && comments.back().end == cut.end()) return true;
  if (tokens.empty() || tokens.back().span.end != cut.end()) return false;
  // Where a value in a string is open, an empty token ends the string.
  const bool is_empty = tokens.back().span.begin == cut.end();
  return !is_empty &&
         (tokens.back().kind == Kind::S_STRING || tokens.back().kind == Kind::S_STRING_END);
}

/// An OpenObject is the object whose braces the cursor is in.
struct OpenObject {
  const lang::ObjectType* type = nullptr;
  lang::Span name;
  bool is_derived = false;
};

/// Returns what a name stands for at the end of a text, or null.
const lang::DeclaredName* declared_as(const Program& before, std::string_view name,
                                      std::uint32_t end) {
  for (const lang::DeclaredName* declared : lang::names_at(before.names(), end)) {
    if (before.symbols().name(declared->symbol) == name) return declared;
  }
  return nullptr;
}

/// Returns the name that stands at a token of a text and is no part of another value, or nothing.
std::string_view name_at(const CutText& cut, std::size_t token) {
  const auto& tokens = cut.tokens.tokens;
  if (token >= tokens.size() || tokens[token].kind != Kind::S_IDENTIFIER) return {};
  if (token > 0 && tokens[token - 1].kind == Kind::S_DOT) return {};
  const lang::Span span = tokens[token].span;
  return std::string_view(cut.source->text).substr(span.begin, span.end - span.begin);
}

/// `before` is the program of the same text.
std::optional<OpenObject> open_object(const CutText& cut, const Program& before) {
  const auto& [tokens, comments, open] = cut.tokens;
  if (open.empty()) return std::nullopt;
  for (std::size_t i = 1; i < tokens.size(); ++i) {
    if (tokens[i].span != open.back()) continue;
    const auto& [kind, span] = tokens[i - 1];
    if (kind == Kind::S_SETTINGS) return OpenObject{&lang::settings_type(), span};
    const bool is_derived = kind == Kind::S_IDENTIFIER;
    if (kind != Kind::S_OBJECT_NAME && !is_derived) return std::nullopt;
    const std::string_view name =
        std::string_view(cut.source->text).substr(span.begin, span.end - span.begin);
    const lang::DeclaredName* base = is_derived ? declared_as(before, name, cut.end()) : nullptr;
    const lang::ObjectType* type = !is_derived           ? lang::find_object_type(name)
                                   : base && base->value ? material_type(before, *base->value)
                                                         : nullptr;
    return type ? std::optional(OpenObject{type, span, is_derived}) : std::nullopt;
  }
  return std::nullopt;
}

/// Collects the attributes that an object has in the whole text, but for the one at the cursor.
std::set<std::string_view> given_attributes(const Program& program, lang::Span name,
                                            std::uint32_t byte) {
  std::set<std::string_view> given;
  const auto add = [&](const std::vector<lang::AttributeSyntax>& attributes) {
    for (const lang::AttributeSyntax& attribute : attributes) {
      const bool at_cursor = attribute.name.span.begin <= byte && byte <= attribute.name.span.end;
      if (!at_cursor) given.insert(program.symbols().name(attribute.name.symbol));
    }
  };
  for (const lang::Expression& expression : program.script().expressions) {
    const auto* object = std::get_if<lang::ObjectLiteral>(&expression.node);
    if (object && object->name.span == name) add(object->attributes);
    const auto* derived = std::get_if<lang::DerivedMaterial>(&expression.node);
    if (derived && derived->base->span == name) add(derived->attributes);
  }
  for (const lang::Statement& statement : program.script().statements.statements) {
    const auto* settings = std::get_if<lang::SettingsBlock>(&statement.node);
    if (settings && settings->keyword == name) add(settings->attributes);
  }
  return given;
}

/// Says whether an arrow follows, so that none is to be put in.
bool arrow_follows(std::string_view text, std::uint32_t byte) {
  const std::size_t next = text.find_first_not_of(" \t", byte);
  return next != std::string_view::npos && text.substr(next).starts_with("->");
}

class Completer {
 public:
  Completer(const Program& program, const ScriptOptions& options, const Reference& reference,
            std::uint32_t byte)
      : program_(program), options_(options), items_(reference) {
    const std::string& text = program.main().text;
    list_.begin = list_.end = byte;
    while (list_.begin > 0 && lang::is_word_byte(text[list_.begin - 1])) --list_.begin;
    while (list_.end < text.size() && lang::is_word_byte(text[list_.end])) ++list_.end;
  }

  CompletionList complete() {
    const std::string& text = program_.main().text;
    const CutText cut(text.substr(0, list_.begin), program_.compat(), program_.main().directory);
    if (ends_in_text(cut)) return list_;
    // After a number's digits a letter begins nothing.
    if (list_.begin < list_.end && text[list_.begin] >= '0' && text[list_.begin] <= '9')
      return list_;
    const Program before(cut.source->text, program_.main().name, options_);
    if (after_dot(cut)) {
      add_members(cut, before);
      return std::move(list_);
    }
    const std::optional<OpenObject> object = open_object(cut, before);
    if (object && object->is_derived && after_brace(cut)) {
      add_attributes(*object);
      return std::move(list_);
    }
    const bool unsure = cut.expected.empty() || after_less(cut);
    const bool attribute_fits =
        cut.expects("a name") && cut.expects("}") && !cut.expects("a whole number");
    if (object && (attribute_fits || cut.expected.empty())) add_attributes(*object);
    const bool in_object = unsure && !list_.items.empty();
    if (cut.expects("a whole number")) add_parameters(cut, before);
    if (cut.expects("a whole number") || (unsure && !in_object)) add_expressions(before);
    for (const std::string& name : cut.expected) {
      if (!std::all_of(name.begin(), name.end(), lang::is_word_byte)) continue;
      list_.items.push_back(items_.keyword(name));
      // Behind a '<' these are modifiers, which are what is mostly wanted there.
      if (after_less(cut)) list_.items.back().rank = 0;
    }
    return std::move(list_);
  }

 private:
  /// Says whether the text ends in a '<', which may begin modifiers or compare.
  static bool after_less(const CutText& cut) {
    return !cut.tokens.tokens.empty() &&
           cut.source->text[cut.tokens.tokens.back().span.begin] == '<';
  }

  /// Says whether the text ends in the '.' before the name of a part.
  static bool after_dot(const CutText& cut) {
    return !cut.tokens.tokens.empty() && cut.tokens.tokens.back().kind == Kind::S_DOT;
  }

  /// Adds what a value before a '.' may have: the names of an import or of a dictionary, if it is
  /// known to be one, else the components of a Vec3 and a Color.
  void add_members(const CutText& cut, const Program& before) {
    const std::size_t dot = cut.tokens.tokens.size() - 1;
    const std::string_view name = dot > 0 ? name_at(cut, dot - 1) : std::string_view();
    const lang::DeclaredName* base = declared_as(before, name, cut.end());
    if (base && base->members > 0) {
      std::set<std::size_t> members;
      for (const auto& [symbol, declared] : before.names().scopes[base->members].names)
        members.insert(declared);
      for (const std::size_t member : members)
        list_.items.push_back(items_.name(before, before.names().declared[member], 0));
      return;
    }
    const auto* dictionary =
        base && base->value ? std::get_if<lang::DictionaryLiteral>(&base->value->node) : nullptr;
    if (dictionary) {
      for (const lang::AttributeSyntax& entry : dictionary->entries)
        list_.items.push_back(CompletionItems::part(before.symbols().name(entry.name.symbol)));
      return;
    }
    for (const char* part : {"x", "y", "z", "r", "g", "b", "a"})
      list_.items.push_back(CompletionItems::part(part));
  }

  /// Adds the parameters of the macro in whose call the cursor is, where an argument may begin.
  void add_parameters(const CutText& cut, const Program& before) {
    const auto& tokens = cut.tokens.tokens;
    const auto& open = cut.tokens.open_brackets;
    if (open.empty() || tokens.empty()) return;
    const auto bracket = std::find_if(tokens.begin(), tokens.end(), [&](const lang::Token& token) {
      return token.span == open.back() && token.kind == Kind::S_LEFT_PARENTHESIS;
    });
    const bool begins = tokens.back().kind == Kind::S_COMMA || bracket == std::prev(tokens.end());
    if (bracket == tokens.begin() || bracket == tokens.end() || !begins) return;
    const auto callee = static_cast<std::size_t>(bracket - tokens.begin()) - 1;
    const lang::DeclaredName* name = declared_as(before, name_at(cut, callee), cut.end());
    const auto* macro =
        name && name->value ? std::get_if<lang::MacroLiteral>(&name->value->node) : nullptr;
    if (!macro) return;
    const bool needs_arrow = !arrow_follows(program_.main().text, list_.end);
    for (const lang::NamePlace& parameter : macro->parameters.names)
      list_.items.push_back(
          CompletionItems::parameter(before.symbols().name(parameter.symbol), needs_arrow));
  }

  /// Says whether the text ends in a brace. That is where a derived material has no attribute yet,
  /// by which the front end would know it.
  static bool after_brace(const CutText& cut) {
    const auto& [tokens, comments, open] = cut.tokens;
    return !open.empty() && tokens.back().span == open.back();
  }

  void add_attributes(const OpenObject& object) {
    const std::set<std::string_view> given = given_attributes(program_, object.name, list_.begin);
    const bool needs_arrow = !arrow_follows(program_.main().text, list_.end);
    for (const lang::AttributeType& attribute : object.type->attributes) {
      if (!given.contains(attribute.name))
        list_.items.push_back(items_.attribute(*object.type, attribute, needs_arrow));
    }
  }

  void add_expressions(const Program& before) {
    std::set<std::string, std::less<>> seen;
    add_names(before, seen);
    for (const lang::Builtin& builtin : lang::builtins()) {
      if (seen.emplace(builtin.name).second) list_.items.push_back(items_.function(builtin));
    }
    for (const char* constant : {"pi", "t"}) {
      if (seen.emplace(constant).second) list_.items.push_back(items_.constant(constant));
    }
    for (const lang::ObjectType& type : lang::object_types())
      list_.items.push_back(items_.object(type));
  }

  /// Adds the names that are set before the cursor, then those that the macro around the cursor
  /// finds when it is called.
  void add_names(const Program& before, std::set<std::string, std::less<>>& seen) {
    add_names(before, static_cast<std::uint32_t>(before.main().text.size()), 0, seen);
    if (const std::optional<lang::Span> macro = macro_around(list_.begin))
      add_names(program_, macro->begin, 1, seen);
  }

  void add_names(const Program& program, std::uint32_t place, int rank,
                 std::set<std::string, std::less<>>& seen) {
    for (const lang::DeclaredName* name : lang::names_at(program.names(), place)) {
      if (seen.emplace(program.symbols().name(name->symbol)).second)
        list_.items.push_back(items_.name(program, *name, rank));
    }
  }

  /// Returns the body of the outermost macro around a place.
  std::optional<lang::Span> macro_around(std::uint32_t byte) const {
    const auto& scopes = program_.names().scopes;
    const auto around = std::find_if(scopes.begin() + 1, scopes.end(), [&](const auto& scope) {
      return scope.is_border && scope.extent.begin < byte && byte < scope.extent.end;
    });
    return around == scopes.end() ? std::nullopt : std::optional(around->extent);
  }

  const Program& program_;
  const ScriptOptions& options_;
  CompletionItems items_;
  CompletionList list_;
};

}  // namespace

CompletionList complete(const Program& program, std::uint32_t byte, const ScriptOptions& options,
                        const Reference& reference) {
  return Completer(program, options, reference, byte).complete();
}

}  // namespace crt::service
