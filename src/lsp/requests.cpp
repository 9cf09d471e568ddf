#include "lsp/requests.hpp"

#include <algorithm>
#include <crt/language_service.hpp>
#include <nlohmann/json.hpp>
#include <utility>

#include "lsp/json_values.hpp"
#include "lsp/semantic_tokens.hpp"
#include "lsp/uri.hpp"
#include "service/completion.hpp"
#include "service/hover.hpp"
#include "service/navigation.hpp"

namespace crt::lsp {

using nlohmann::json;

Requests::Requests()
    : reference_(service::reference_text()),
      methods_{
          {"textDocument/completion", &Requests::completion},
          {"textDocument/hover", &Requests::hover},
          {"textDocument/definition", &Requests::definition},
          {"textDocument/references", &Requests::references},
          {"textDocument/documentHighlight", &Requests::highlights},
          {"textDocument/prepareRename", &Requests::prepare_rename},
          {"textDocument/rename", &Requests::rename},
          {"textDocument/documentSymbol", &Requests::symbols},
          {"textDocument/semanticTokens/full", &Requests::tokens},
          {"textDocument/formatting", &Requests::formatting},
      } {}

json Requests::initialize(const json& params) {
  const auto get = [&](const char* path, const json& otherwise) {
    const json::json_pointer pointer(path);
    return params.contains(pointer) ? params.at(pointer) : otherwise;
  };
  const json encodings = get("/capabilities/general/positionEncodings", json::array());
  if (std::find(encodings.begin(), encodings.end(), json("utf-8")) != encodings.end())
    workspace_.set_encoding(Encoding::utf8);
  const json snippets =
      get("/capabilities/textDocument/completion/completionItem/snippetSupport", false);
  takes_snippets_ = snippets.is_boolean() && snippets.get<bool>();
  const json root = get("/rootUri", nullptr);
  const std::filesystem::path folder = root.is_string() ? path_of(root.get<std::string>()) : "";
  for (const json& resources : get("/initializationOptions/resources", json::array())) {
    if (resources.is_string()) workspace_.add_resources(folder / resources.get<std::string>());
  }
  const bool is_utf8 = workspace_.encoding() == Encoding::utf8;
  return {{"positionEncoding", is_utf8 ? "utf-8" : "utf-16"},
          {"semanticTokensProvider",
           {{"legend", {{"tokenTypes", token_types}, {"tokenModifiers", json::array()}}},
            {"full", true}}},
          {"textDocumentSync", {{"openClose", true}, {"change", 2}, {"save", true}}},
          {"completionProvider", {{"triggerCharacters", {"<"}}}},
          {"hoverProvider", true},
          {"definitionProvider", true},
          {"referencesProvider", true},
          {"documentHighlightProvider", true},
          {"renameProvider", {{"prepareProvider", true}}},
          {"documentSymbolProvider", true},
          {"documentFormattingProvider", true}};
}

json Requests::handle(const std::string& method, const json& params) {
  const auto found = methods_.find(method);
  if (found == methods_.end()) throw RequestError(method_not_found, "no method " + method);
  return (this->*found->second)(params);
}

std::vector<json> Requests::notify(const std::string& method, const json& params) {
  if (method == "textDocument/didOpen") open(params);
  if (method == "textDocument/didChange") change(params);
  if (method == "textDocument/didSave" || method == "workspace/didChangeWatchedFiles")
    workspace_.files_changed();
  if (method == "textDocument/didClose")
    return diagnostics_of(workspace_.close(params.at("textDocument").at("uri").get<std::string>()));
  return {};
}

std::vector<json> Requests::check_next() {
  return diagnostics_of(workspace_.check_next());
}

std::vector<json> Requests::diagnostics_of(const std::vector<FileDiagnostics>& files) const {
  std::vector<json> notifications;
  notifications.reserve(files.size());
  for (const FileDiagnostics& file : files)
    notifications.push_back(diagnostics_json(file, workspace_.encoding()));
  return notifications;
}

Document& Requests::document_of(const json& params) {
  const auto uri = params.at("textDocument").at("uri").get<std::string>();
  Document* document = workspace_.find(uri);
  if (!document) throw RequestError(invalid_params, "the document is not open: " + uri);
  return *document;
}

std::uint32_t Requests::byte_of(const Document& document, const json& params) const {
  return byte_at(*document.source, position_of_json(params.at("position")), workspace_.encoding());
}

void Requests::open(const json& params) {
  const json& item = params.at("textDocument");
  workspace_.open(item.at("uri").get<std::string>(), item.at("version").get<std::int64_t>(),
                  item.at("text").get<std::string>());
}

void Requests::change(const json& params) {
  Document& document = document_of(params);
  std::vector<Change> changes;
  for (const json& change : params.at("contentChanges")) {
    Change& added = changes.emplace_back();
    added.text = change.at("text").get<std::string>();
    if (change.contains("range")) added.range = range_of_json(change.at("range"));
  }
  workspace_.change(document, params.at("textDocument").at("version").get<std::int64_t>(), changes);
}

json Requests::completion(const json& params) {
  Document& document = document_of(params);
  const CompletionList list = complete(workspace_.program(document), byte_of(document, params),
                                       workspace_.options(), reference_);
  const Range range{position_of(*document.source, list.begin, workspace_.encoding()),
                    position_of(*document.source, list.end, workspace_.encoding())};
  json items = json::array();
  for (const Completion& item : list.items)
    items.push_back(completion_json(item, range, takes_snippets_));
  return {{"isIncomplete", false}, {"items", std::move(items)}};
}

json Requests::hover(const json& params) {
  Document& document = document_of(params);
  const auto hover = hover_at(workspace_.program(document), byte_of(document, params), reference_);
  if (!hover) return nullptr;
  return {{"contents", {{"kind", "markdown"}, {"value", hover->markdown}}},
          {"range", to_json(range_of(*document.source, hover->span, workspace_.encoding()))}};
}

json Requests::definition(const json& params) {
  Document& document = document_of(params);
  const auto place = definition_at(workspace_.program(document), byte_of(document, params));
  if (!place) return nullptr;
  return location_json(*place, workspace_);
}

json Requests::references(const json& params) {
  Document& document = document_of(params);
  json locations = json::array();
  for (const Place& place : places_of(workspace_.program(document), byte_of(document, params)))
    locations.push_back(location_json(place, workspace_));
  return locations;
}

json Requests::highlights(const json& params) {
  Document& document = document_of(params);
  json result = json::array();
  for (const Place& place : places_of(workspace_.program(document), byte_of(document, params))) {
    if (place.file == document.name)
      result.push_back(
          {{"range", to_json(range_of(*place.source, place.span, workspace_.encoding()))}});
  }
  return result;
}

json Requests::prepare_rename(const json& params) {
  Document& document = document_of(params);
  const auto span = renamable_at(workspace_.program(document), byte_of(document, params));
  if (!span) return nullptr;
  return to_json(range_of(*document.source, *span, workspace_.encoding()));
}

json Requests::rename(const json& params) {
  Document& document = document_of(params);
  const auto new_name = params.at("newName").get<std::string>();
  try {
    const std::vector<Place> places =
        workspace_.rename(document, byte_of(document, params), new_name);
    json changes = json::object();
    for (const Place& place : places) {
      json location = location_json(place, workspace_);
      changes[location.at("uri").get<std::string>()].push_back(
          {{"range", std::move(location.at("range"))}, {"newText", new_name}});
    }
    return {{"changes", std::move(changes)}};
  } catch (const std::invalid_argument& error) {
    throw RequestError(request_failed, error.what());
  }
}

json Requests::symbols(const json& params) {
  Document& document = document_of(params);
  json result = json::array();
  for (const DocumentSymbol& symbol : document_symbols(workspace_.program(document)))
    result.push_back(symbol_json(symbol, *document.source, workspace_.encoding()));
  return result;
}

json Requests::tokens(const json& params) {
  return {
      {"data", semantic_tokens(workspace_.program(document_of(params)), workspace_.encoding())}};
}

json Requests::formatting(const json& params) {
  const Document& document = document_of(params);
  const auto formatted = format_script(document.text(), document.name).text;
  if (!formatted) return nullptr;
  return edits_json(*document.source, *formatted, workspace_.encoding());
}

}  // namespace crt::lsp
