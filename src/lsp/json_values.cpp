#include "lsp/json_values.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "lsp/uri.hpp"

namespace crt::lsp {

using nlohmann::json;

namespace {

json to_json(const Position& position) {
  return {{"line", position.line}, {"character", position.character}};
}

/// Reads a count, which the protocol bounds by 2^31 - 1. Others are cut to that.
std::uint32_t count_of(const json& value) {
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  if (value.is_number_unsigned())
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(value.get<std::uint64_t>(), most));
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(value.get<std::int64_t>(), 0, most));
}

/// Returns the range of a diagnostic, whose columns count code points.
Range range_of_place(const SourcePlace& place, std::string_view line, Encoding encoding) {
  if (place.line < 1) return {};
  const auto column = static_cast<std::size_t>(std::max(place.column, 1)) - 1;
  const auto length = static_cast<std::size_t>(std::max(place.length, 0));
  const std::string_view before = first_code_points(line, column);
  const std::string_view marked = first_code_points(line.substr(before.size()), length);
  const auto number = static_cast<std::uint32_t>(place.line) - 1;
  const std::uint32_t begin = count_characters(before, encoding);
  return {{number, begin}, {number, begin + count_characters(marked, encoding)}};
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

Position position_of_json(const json& value) {
  return {count_of(value.at("line")), count_of(value.at("character"))};
}

Range range_of_json(const json& value) {
  return {position_of_json(value.at("start")), position_of_json(value.at("end"))};
}

json to_json(const Range& range) {
  return {{"start", to_json(range.start)}, {"end", to_json(range.end)}};
}

json diagnostics_json(const FileDiagnostics& file, Encoding encoding) {
  json list = json::array();
  for (const Diagnostic& diagnostic : file.diagnostics) {
    constexpr int error = 1;
    constexpr int warning = 2;
    list.push_back(
        {{"range", to_json(range_of_place(diagnostic.place, diagnostic.source_line, encoding))},
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

json location_json(const Place& place, const Workspace& workspace) {
  const Range range =
      place.source ? range_of(*place.source, place.span, workspace.encoding()) : Range{};
  return {{"uri", workspace.uri_of_name(place.file)}, {"range", to_json(range)}};
}

json symbol_json(const DocumentSymbol& symbol, const lang::Source& source, Encoding encoding) {
  constexpr int module_kind = 2;
  constexpr int function_kind = 12;
  constexpr int variable_kind = 13;
  return {{"name", symbol.name},
          {"kind", symbol.is_block   ? module_kind
                   : symbol.is_macro ? function_kind
                                     : variable_kind},
          {"range", to_json(range_of(source, symbol.whole, encoding))},
          {"selectionRange", to_json(range_of(source, symbol.span, encoding))}};
}

json edits_json(const lang::Source& source, const std::string& text, Encoding encoding) {
  const std::string& before = source.text;
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
  const Range range{
      position_of(source, static_cast<std::uint32_t>(begin), encoding),
      position_of(source, static_cast<std::uint32_t>(before.size() - same), encoding)};
  return json::array(
      {{{"range", to_json(range)}, {"newText", text.substr(begin, text.size() - same - begin)}}});
}

}  // namespace crt::lsp
