#include "lsp/requests.hpp"

#include <algorithm>
#include <crt/error.hpp>
#include <crt/language_service.hpp>
#include <nlohmann/json.hpp>
#include <utility>

#include "lsp/json_values.hpp"
#include "lsp/semantic_tokens.hpp"
#include "lsp/uri.hpp"

namespace crt::lsp {

using nlohmann::json;

json Requests::initialize(const json& params) {
  const auto get = [&](const char* path, const json& otherwise) {
    const json::json_pointer pointer(path);
    return params.contains(pointer) ? params.at(pointer) : otherwise;
  };
  const json encodings = get("/capabilities/general/positionEncodings", json::array());
  if (std::find(encodings.begin(), encodings.end(), json("utf-8")) != encodings.end())
    workspace_.set_unit(ColumnUnit::utf8);
  const json snippets =
      get("/capabilities/textDocument/completion/completionItem/snippetSupport", false);
  takes_snippets_ = snippets.is_boolean() && snippets.get<bool>();
  const json root = get("/rootUri", nullptr);
  const std::filesystem::path folder = root.is_string() ? path_of(root.get<std::string>()) : "";
  for (const json& resources : get("/initializationOptions/resources", json::array())) {
    if (resources.is_string()) workspace_.add_resources(folder / resources.get<std::string>());
  }
  const bool is_utf8 = workspace_.unit() == ColumnUnit::utf8;
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
  using Answer = json (Requests::*)(const json&);
  static const std::map<std::string, Answer> methods = {
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
  };
  const auto found = methods.find(method);
  if (found == methods.end()) throw RequestError(method_not_found, "no method " + method);
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
    notifications.push_back(diagnostics_json(file, workspace_.unit()));
  return notifications;
}

Document& Requests::document_of(const json& params) {
  const auto uri = params.at("textDocument").at("uri").get<std::string>();
  Document* document = workspace_.find(uri);
  if (!document) throw RequestError(invalid_params, "the document is not open: " + uri);
  return *document;
}

std::uint32_t Requests::byte_of(const Document& document, const json& params) const {
  return document.places.byte_at(position_of_json(params.at("position")), workspace_.unit());
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
  const CompletionList list = workspace_.service(document).complete(byte_of(document, params));
  const Range range = range_of(document.places, {list.begin, list.end}, workspace_.unit());
  json items = json::array();
  for (const Completion& item : list.items)
    items.push_back(completion_json(item, range, takes_snippets_));
  return {{"isIncomplete", false}, {"items", std::move(items)}};
}

json Requests::hover(const json& params) {
  Document& document = document_of(params);
  const auto hover = workspace_.service(document).hover(byte_of(document, params));
  if (!hover) return nullptr;
  return {{"contents", {{"kind", "markdown"}, {"value", hover->markdown}}},
          {"range", to_json(range_of(document.places, hover->span, workspace_.unit()))}};
}

json Requests::definition(const json& params) {
  Document& document = document_of(params);
  const auto location = workspace_.service(document).definition(byte_of(document, params));
  if (!location) return nullptr;
  return LocationWriter(workspace_).write(*location);
}

json Requests::references(const json& params) {
  Document& document = document_of(params);
  LocationWriter writer(workspace_);
  json result = json::array();
  for (const ScriptLocation& location :
       workspace_.service(document).places(byte_of(document, params)))
    result.push_back(writer.write(location));
  return result;
}

json Requests::highlights(const json& params) {
  Document& document = document_of(params);
  json result = json::array();
  for (const ScriptLocation& location :
       workspace_.service(document).places(byte_of(document, params))) {
    if (location.file == document.name)
      result.push_back(
          {{"range", to_json(range_of(document.places, location.span, workspace_.unit()))}});
  }
  return result;
}

json Requests::prepare_rename(const json& params) {
  Document& document = document_of(params);
  const auto span = workspace_.service(document).renamable_name(byte_of(document, params));
  return span ? to_json(range_of(document.places, *span, workspace_.unit())) : json(nullptr);
}

json Requests::rename(const json& params) {
  Document& document = document_of(params);
  const auto new_name = params.at("newName").get<std::string>();
  try {
    LocationWriter writer(workspace_);
    json changes = json::object();
    for (const ScriptLocation& location : workspace_.service(document).rename(
             byte_of(document, params), new_name, workspace_.services())) {
      json written = writer.write(location);
      changes[written.at("uri").get<std::string>()].push_back(
          {{"range", std::move(written.at("range"))}, {"newText", new_name}});
    }
    return {{"changes", std::move(changes)}};
  } catch (const Error& error) {
    throw RequestError(request_failed, error.what());
  }
}

json Requests::symbols(const json& params) {
  Document& document = document_of(params);
  return symbols_json(workspace_.service(document).tree(), document.places, workspace_.unit());
}

json Requests::tokens(const json& params) {
  Document& document = document_of(params);
  return {{"data", semantic_tokens(workspace_.service(document).tokens(), document.places,
                                   workspace_.unit())}};
}

json Requests::formatting(const json& params) {
  const Document& document = document_of(params);
  const auto formatted = format_script(document.text, document.name).text;
  if (!formatted) return nullptr;
  return edits_json(document, *formatted, workspace_.unit());
}

}  // namespace crt::lsp
