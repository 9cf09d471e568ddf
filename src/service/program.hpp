// A program is a script with all that it imports, parsed as far as there is something to parse, and
// what its names mean. It is made anew when a text changes.
#pragma once

#include <crt/script.hpp>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "lang/files.hpp"
#include "lang/name_map.hpp"
#include "lang/partial_parse.hpp"
#include "lang/reporter.hpp"
#include "lang/run_parsed.hpp"
#include "lang/source_map.hpp"
#include "lang/symbol.hpp"
#include "lang/syntax.hpp"

namespace crt::service {

class Program {
 public:
  /// `name` is the script's path, or anything if it has none. `options` say how files are found.
  Program(const std::string& text, const std::string& name, const ScriptOptions& options);
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  const lang::Source& main() const { return *main_; }
  const lang::SourceMap& sources() const { return sources_; }
  const lang::SymbolTable& symbols() const { return symbols_; }
  const lang::Script& script() const { return scripts_.front(); }
  const lang::NameMap& names() const { return names_; }
  const lang::TokenList& tokens() const { return tokens_; }
  int compat() const { return compat_; }
  /// Says whether all of it was parsed: no source has a syntax error.
  bool is_whole() const { return is_whole_; }

  /// Returns the main script for a run, or nothing if the parser has anything to say of it. The run
  /// changes of the tree what nothing else here reads.
  std::optional<lang::ParsedScript> parsed_main() {
    if (!is_main_clean_) return std::nullopt;
    return lang::ParsedScript{scripts_.front(), symbols_, compat_};
  }

  std::string_view text_of(lang::Span span) const;

  /// Returns what a name at a place stands for, or null.
  const lang::DeclaredName* declared_at(lang::Span name) const;

  /// Returns the token of the main script that an offset is in or just behind, or null.
  const lang::Token* token_at(std::uint32_t offset) const;

  /// Returns the file that an import in the main script names, or nothing.
  std::filesystem::path imported_file(const lang::Import& import) const;

  /// Says whether the program was made of this file, too.
  bool has_file(const std::filesystem::path& path) const { return paths_.contains(path); }

  /// Lists the sources: the main script, then what it imports.
  const std::vector<const lang::Source*>& all_sources() const { return all_sources_; }

 private:
  const lang::Script* import_script(const lang::Import& import);
  const lang::Script* import_library(const lang::Import& import);
  /// Returns whether the parser found nothing to say.
  bool parse(const lang::Source& source);

  const ScriptOptions options_;
  lang::SourceMap sources_;
  lang::SymbolTable symbols_;
  lang::Files files_;
  int compat_ = 0;
  bool is_whole_ = true;
  bool is_main_clean_ = false;
  const lang::Source* main_ = nullptr;
  std::vector<const lang::Source*> all_sources_;
  std::deque<lang::Script> scripts_;
  std::set<std::filesystem::path> paths_;
  lang::TokenList tokens_;
  lang::NameMap names_;
};

/// Returns a span of a source in bytes of its text. Brackets that the front end closed stand behind
/// the end of the text, and end there.
TextSpan span_in(const lang::Source& source, lang::Span span);

/// Returns the year that a text says it is a script of, as far as the front end knows it, or 0.
int compat_of(const lang::SourceMap& sources, const lang::Source& source,
              const ScriptOptions& options);

}  // namespace crt::service
