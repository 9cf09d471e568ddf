#include <algorithm>
#include <crt/error.hpp>
#include <crt/language_service.hpp>
#include <mutex>
#include <set>
#include <utility>

#include "format/format.hpp"
#include "lang/objects.hpp"
#include "lang/settings.hpp"
#include "lang/utf8.hpp"
#include "service/checker.hpp"
#include "service/completion.hpp"
#include "service/hover.hpp"
#include "service/navigation.hpp"
#include "service/program.hpp"
#include "service/reference.hpp"
#include "service/script_tree.hpp"
#include "service/tokens.hpp"

namespace crt {

using service::span_in;

namespace {

/// Returns the pieces of the reference, which are found once.
const service::Reference& reference() {
  static const service::Reference reference(service::reference_text());
  return reference;
}

ScriptLocation location_of(const service::Place& place) {
  return {place.file, place.source ? span_in(*place.source, place.span) : TextSpan{}};
}

/// A Renaming collects places, each once, that several programs know.
struct Renaming {
  std::vector<ScriptLocation> locations;
  std::set<std::pair<std::string, std::uint32_t>> known;

  void add(const std::vector<service::Place>& places) {
    for (const service::Place& place : places) {
      ScriptLocation location = location_of(place);
      if (known.emplace(location.file, location.span.begin).second)
        locations.push_back(std::move(location));
    }
  }
};

SymbolKind kind_of(lang::NameKind kind) {
  switch (kind) {
    case lang::NameKind::macro:
      return SymbolKind::macro;
    case lang::NameKind::parameter:
      return SymbolKind::parameter;
    case lang::NameKind::loop_variable:
      return SymbolKind::loop_variable;
    default:
      return SymbolKind::variable;
  }
}

ScriptOptions with_low_limits(ScriptOptions options) {
  service::lower_limits(options.limits);
  return options;
}

ObjectDescription describe(const lang::ObjectType& type) {
  ObjectDescription object{.name = std::string(type.name), .attributes = {}};
  for (const lang::AttributeType& attribute : type.attributes) {
    object.attributes.push_back({.name = std::string(attribute.name),
                                 .type = std::string(attribute.type),
                                 .required = attribute.required,
                                 .default_text = std::string(attribute.default_text),
                                 .documentation = reference().attribute(type.name, attribute.name),
                                 .choices = {}});
    for (const schema::Name& word : attribute.choices)
      object.attributes.back().choices.emplace_back(word.text());
  }
  return object;
}

}  // namespace

std::vector<ObjectDescription> describe_objects() {
  std::vector<ObjectDescription> objects;
  for (const lang::ObjectType& type : lang::object_types()) objects.push_back(describe(type));
  objects.push_back(describe(lang::settings_type()));
  return objects;
}

FormattedScript format_script(std::string_view text, const std::string& name) {
  format::Formatted formatted = format::format_script(text, name);
  return {std::move(formatted.text), std::move(formatted.diagnostics)};
}

struct LanguageService::State {
  State(const std::string& text, const std::string& name, const ScriptOptions& low)
      : options(low), program(text, name, low) {}

  ScriptOptions options;
  service::Program program;
  std::once_flag checked;
  std::vector<Diagnostic> diagnostics;

