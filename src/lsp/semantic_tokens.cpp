#include "lsp/semantic_tokens.hpp"

namespace crt::lsp {

std::vector<std::uint32_t> semantic_tokens(const std::vector<ScriptToken>& tokens,
                                           const TextPlaces& places, ColumnUnit unit) {
  std::vector<std::uint32_t> data;
  data.reserve(5 * tokens.size());
  LineColumn before;
  for (const auto& [span, kind] : tokens) {
    const LineColumn begin = places.position_of(span.begin, unit);
    const std::uint32_t lines = begin.line - before.line;
    const std::uint32_t length = unit == ColumnUnit::utf8
                                     ? span.end - span.begin
                                     : places.unit_of(span.end) - places.unit_of(span.begin);
    data.insert(data.end(), {lines, lines > 0 ? begin.column : begin.column - before.column, length,
                             static_cast<std::uint32_t>(kind), 0});
    before = begin;
  }
  return data;
}

}  // namespace crt::lsp
