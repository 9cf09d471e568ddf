#include "service/hover.hpp"

#include <algorithm>
#include <string_view>
#include <variant>
#include <vector>

#include "lang/objects.hpp"
#include "lang/settings.hpp"
#include "lang/utf8.hpp"
#include "service/completion_items.hpp"
#include "service/material_kind.hpp"
#include "text/format.hpp"

namespace crt::service {

namespace {

std::string code(std::string_view text) {
  return text::format("```crt\n{}\n```", text);
}

void add(std::string& text, const std::string& paragraph) {
  if (paragraph.empty()) return;
  if (!text.empty()) text += "\n\n";
  text += paragraph;
}

std::string describe_object(const lang::ObjectType& type, const Reference& reference) {
  std::string text = code(text::format("{} {{ }}", type.name));
  add(text, reference.object(type.name));
  std::string list;
  for (const lang::AttributeType& attribute : type.attributes) {
    if (!list.empty()) list += '\n';
    list += text::format("- `{}`: {}", attribute.name, attribute_signature(attribute));
  }
  add(text, list);
  return text;
}

std::string describe_attribute(const lang::ObjectType& type, std::string_view name,
                               const Reference& reference) {
  const std::size_t index = lang::find_attribute(type, name);
  if (index == type.attributes.size()) return {};
  std::string text =
      code(text::format("{} -> {}", name, attribute_signature(type.attributes[index])));
  add(text, reference.attribute(type.name, name));
  return text;
}

/// Finds the attribute whose name is at an offset, and describes it.
class AttributeSearch {
 public:
  AttributeSearch(const Program& program, lang::Span span, const Reference& reference)
      : program_(program), span_(span), reference_(reference) {}

  std::string describe() const {
    for (const lang::Expression& expression : program_.script().expressions) {
      const lang::ObjectType* type = nullptr;
      if (const auto* object = std::get_if<lang::ObjectLiteral>(&expression.node)) {
        if (!has(object->attributes)) continue;
        type = lang::find_object_type(program_.symbols().name(object->name.symbol));
      } else if (const auto* derived = std::get_if<lang::DerivedMaterial>(&expression.node)) {
        if (!has(derived->attributes)) continue;
        type = material_type(program_, expression);
      } else {
        continue;
      }
      return type ? describe_attribute(*type, program_.text_of(span_), reference_) : std::string();
    }
    for (const lang::Statement& statement : program_.script().statements.statements) {
      const auto* settings = std::get_if<lang::SettingsBlock>(&statement.node);
      if (settings && has(settings->attributes))
        return describe_attribute(lang::settings_type(), program_.text_of(span_), reference_);
    }
    return {};
  }

 private:
  bool has(const std::vector<lang::AttributeSyntax>& attributes) const {
    return std::any_of(attributes.begin(), attributes.end(),
                       [&](const auto& attribute) { return attribute.name.span == span_; });
  }

  const Program& program_;
  lang::Span span_;
  const Reference& reference_;
};

/// Returns the comment lines that stand directly above a place, as text.
std::string comment_above(const lang::Source& source, lang::Span span) {
  const std::uint32_t begin = span.begin - source.base;
  const std::string_view before = std::string_view(source.text).substr(0, begin);
  // Only what is set at the beginning of a line has its comment above it.
  std::size_t line = before.rfind('\n');
  if (line == std::string_view::npos) return {};
  if (before.substr(line + 1).find_first_not_of(" \t") != std::string_view::npos) return {};
  std::string result;
  while (line != std::string_view::npos && line > 0) {
    const std::size_t above = before.rfind('\n', line - 1);
    const std::size_t first = above == std::string_view::npos ? 0 : above + 1;
    std::string_view text = before.substr(first, line - first);
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    if (!text.starts_with("--")) break;
    text.remove_prefix(std::min(text.find_first_not_of("- \t"), text.size()));
    if (!result.empty()) result.insert(0, 1, '\n');
    result.insert(0, lang::printable(text));
    line = above;
  }
  return result;
}

std::string describe_name(const Program& program, const lang::NameUse& use,
                          const Reference& reference) {
  if (use.declared == lang::NameUse::nothing)
    return reference.word(program.symbols().name(use.symbol));
  const lang::DeclaredName& name = program.names().declared[use.declared];
  std::string text = code(signature_of(program, name));
  add(text, comment_above(program.sources().source_of(name.span), name.span));
  return text;
}

}  // namespace

std::optional<Hover> hover_at(const Program& program, std::uint32_t byte,
                              const Reference& reference) {
  using Kind = lang::Grammar::symbol_kind;
  const lang::Token* token = program.token_at(byte);
  if (!token || token->kind == Kind::S_STRING) return std::nullopt;
  Hover hover{.markdown = {}, .span = token->span};
  const std::string_view text = program.text_of(token->span);
  if (token->kind == Kind::S_OBJECT_NAME) {
    if (const auto* type = lang::find_object_type(text))
      hover.markdown = describe_object(*type, reference);
  } else if (token->kind == Kind::S_SETTINGS) {
    hover.markdown = describe_object(lang::settings_type(), reference);
  } else if (token->kind == Kind::S_IDENTIFIER) {
    const lang::NameUse* use = lang::use_at(program.names(), token->span.begin);
    hover.markdown = use && use->span == token->span
                         ? describe_name(program, *use, reference)
                         : AttributeSearch(program, token->span, reference).describe();
  } else {
    hover.markdown = reference.word(text);
  }
  if (hover.markdown.empty()) return std::nullopt;
  return hover;
}

}  // namespace crt::service
