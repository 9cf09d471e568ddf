// This file writes diagnostics for people, and as JSON for programs.
#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>

#include "crt/script.hpp"
#include "lang/utf8.hpp"
#include "text/format.hpp"

namespace crt {

namespace {

using lang::count_code_points;
using lang::decode_utf8;
using lang::printable;

/// Longer lines are shown in part, around the marked piece.
constexpr std::size_t widest_line = 160;
constexpr std::size_t shown_before_mark = 60;
/// So many calls are shown, and the rest is only counted.
constexpr std::size_t max_calls_shown = 10;

std::string head(const Diagnostic& diagnostic) {
  const char* kind = diagnostic.severity == Severity::error ? "error" : "warning";
  const SourcePlace& place = diagnostic.place;
  const std::string message = printable(diagnostic.message);
  if (place.line == 0) return text::format("{}: {}: {}\n", printable(place.file), kind, message);
  return text::format("{}:{}:{}: {}: {}\n", printable(place.file), place.line, place.column, kind,
                      message);
}

/// Returns the bytes of `text` that hold the code points [first, first + count).
std::string_view code_points(std::string_view text, std::size_t first, std::size_t count) {
  std::size_t begin = 0;
  while (first > 0 && begin < text.size()) decode_utf8(text, begin), --first;
  std::size_t end = begin;
  while (count > 0 && end < text.size()) decode_utf8(text, end), --count;
  return text.substr(begin, end - begin);
}

/// Returns the source line, and below it a caret under the first marked column and tildes under the
/// others.
std::string excerpt(const Diagnostic& diagnostic) {
  if (diagnostic.place.line == 0 || diagnostic.place.column < 1) return {};
  const std::string line = printable(diagnostic.source_line);
  const std::size_t width = count_code_points(line);
  const auto column = static_cast<std::size_t>(diagnostic.place.column - 1);
  if (column > width) return {};
  const std::size_t first =
      width <= widest_line || column < shown_before_mark ? 0 : column - shown_before_mark;
  const std::string_view shown = code_points(line, first, widest_line);
  std::string result = "  ";
  if (first > 0) result += "...";
  result += shown;
  result += first + widest_line < width ? "...\n  " : "\n  ";
  if (first > 0) result += "   ";
  // Tabs stay tabs, so that the caret stands below its column however wide they are shown.
  const std::string_view before = code_points(shown, 0, column - first);
  for (std::size_t position = 0; position < before.size();)
    result += decode_utf8(before, position) == U'\t' ? '\t' : ' ';
  result += '^';
  const std::size_t visible = std::min(width, first + widest_line);
  const auto length = static_cast<std::size_t>(std::max(1, diagnostic.place.length));
  if (column + 1 < visible) result.append(std::min(length - 1, visible - column - 1), '~');
  return result + '\n';
}

std::string json_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : printable(text)) {
    if (c == '"' || c == '\\') result += '\\';
    if (c == '\t') {
      result += "\\t";
    } else {
      result += c;
    }
  }
  return result + '"';
}

std::string json_place(const SourcePlace& place) {
  return text::format(R"("file": {}, "line": {}, "column": {}, "length": {})",
                      json_string(place.file), place.line, place.column, place.length);
}

std::string to_json(const Diagnostic& diagnostic) {
  std::string calls;
  for (const auto& [name, place] : diagnostic.calls) {
    if (!calls.empty()) calls += ", ";
    calls += text::format(R"({{"name": {}, {}}})", json_string(name), json_place(place));
  }
  return text::format(
      R"({{"severity": "{}", "code": {}, "message": {}, {}, "source": {}, "calls": [{}]}})",
      diagnostic.severity == Severity::error ? "error" : "warning",
      json_string(to_string(diagnostic.code)), json_string(diagnostic.message),
      json_place(diagnostic.place), json_string(diagnostic.source_line), calls);
}

}  // namespace

std::string format_diagnostic(const Diagnostic& diagnostic) {
  std::string result = head(diagnostic) + excerpt(diagnostic);
  const std::size_t shown = std::min(diagnostic.calls.size(), max_calls_shown);
  for (std::size_t i = 0; i < shown; ++i) {
    const auto& [name, place] = diagnostic.calls[i];
    result += text::format("  in '{}', called at {}:{}:{}\n", printable(name),
                           printable(place.file), place.line, place.column);
  }
  if (shown < diagnostic.calls.size())
    result += text::format("  and {} calls more\n", diagnostic.calls.size() - shown);
  return result;
}

std::string diagnostics_to_json(const std::vector<Diagnostic>& diagnostics) {
  std::string result = "[";
  for (const Diagnostic& diagnostic : diagnostics) {
    result += result.size() > 1 ? ",\n " : "\n ";
    result += to_json(diagnostic);
  }
  return result + (diagnostics.empty() ? "]\n" : "\n]\n");
}

}  // namespace crt
