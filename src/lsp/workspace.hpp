// The workspace holds the texts that are open in the editor, what is known about them, and which
// of them are to be checked again.
#pragma once

#include <crt/script.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lang/source_map.hpp"
#include "lsp/positions.hpp"
#include "service/navigation.hpp"
#include "service/program.hpp"

namespace crt::lsp {

using service::Place;
using service::Program;

/// A Document is a text that is open in the editor.
struct Document {
  std::string uri;
  std::filesystem::path path;  ///< empty for a text that has no file
  std::string name;            ///< its path, or what stands for it
  std::int64_t version = 0;
  /// Has this one source. It is replaced with every change.
  std::unique_ptr<lang::SourceMap> map;
  const lang::Source* source = nullptr;
  /// Is absent until it is asked for after a change.
  std::unique_ptr<Program> program;
  bool is_to_check = true;

  const std::string& text() const { return source->text; }
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
  void set_encoding(Encoding encoding) { encoding_ = encoding; }
  Encoding encoding() const { return encoding_; }
  void add_resources(std::filesystem::path folder) { resources_.push_back(std::move(folder)); }

  void open(const std::string& uri, std::int64_t version, std::string text);
  void change(Document& document, std::int64_t version, const std::vector<Change>& changes);
  /// Forgets a text. Returns what its files are left with.
  std::vector<FileDiagnostics> close(const std::string& uri);
  /// Takes note that files have changed on the disk.
  void files_changed();

  /// Returns an open document, or null.
  Document* find(const std::string& uri);
  std::vector<Document*> documents();

  const Program& program(Document& document) const;

  /// Returns options by which scripts find their files: open texts before those on the disk.
  ScriptOptions options() const;

  /// Returns the URI of a source by its name: an open document's as the editor wrote it.
  std::string uri_of_name(const std::string& name) const;

  /// Returns the places that get the new name, also those in other open documents that see it.
  /// Throws std::invalid_argument as rename_at() does.
  std::vector<Place> rename(Document& document, std::uint32_t byte, const std::string& new_name);

  bool has_unchecked() const;
  /// Checks a document that waits for it, and returns the files whose diagnostics are new.
  std::vector<FileDiagnostics> check_next();

 private:
  using ByFile = std::map<std::string, std::vector<Diagnostic>>;

  void set_text(Document& document, std::string text);
  void invalidate(const std::filesystem::path& path);
  std::vector<FileDiagnostics> replace_found(const std::string& uri, ByFile found);

  Encoding encoding_ = Encoding::utf16;
  std::vector<std::filesystem::path> resources_;
  std::map<std::string, Document> documents_;
  /// What was found wrong, by the document that was checked and by the URI that it is about.
  std::map<std::string, ByFile> found_;
};

}  // namespace crt::lsp
