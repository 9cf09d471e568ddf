// This translates between what the server computes and the protocol's JSON.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lsp/workspace.hpp"

namespace crt::lsp {

// What the JSON library throws says that a value is not as it should be.
LineColumn position_of_json(const nlohmann::json& value);
Range range_of_json(const nlohmann::json& value);

nlohmann::json to_json(const Range& range);

/// Returns the notification that shows a file's diagnostics.
nlohmann::json diagnostics_json(const FileDiagnostics& file, ColumnUnit unit);

nlohmann::json completion_json(const Completion& item, const Range& range, bool takes_snippets);

/// A LocationWriter writes places in any scripts. It counts the lines of each script once.
class LocationWriter {
 public:
  explicit LocationWriter(const Workspace& workspace) : workspace_(workspace) {}
  nlohmann::json write(const ScriptLocation& location);

 private:
  const Workspace& workspace_;
  std::map<std::string, TextPlaces> places_;
};

/// Returns the symbols of a document: its blocks, and what it sets at the top level.
nlohmann::json symbols_json(const std::vector<ScriptNode>& tree, const TextPlaces& places,
                            ColumnUnit unit);

/// Returns the edits that make another text of a document: none, or one of the lines that differ.
nlohmann::json edits_json(const Document& document, const std::string& text, ColumnUnit unit);

}  // namespace crt::lsp
