#include "lsp/workspace.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "lsp/uri.hpp"

namespace crt::lsp {

namespace {

bool same(const Diagnostic& a, const Diagnostic& b) {
  return a.severity == b.severity && a.message == b.message && a.place == b.place;
}

void set_text(Document& document, std::string text) {
  document.text = std::move(text);
  document.places = TextPlaces(document.text);
}

/// Has a document looked at again.
void forget(Document& document) {
  document.service.reset();
  document.is_to_check = true;
}

}  // namespace

Range range_of(const TextPlaces& places, TextSpan span, ColumnUnit unit) {
  return {places.position_of(span.begin, unit), places.position_of(span.end, unit)};
}

void Workspace::open(const std::string& uri, std::int64_t version, std::string text) {
  Document& document = documents_[uri];
  document.uri = uri;
  document.path = path_of(uri);
  document.name = document.path.empty() ? uri : document.path.string();
  document.version = version;
  set_text(document, std::move(text));
  forget(document);
  invalidate(document.path);
}

void Workspace::change(Document& document, std::int64_t version,
                       const std::vector<Change>& changes) {
  for (const Change& change : changes) {
    if (!change.range) {
      set_text(document, change.text);
      continue;
    }
    const std::uint32_t begin = document.places.byte_at(change.range->start, unit_);
    const std::uint32_t end = std::max(begin, document.places.byte_at(change.range->end, unit_));
    set_text(document, document.text.replace(begin, end - begin, change.text));
  }
  document.version = version;
  forget(document);
  invalidate(document.path);
}

/// Has all scripts looked at again that import a file.
void Workspace::invalidate(const std::filesystem::path& path) {
  if (path.empty()) return;
  for (auto& [uri, document] : documents_) {
    if (document.service && document.service->has_file(path)) forget(document);
  }
}

void Workspace::files_changed() {
  for (auto& [uri, document] : documents_) forget(document);
}

std::vector<FileDiagnostics> Workspace::close(const std::string& uri) {
  const auto document = documents_.find(uri);
  if (document == documents_.end()) return {};
  const std::filesystem::path path = document->second.path;
  documents_.erase(document);
  invalidate(path);
  std::vector<FileDiagnostics> left = replace_found(uri, {});
  found_.erase(uri);
  return left;
}

Document* Workspace::find(const std::string& uri) {
  const auto document = documents_.find(uri);
  return document == documents_.end() ? nullptr : &document->second;
}

const LanguageService& Workspace::service(Document& document) const {
  if (!document.service)
    document.service = std::make_unique<LanguageService>(document.text, document.name, options());
  return *document.service;
}

std::vector<const LanguageService*> Workspace::services() {
  std::vector<const LanguageService*> services;
  for (auto& [uri, document] : documents_) services.push_back(&service(document));
  return services;
}

/// Returns options by which scripts find their files: open texts before those on the disk.
ScriptOptions Workspace::options() const {
  ScriptOptions options;
  options.resource_directories = resources_;
  options.open_file = [this](const std::filesystem::path& path) {
    std::optional<std::vector<std::byte>> content;
    const auto document = std::find_if(documents_.begin(), documents_.end(),
                                       [&](const auto& open) { return open.second.path == path; });
    if (document == documents_.end()) return content;
    const std::string& text = document->second.text;
    const auto* begin = reinterpret_cast<const std::byte*>(text.data());
    content.emplace(begin, begin + text.size());
    return content;
  };
  return options;
}

std::string_view Workspace::text_of(const std::string& name) const {
  for (const auto& [uri, document] : documents_) {
    if (document.name == name) return document.text;
  }
  for (const auto& [uri, document] : documents_) {
    if (!document.service) continue;
    for (const ScriptFile& file : document.service->files()) {
      if (file.name == name) return file.text;
    }
  }
  return {};
}

bool Workspace::has_unchecked() const {
  return std::any_of(documents_.begin(), documents_.end(),
                     [](const auto& document) { return document.second.is_to_check; });
}

std::vector<FileDiagnostics> Workspace::check_next() {
  for (auto& [uri, document] : documents_) {
    if (!std::exchange(document.is_to_check, false)) continue;
    ByFile found;
    found[uri];  // where nothing is wrong any more, that is said, too
    for (Diagnostic& diagnostic : service(document).diagnostics())
      found[uri_of_name(diagnostic.place.file)].push_back(std::move(diagnostic));
    return replace_found(uri, std::move(found));
  }
  return {};
}

/// Replaces what was found when a document was checked before. Returns what its files have now: a
/// file that several scripts import has what was found by any of them, once.
std::vector<FileDiagnostics> Workspace::replace_found(const std::string& uri, ByFile found) {
  std::set<std::string> files;
  for (const auto& [file, diagnostics] : found_[uri]) files.insert(file);
  for (const auto& [file, diagnostics] : found) files.insert(file);
  found_[uri] = std::move(found);
  std::vector<FileDiagnostics> result;
  for (const std::string& file : files) {
    FileDiagnostics all{.uri = file, .diagnostics = {}};
    for (const auto& [checked, by_file] : found_) {
      const auto here = by_file.find(file);
      if (here == by_file.end()) continue;
      for (const Diagnostic& diagnostic : here->second) {
        const bool is_known =
            std::any_of(all.diagnostics.begin(), all.diagnostics.end(),
                        [&](const Diagnostic& known) { return same(known, diagnostic); });
        if (!is_known) all.diagnostics.push_back(diagnostic);
      }
    }
    result.push_back(std::move(all));
  }
  return result;
}

std::string Workspace::uri_of_name(const std::string& name) const {
  for (const auto& [uri, document] : documents_) {
    if (document.name == name) return uri;
  }
  return uri_of(name);
}

}  // namespace crt::lsp
