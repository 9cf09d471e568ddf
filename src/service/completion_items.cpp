#include "service/completion_items.hpp"

#include <variant>

#include "lang/utf8.hpp"
#include "text/format.hpp"

namespace crt::service {

namespace {

/// These order the list: what must be there, names, functions, objects, keywords.
enum Rank {
  needed = 0,
  near_name = 1,
  optional_attribute = 3,
  function_rank = 4,
  object_rank = 5,
  keyword_rank = 6
};

/// A longer value is cut off where a name is shown.
constexpr std::size_t longest_value = 60;

Completion plain(CompletionKind kind, std::string label, int rank) {
  Completion item;
  item.kind = kind;
  item.text = label;
  item.label = std::move(label);
  item.rank = rank;
  return item;
}

}  // namespace

std::string attribute_signature(const lang::AttributeType& attribute) {
  return text::format(
      "{}, {}", attribute.type,
      attribute.required ? "required" : text::format("default {}", attribute.default_text));
}

Completion CompletionItems::attribute(const lang::ObjectType& type,
                                      const lang::AttributeType& attribute,
                                      bool needs_arrow) const {
  Completion item = plain(CompletionKind::attribute, std::string(attribute.name),
                          attribute.required ? needed : optional_attribute);
  item.detail = attribute_signature(attribute);
  item.documentation = reference_.attribute(type.name, attribute.name);
  if (needs_arrow) item.text += " -> ";
  return item;
}

Completion CompletionItems::object(const lang::ObjectType& type) const {
  Completion item = plain(CompletionKind::object, std::string(type.name), object_rank);
  item.documentation = reference_.object(type.name);
  item.snippet = item.label + " {";
  int place = 1;
  for (const lang::AttributeType& attribute : type.attributes) {
    if (!attribute.required) continue;
    if (!item.detail.empty()) item.detail += ", ";
    item.detail += attribute.name;
    item.snippet += text::format(" {} -> ${}", attribute.name, place++);
  }
  if (place == 1) item.snippet += " $1";
  item.snippet += " }$0";
  return item;
}

Completion CompletionItems::function(const lang::Builtin& builtin) const {
  Completion item = plain(CompletionKind::function, std::string(builtin.name), function_rank);
  item.detail = builtin.signature;
  item.documentation = reference_.word(builtin.name);
  return item;
}

Completion CompletionItems::constant(const std::string& name) const {
  Completion item = plain(CompletionKind::constant, name, function_rank);
  item.detail = "constant";
  item.documentation = reference_.word(name);
  return item;
}

Completion CompletionItems::keyword(const std::string& name) const {
  Completion item = plain(CompletionKind::keyword, name, keyword_rank);
  item.documentation = reference_.word(name);
  return item;
}

Completion CompletionItems::part(std::string_view name) {
  return plain(CompletionKind::attribute, std::string(name), needed);
}

Completion CompletionItems::parameter(std::string_view name, bool needs_arrow) {
  Completion item = part(name);
  item.detail = "parameter";
  if (needs_arrow) item.text += " -> ";
  return item;
}

Completion CompletionItems::name(const Program& program, const lang::DeclaredName& name,
                                 int rank) const {
  const bool is_macro = name.kind == lang::NameKind::macro;
  Completion item = plain(is_macro ? CompletionKind::macro : CompletionKind::variable,
                          std::string(program.symbols().name(name.symbol)), near_name + rank);
  item.detail = signature_of(program, name);
  return item;
}

std::string signature_of(const Program& program, const lang::DeclaredName& name) {
  const std::string_view text = program.symbols().name(name.symbol);
  if (name.kind == lang::NameKind::parameter) return text::format("parameter {}", text);
  if (name.kind == lang::NameKind::loop_variable) return text::format("for ({} in ...)", text);
  if (!name.value) return std::string(text);
  if (const auto* macro = std::get_if<lang::MacroLiteral>(&name.value->node)) {
    std::string parameters;
    for (std::size_t i = 0; i < macro->parameters.names.size(); ++i) {
      if (i > 0) parameters += ", ";
      parameters += program.symbols().name(macro->parameters.names[i].symbol);
      if (const lang::Expression* value = macro->parameters.defaults[i])
        parameters += text::format(" -> {}", lang::abbreviated(program.text_of(value->span)));
    }
    return text::format("{}({})", text, parameters);
  }
  std::string_view value = program.text_of(name.value->span);
  value = value.substr(0, value.find_first_of("\r\n"));
  if (value.size() == name.value->span.end - name.value->span.begin && value.size() < longest_value)
    return text::format("{} = {}", text, lang::printable(value));
  if (const auto* object = std::get_if<lang::ObjectLiteral>(&name.value->node))
    return text::format("{} = {} {{ ... }}", text, program.symbols().name(object->name.symbol));
  if (const auto* derived = std::get_if<lang::DerivedMaterial>(&name.value->node))
    return text::format("{} = {} {{ ... }}", text, program.text_of(derived->base->span));
  return text::format("{} = ...", text);
}

}  // namespace crt::service
