#include "lsp/json_values.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "lsp/uri.hpp"

namespace crt::lsp {

using nlohmann::json;

namespace {

json to_json(const LineColumn& position) {
  return {{"line", position.line}, {"character", position.column}};
}

/// Reads a count, which the protocol bounds by 2^31 - 1. Others are cut to that.
std::uint32_t count_of(const json& value) {
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  if (value.is_number_unsigned())
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(value.get<std::uint64_t>(), most));
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(value.get<std::int64_t>(), 0, most));
}

/// Returns the range of a diagnostic, in whatever file it is.
Range range_of_diagnostic(const Diagnostic& diagnostic, ColumnUnit unit) {
  SourcePlace place = diagnostic.place;
  if (place.line < 1) return {};
  const auto line = static_cast<std::uint32_t>(place.line) - 1;
  place.line = 1;
  const TextPlaces places(diagnostic.source_line);
  Range range = range_of(places, places.span_of(place), unit);
  range.start.line = range.end.line = line;
  return range;
}

/// Returns a diagnostic's message with the calls that led to it.
std::string message_of(const Diagnostic& diagnostic) {
  std::string message = diagnostic.message;
  for (const auto& [name, place] : diagnostic.calls) {
    constexpr std::size_t longest = 1000;
    if (message.size() > longest) return message + "\n...";
    message += "\nin '" + name + "', called at " + place.file + ":" + std::to_string(place.line);
  }
  return message;
}

int kind_of(CompletionKind kind) {
  switch (kind) {
    case CompletionKind::attribute:
      return 10;  // Property
    case CompletionKind::object:
      return 7;  // Class
    case CompletionKind::macro:
      return 2;  // Method
    case CompletionKind::function:
      return 3;  // Function
    case CompletionKind::constant:
      return 21;  // Constant
    case CompletionKind::keyword:
      return 14;  // Keyword
    case CompletionKind::variable:
      break;
  }
  return 6;  // Variable
}

}  // namespace

LineColumn position_of_json(const json& value) {
  return {count_of(value.at("line")), count_of(value.at("character"))};
}

Range range_of_json(const json& value) {
  return {position_of_json(value.at("start")), position_of_json(value.at("end"))};
}

json to_json(const Range& range) {
  return {{"start", to_json(range.start)}, {"end", to_json(range.end)}};
}

json diagnostics_json(const FileDiagnostics& file, ColumnUnit unit) {
  json list = json::array();
  for (const Diagnostic& diagnostic : file.diagnostics) {
    constexpr int error = 1;
    constexpr int warning = 2;
    list.push_back({{"range", to_json(range_of_diagnostic(diagnostic, unit))},
                    {"severity", diagnostic.severity == Severity::error ? error : warning},
                    {"source", "crt"},
                    {"message", message_of(diagnostic)}});
  }
  return {{"jsonrpc", "2.0"},
          {"method", "textDocument/publishDiagnostics"},
          {"params", {{"uri", file.uri}, {"diagnostics", std::move(list)}}}};
}

json completion_json(const Completion& item, const Range& range, bool takes_snippets) {
  const bool is_snippet = takes_snippets && !item.snippet.empty();
  json result = {{"label", item.label},
                 {"kind", kind_of(item.kind)},
                 {"sortText", std::to_string(item.rank) + item.label},
                 {"textEdit",
                  {{"range", to_json(range)}, {"newText", is_snippet ? item.snippet : item.text}}}};
  if (is_snippet) result["insertTextFormat"] = 2;
  if (!item.detail.empty()) result["detail"] = item.detail;
  if (!item.documentation.empty())
    result["documentation"] = {{"kind", "markdown"}, {"value", item.documentation}};
  return result;
}

json LocationWriter::write(const ScriptLocation& location) {
  const auto found = places_.try_emplace(location.file, workspace_.text_of(location.file)).first;
  return {{"uri", workspace_.uri_of_name(location.file)},
          {"range", to_json(range_of(found->second, location.span, workspace_.unit()))}};
}

json symbols_json(const std::vector<ScriptNode>& tree, const TextPlaces& places, ColumnUnit unit) {
  constexpr int module_kind = 2;
  constexpr int function_kind = 12;
  constexpr int variable_kind = 13;
  json result = json::array();
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const ScriptNode& node = tree[i];
    const bool is_block = node.kind == NodeKind::settings || node.kind == NodeKind::scene;
    const bool is_symbol = is_block || node.kind == NodeKind::assignment;
    if (node.parent != ScriptNode::no_parent || !is_symbol) continue;
    const bool is_macro =
        i + 1 < tree.size() && tree[i + 1].parent == i && tree[i + 1].kind == NodeKind::macro;
    const int kind = is_block ? module_kind : is_macro ? function_kind : variable_kind;
    result.push_back({{"name", node.name},
                      {"kind", kind},
                      {"range", to_json(range_of(places, node.span, unit))},
                      {"selectionRange", to_json(range_of(places, node.name_span, unit))}});
  }
  return result;
}

json edits_json(const Document& document, const std::string& text, ColumnUnit unit) {
  const std::string& before = document.text;
  if (text == before) return json::array();
  // The edit begins and ends with lines, so it does not cut a character or a line end.
  const auto ends = std::mismatch(before.begin(), before.end(), text.begin(), text.end());
  std::size_t begin = static_cast<std::size_t>(ends.first - before.begin());
  begin = begin == 0 ? 0 : before.rfind('\n', begin - 1) + 1;
  const std::size_t most = std::min(before.size(), text.size()) - begin;
  std::size_t same = 0;
  while (same < most && before[before.size() - 1 - same] == text[text.size() - 1 - same]) ++same;
  const auto is_line_end = [&](std::size_t place) {
    return place == 0 || before[place - 1] == '\n';
  };
  while (same > 0 && !is_line_end(before.size() - same)) --same;
  const TextSpan span{static_cast<std::uint32_t>(begin),
                      static_cast<std::uint32_t>(before.size() - same)};
  const Range range = range_of(document.places, span, unit);
  return json::array(
      {{{"range", to_json(range)}, {"newText", text.substr(begin, text.size() - same - begin)}}});
}

}  // namespace crt::lsp
