#include "import/notes.hpp"

#include <utility>

namespace crt::importing {

namespace {

constexpr std::size_t most_notes = 1000;
constexpr std::size_t most_of_line = 200;  // a longer line is not shown

/// Returns the text of a line, or nothing if it is too long to be shown.
std::string line_of(std::string_view text, int line) {
  for (; line > 1; --line) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return "";
    text.remove_prefix(end + 1);
  }
  text = text.substr(0, text.find_first_of("\r\n"));
  return text.size() > most_of_line ? "" : std::string(text);
}

}  // namespace

int Notes::add_file(const std::string& name, std::string text) {
  files_.push_back({name, std::move(text)});
  return static_cast<int>(files_.size()) - 1;
}

void Notes::lost(const Place& place, const std::string& message) {
  add(partial_ ? Severity::warning : Severity::error, ErrorCode::script, place, message);
}

void Notes::differs(const Place& place, const std::string& message) {
  add(Severity::warning, ErrorCode::script, place, message);
}

void Notes::failed(const Failure& failure) {
  add(Severity::error, failure.code(), failure.place(), failure.what());
}

void Notes::add(Severity severity, ErrorCode code, const Place& place, const std::string& message) {
  has_errors_ = has_errors_ || severity == Severity::error;
  if (diagnostics_.size() >= most_notes) return;
  if (!said_.emplace(place.file, place.line, place.column, message).second) return;
  Diagnostic diagnostic{.severity = severity, .code = code, .message = message};
  const auto file = static_cast<std::size_t>(place.file);
  if (file < files_.size()) {
    diagnostic.place = {
        .file = files_[file].name, .line = place.line, .column = place.column, .length = 1};
    diagnostic.source_line = line_of(files_[file].text, place.line);
  }
  diagnostics_.push_back(std::move(diagnostic));
}

}  // namespace crt::importing
