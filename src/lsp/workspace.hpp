// The workspace holds the texts that are open in the editor, what is known about them, and which
// of them are to be checked again.
#pragma once

#include <crt/language_service.hpp>
#include <crt/script.hpp>
#include <crt/text_places.hpp>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crt::lsp {

/// A Range is a piece of a text.
struct Range {
  LineColumn start;
  LineColumn end;
};

/// Returns the range of a piece of a text.
Range range_of(const TextPlaces& places, TextSpan span, ColumnUnit unit);

/// A Document is a text that is open in the editor.
struct Document {
  std::string uri;
  std::filesystem::path path;  ///< empty for a text that has no file
  std::string name;            ///< its path, or what stands for it
  std::int64_t version = 0;
  std::string text;
  TextPlaces places{""};  ///< of the text
  /// Is absent until it is asked for after a change.
  std::unique_ptr<LanguageService> service;
  bool is_to_check = true;
};

/// A Change replaces a range of a text, or all of it.
struct Change {
  std::optional<Range> range;
  std::string text;
};

/// FileDiagnostics is what is wrong with one file. An empty list takes earlier ones away.
struct FileDiagnostics {
  std::string uri;
  std::vector<Diagnostic> diagnostics;
};

class Workspace {
 public:
  void set_unit(ColumnUnit unit) { unit_ = unit; }
  /// Returns what the columns of ranges count.
  ColumnUnit unit() const { return unit_; }
  void add_resources(std::filesystem::path folder) { resources_.push_back(std::move(folder)); }

  void open(const std::string& uri, std::int64_t version, std::string text);
  void change(Document& document, std::int64_t version, const std::vector<Change>& changes);
  /// Forgets a text. Returns what its files are left with.
  std::vector<FileDiagnostics> close(const std::string& uri);
  /// Takes note that files have changed on the disk.
  void files_changed();

  /// Returns an open document, or null.
  Document* find(const std::string& uri);

  const LanguageService& service(Document& document) const;
  /// Returns the services of all open documents.
  std::vector<const LanguageService*> services();

  /// Returns the text of a script that is open, or that one of those imports. It may be empty.
  std::string_view text_of(const std::string& name) const;

  /// Returns the URI of a script by its name: an open document's as the editor wrote it.
  std::string uri_of_name(const std::string& name) const;

  bool has_unchecked() const;
  /// Checks a document that waits for it, and returns the files whose diagnostics are new.
  std::vector<FileDiagnostics> check_next();

 private:
  using ByFile = std::map<std::string, std::vector<Diagnostic>>;

  ScriptOptions options() const;
  void invalidate(const std::filesystem::path& path);
  std::vector<FileDiagnostics> replace_found(const std::string& uri, ByFile found);

  ColumnUnit unit_ = ColumnUnit::utf16;
  std::vector<std::filesystem::path> resources_;
  std::map<std::string, Document> documents_;
  /// What was found wrong, by the document that was checked and by the URI that it is about.
  std::map<std::string, ByFile> found_;
};

}  // namespace crt::lsp
