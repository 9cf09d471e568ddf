#include "service/program.hpp"

#include <algorithm>
#include <limits>
#include <system_error>
#include <utility>
#include <variant>

#include "lang/compat.hpp"
#include "lang/library.hpp"

namespace crt::service {

namespace {

/// Imports within imports are followed so far.
constexpr std::size_t max_imports = 1000;
constexpr std::size_t all_errors = std::numeric_limits<std::size_t>::max();

std::filesystem::path canonical_or_given(const std::filesystem::path& path) {
  std::error_code failed;
  const std::filesystem::path canonical = std::filesystem::canonical(path, failed);
  return failed ? path.lexically_normal() : canonical;
}

}  // namespace

TextSpan span_in(const lang::Source& source, lang::Span span) {
  const auto size = static_cast<std::uint32_t>(source.text.size());
  return {std::min(span.begin - source.base, size), std::min(span.end - source.base, size)};
}

int compat_of(const lang::SourceMap& sources, const lang::Source& source,
              const ScriptOptions& options) {
  if (options.compat != 0) return options.compat;
  return lang::written_compat(sources, source) == compat_2015 ? compat_2015 : 0;
}

Program::Program(const std::string& text, const std::string& name, const ScriptOptions& options)
    : options_(options), files_(options_) {
  const std::filesystem::path directory = std::filesystem::path(name).parent_path();
  files_.set_script_directory(directory);
  main_ = &sources_.add(name, text, directory);
  compat_ = compat_of(sources_, *main_, options_);
  paths_ = {canonical_or_given(name), name};
  is_main_clean_ = parse(*main_);
  lang::Reporter unheard(sources_, all_errors);
  tokens_ = lang::read_tokens(*main_, compat_, symbols_, unheard);
  names_ = lang::map_names(scripts_.front(),
                           [this](const lang::Import& import) { return import_script(import); });
}

bool Program::parse(const lang::Source& source) {
  // What is wrong is reported when the script is checked.
  lang::Reporter unheard(sources_, all_errors);
  all_sources_.push_back(&source);
  scripts_.push_back(
      lang::parse_partially(source, lang::PartialEnd::text, compat_, symbols_, unheard).script);
  is_whole_ = is_whole_ && !unheard.has_errors();
  return unheard.diagnostics().empty();
}

/// Parses an imported script when it is met first. A script is run only once, so later it is none.
const lang::Script* Program::import_script(const lang::Import& import) {
  if (scripts_.size() >= max_imports) return nullptr;
  try {
    const lang::Span span = import.path_span;
    if (lang::is_library_path(import.path)) return import_library(import);
    lang::Files::Found found = files_.find(import.path, sources_.source_of(span).directory, span);
    const std::filesystem::path shown = found.shown;
    const bool is_new = paths_.insert(canonical_or_given(found.path)).second;
    paths_.insert(shown);
    if (!is_new) return nullptr;
    const std::size_t left =
        options_.limits.source_bytes - std::min(options_.limits.source_bytes, sources_.size());
    std::string text = files_.read_text(std::move(found), left, span);
    parse(sources_.add(shown.string(), std::move(text), shown.parent_path()));
    return &scripts_.back();
  } catch (const lang::Failure&) {
    return nullptr;
  }
}

const lang::Script* Program::import_library(const lang::Import& import) {
  const std::string_view text = lang::find_library(import.path, import.path_span);
  if (!paths_.insert(import.path).second) return nullptr;
  parse(sources_.add(import.path, std::string(text)));
  return &scripts_.back();
}

std::string_view Program::text_of(lang::Span span) const {
  const lang::Source& source = sources_.source_of(span);
  const std::size_t begin = std::min<std::size_t>(span.begin - source.base, source.text.size());
  return std::string_view(source.text).substr(begin, span.end - span.begin);
}

const lang::DeclaredName* Program::declared_at(lang::Span name) const {
  const lang::NameUse* use = lang::use_at(names_, name.begin);
  if (!use || use->span != name || use->declared == lang::NameUse::nothing) return nullptr;
  return &names_.declared[use->declared];
}

const lang::Token* Program::token_at(std::uint32_t offset) const {
  const auto behind =
      std::upper_bound(tokens_.tokens.begin(), tokens_.tokens.end(), offset,
                       [](std::uint32_t o, const lang::Token& t) { return o < t.span.begin; });
  if (behind == tokens_.tokens.begin()) return nullptr;
  const lang::Token& token = *std::prev(behind);
  const bool begins_at_end = offset == token.span.begin && behind - tokens_.tokens.begin() > 1;
  // Between a name and a sign that touch, the name is meant.
  if (begins_at_end && token.kind != lang::Grammar::symbol_kind::S_IDENTIFIER) {
    const lang::Token& before = *std::prev(behind, 2);
    if (before.span.end == offset && before.kind == lang::Grammar::symbol_kind::S_IDENTIFIER)
      return &before;
  }
  return offset <= token.span.end ? &token : nullptr;
}

std::filesystem::path Program::imported_file(const lang::Import& import) const {
  try {
    return files_.find(import.path, main_->directory, import.path_span).shown;
  } catch (const lang::Failure&) {
    return {};
  }
}

}  // namespace crt::service