  /// Bytes behind the end are the end.
  std::uint32_t byte(std::uint32_t place) const {
    const lang::Source& main = program.main();
    return main.base + std::min(place, static_cast<std::uint32_t>(main.text.size()));
  }
};

LanguageService::LanguageService(const std::string& text, const std::string& name,
                                 const ScriptOptions& options) {
  state_ = std::make_unique<State>(text, name, with_low_limits(options));
}

LanguageService::~LanguageService() = default;
LanguageService::LanguageService(LanguageService&&) noexcept = default;

std::vector<ScriptFile> LanguageService::files() const {
  std::vector<ScriptFile> files;
  for (const lang::Source* source : state_->program.all_sources())
    files.push_back({source->name, source->text});
  return files;
}

bool LanguageService::has_file(const std::filesystem::path& path) const {
  return state_->program.has_file(path);
}

std::vector<ScriptToken> LanguageService::tokens() const {
  return service::tokens_of(state_->program);
}

std::vector<ScriptNode> LanguageService::tree() const {
  return service::tree_of(state_->program);
}

std::vector<ScriptSymbol> LanguageService::symbols() const {
  const service::Program& program = state_->program;
  const lang::Source& main = program.main();
  const auto is_in_main = [&](lang::Span span) {
    return span.begin >= main.base && span.end <= main.base + main.text.size();
  };
  const std::vector<lang::DeclaredName>& declared = program.names().declared;
  std::vector<ScriptSymbol> symbols(declared.size());
  for (std::size_t i = 0; i < declared.size(); ++i) {
    if (!is_in_main(declared[i].span)) continue;
    symbols[i] = {.name = std::string(program.symbols().name(declared[i].symbol)),
                  .kind = kind_of(declared[i].kind),
                  .definition = span_in(main, declared[i].span),
                  .uses = {}};
  }
  for (const lang::NameUse& use : program.names().uses) {
    if (use.declared == lang::NameUse::nothing || !is_in_main(use.span)) continue;
    symbols[use.declared].uses.push_back(span_in(main, use.span));
  }
  std::erase_if(symbols, [](const ScriptSymbol& symbol) { return symbol.name.empty(); });
  std::stable_sort(symbols.begin(), symbols.end(), [](const auto& a, const auto& b) {
    return a.definition.begin < b.definition.begin;
  });
  return symbols;
}

std::optional<ScriptLocation> LanguageService::definition(std::uint32_t byte) const {
  const auto place = service::definition_at(state_->program, state_->byte(byte));
  return place ? std::optional(location_of(*place)) : std::nullopt;
}

std::vector<ScriptLocation> LanguageService::places(std::uint32_t byte) const {
  std::vector<ScriptLocation> locations;
  for (const service::Place& place : service::places_of(state_->program, state_->byte(byte)))
    locations.push_back(location_of(place));
  return locations;
}

std::optional<TextSpan> LanguageService::renamable_name(std::uint32_t byte) const {
  const auto span = service::renamable_at(state_->program, state_->byte(byte));
  return span ? std::optional(span_in(state_->program.main(), *span)) : std::nullopt;
}

std::vector<ScriptLocation> LanguageService::rename(
    std::uint32_t byte, const std::string& new_name,
    const std::vector<const LanguageService*>& others) const {
  const service::Program& program = state_->program;
  byte = state_->byte(byte);
  Renaming renaming;
  renaming.add(service::rename_at(program, byte, new_name, state_->options));
  const service::Place first = *service::definition_at(program, byte);
  for (const LanguageService* other : others) {
    if (other == this) continue;
    for (const lang::Source* source : other->state_->program.all_sources()) {
      if (source->name != first.file) continue;
      if (source->text != first.source->text)
        throw Error(ErrorCode::invalid_argument,
                    "an open script knows another text of '" + lang::printable(first.file) + "'");
      renaming.add(service::rename_at(other->state_->program,
                                      first.span.begin - first.source->base + source->base,
                                      new_name, other->state_->options));
    }
  }
  return std::move(renaming.locations);
}

CompletionList LanguageService::complete(std::uint32_t byte) const {
  return service::complete(state_->program, state_->byte(byte), state_->options, reference());
}

std::optional<ScriptHover> LanguageService::hover(std::uint32_t byte) const {
  const auto hover = service::hover_at(state_->program, state_->byte(byte), reference());
  if (!hover) return std::nullopt;
  return ScriptHover{hover->markdown, span_in(state_->program.main(), hover->span)};
}

std::vector<Diagnostic> LanguageService::diagnostics() const {
  std::call_once(state_->checked, [this] {
    state_->diagnostics = service::check_script(state_->program, state_->options);
  });
  return state_->diagnostics;
}

}  // namespace crt
