#include "lang/source_map.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "lang/utf8.hpp"

namespace crt::lang {

namespace {

/// A line that is kept for a message has at most this length.
constexpr std::size_t longest_line_bytes = 4096;

}  // namespace

std::vector<std::uint32_t> find_line_starts(std::string_view text) {
  std::vector<std::uint32_t> starts{0};
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\n' && text[i] != '\r') continue;
    const bool goes_on = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
    if (!goes_on) starts.push_back(static_cast<std::uint32_t>(i + 1));
  }
  return starts;
}

std::size_t line_of(const Source& source, std::uint32_t offset) {
  const auto after = std::upper_bound(source.line_starts.begin(), source.line_starts.end(), offset);
  return static_cast<std::size_t>(after - source.line_starts.begin()) - 1;
}

std::string_view line_at(const Source& source, std::size_t line) {
  const std::size_t begin = source.line_starts[line];
  const std::size_t end =
      line + 1 < source.line_starts.size() ? source.line_starts[line + 1] : source.text.size();
  std::string_view text = std::string_view(source.text).substr(begin, end - begin);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.remove_suffix(1);
  return text;
}

const Source& SourceMap::add(std::string name, std::string text, std::filesystem::path directory) {
  if (text.size() >= most_bytes - next_base_) throw std::length_error("source texts too long");
  Source& source = sources_.emplace_back();
  source.name = std::move(name);
  source.text = std::move(text);
  source.directory = std::move(directory);
  source.base = next_base_;
  source.line_starts = find_line_starts(source.text);
  // The text takes one more than its length, as its end is a place too.
  next_base_ += static_cast<std::uint32_t>(source.text.size()) + 1;
  return source;
}

const Source& SourceMap::source_of(Span span) const {
  const auto after =
      std::upper_bound(sources_.begin(), sources_.end(), span.begin,
                       [](std::uint32_t o, const Source& source) { return o < source.base; });
  return *std::prev(after);
}

SourcePlace SourceMap::place(Span span) const {
  if (sources_.empty()) return {};
  const Source& source = source_of(span);
  const std::uint32_t begin = span.begin - source.base;
  const std::size_t line = line_of(source, begin);
  const std::string_view text = line_at(source, line);
  const std::size_t before = std::min<std::size_t>(begin - source.line_starts[line], text.size());
  const std::size_t marked = std::min<std::size_t>(span.end - span.begin, text.size() - before);
  SourcePlace place;
  place.file = source.name;
  place.line = static_cast<int>(line + 1);
  place.column = static_cast<int>(count_code_points(text.substr(0, before)) + 1);
  place.length = std::max(1, static_cast<int>(count_code_points(text.substr(before, marked))));
  return place;
}

std::string SourceMap::line_text(Span span) const {
  if (sources_.empty()) return {};
  const Source& source = source_of(span);
  const std::string_view text = line_at(source, line_of(source, span.begin - source.base));
  return std::string(text.substr(0, longest_line_bytes));
}

std::string_view SourceMap::text(Span span) const {
  const Source& source = source_of(span);
  return std::string_view(source.text).substr(span.begin - source.base, span.end - span.begin);
}

}  // namespace crt::lang
