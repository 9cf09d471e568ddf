#include "service/navigation.hpp"

#include <algorithm>
#include <crt/error.hpp>
#include <cstddef>
#include <map>
#include <utility>
#include <variant>

#include "lang/utf8.hpp"
#include "text/format.hpp"

namespace crt::service {

namespace {

using Kind = lang::Grammar::symbol_kind;

/// Says whether an editor can open a source: the text that it has, or a file.
bool can_be_opened(const Program& program, const lang::Source& source) {
  return &source == &program.main() || std::filesystem::path(source.name).is_absolute();
}

Place place_of(const Program& program, lang::Span span) {
  const lang::Source& source = program.sources().source_of(span);
  return {source.name, &source, span};
}

const lang::NameUse* declared_use_at(const Program& program, std::uint32_t byte) {
  const lang::NameUse* use = lang::use_at(program.names(), byte);
  return use && use->declared != lang::NameUse::nothing ? use : nullptr;
}

Error wrong(const std::string& message) {
  return Error(ErrorCode::invalid_argument, message);
}

/// Says whether a text is one name, as the lexer sees it.
bool is_name(const std::string& text, int compat) {
  lang::SourceMap sources;
  lang::SymbolTable symbols;
  lang::Reporter reporter(sources, 1);
  try {
    const lang::Source& source = sources.add("name", text);
    const lang::TokenList list = lang::read_tokens(source, compat, symbols, reporter);
    return list.comments.empty() && list.tokens.size() == 1 &&
           list.tokens[0].kind == Kind::S_IDENTIFIER &&
           list.tokens[0].span == lang::Span{0, static_cast<std::uint32_t>(text.size())};
  } catch (const lang::GiveUp&) {
    return false;
  }
}

/// Returns the texts of a program's sources with a new name at some places.
std::map<std::string, std::string> renamed_texts(const Program& program,
                                                 const std::vector<Place>& places,
                                                 const std::string& new_name) {
  std::map<std::string, std::string> texts;
  for (const lang::Source* source : program.all_sources()) texts[source->name] = source->text;
  for (auto place = places.rbegin(); place != places.rend(); ++place) {
    const lang::Source& source = *place->source;
    texts[source.name].replace(place->span.begin - source.base, place->span.end - place->span.begin,
                               new_name);
  }
  return texts;
}

/// Says whether the names of two programs mean the same, each at its place.
bool same_meanings(const lang::NameMap& a, const lang::NameMap& b) {
  return std::equal(
      a.uses.begin(), a.uses.end(), b.uses.begin(), b.uses.end(),
      [](const lang::NameUse& x, const lang::NameUse& y) { return x.declared == y.declared; });
}

}  // namespace

std::optional<Place> definition_at(const Program& program, std::uint32_t byte) {
  if (const lang::NameUse* use = declared_use_at(program, byte)) {
    const Place place = place_of(program, program.names().declared[use->declared].span);
    return can_be_opened(program, *place.source) ? std::optional(place) : std::nullopt;
  }
  for (const lang::Statement& statement : program.script().statements.statements) {
    const auto* import = std::get_if<lang::Import>(&statement.node);
    if (!import || byte < import->path_span.begin || byte > import->path_span.end) continue;
    const std::filesystem::path file = program.imported_file(*import);
    if (file.is_absolute()) return Place{file.string(), nullptr, {}};
  }
  return std::nullopt;
}

std::vector<Place> places_of(const Program& program, std::uint32_t byte) {
  std::vector<Place> places;
  const lang::NameUse* use = declared_use_at(program, byte);
  if (!use) return places;
  for (const lang::NameUse& other : program.names().uses) {
    if (other.declared != use->declared) continue;
    const Place place = place_of(program, other.span);
    if (can_be_opened(program, *place.source)) places.push_back(place);
  }
  return places;
}

std::optional<lang::Span> renamable_at(const Program& program, std::uint32_t byte) {
  const lang::NameUse* use = declared_use_at(program, byte);
  return use && definition_at(program, byte) ? std::optional(use->span) : std::nullopt;
}

std::vector<Place> rename_at(const Program& program, std::uint32_t byte,
                             const std::string& new_name, const ScriptOptions& options) {
  std::vector<Place> places = places_of(program, byte);
  if (places.empty()) throw wrong("there is no name here that a script sets");
  if (!definition_at(program, byte)) throw wrong("this name is set where it cannot be changed");
  // In what was not parsed there may be more of it.
  if (!program.is_whole())
    throw wrong("a name can be changed when the script has no syntax errors");
  const std::string shown = lang::abbreviated(new_name);
  if (!is_name(new_name, program.compat()))
    throw wrong(text::format("'{}' is no name: names begin with a small letter and are no keywords",
                             shown));
  const auto texts = renamed_texts(program, places, new_name);
  ScriptOptions renamed = options;
  renamed.open_file = [&](const std::filesystem::path& path) {
    std::optional<std::vector<std::byte>> content;
    if (const auto text = texts.find(path.string()); text != texts.end()) {
      const auto* begin = reinterpret_cast<const std::byte*>(text->second.data());
      content.emplace(begin, begin + text->second.size());
    } else if (options.open_file) {
      content = options.open_file(path);
    }
    return content;
  };
  const Program after(texts.at(program.main().name), program.main().name, renamed);
  if (!same_meanings(program.names(), after.names()))
    throw wrong(text::format("'{}' already means something where this name is used", shown));
  return places;
}

}  // namespace crt::service
