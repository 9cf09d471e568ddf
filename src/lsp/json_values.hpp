// This translates between what the server computes and the protocol's JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "lsp/positions.hpp"
#include "lsp/workspace.hpp"
#include "service/completion.hpp"
#include "service/navigation.hpp"

namespace crt::lsp {

using service::DocumentSymbol;
using service::Place;

// What the JSON library throws says that a value is not as it should be.
Position position_of_json(const nlohmann::json& value);
Range range_of_json(const nlohmann::json& value);

nlohmann::json to_json(const Range& range);

/// Returns the notification that shows a file's diagnostics.
nlohmann::json diagnostics_json(const FileDiagnostics& file, Encoding encoding);

nlohmann::json completion_json(const Completion& item, const Range& range, bool takes_snippets);

nlohmann::json location_json(const Place& place, const Workspace& workspace);

nlohmann::json symbol_json(const DocumentSymbol& symbol, const lang::Source& source,
                           Encoding encoding);

/// Returns the edits that make one text of another: none, or one of the lines that differ.
nlohmann::json edits_json(const lang::Source& source, const std::string& text, Encoding encoding);

}  // namespace crt::lsp
