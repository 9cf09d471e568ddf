// A SourceMap holds the texts of a run: the script, its imports and the overrides. All of them
// share one range of offsets, so that a place in any of them is a pair of numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "crt/script.hpp"

namespace crt::lang {

/// A Span is a piece of source text, [begin, end), in offsets of the SourceMap.
struct Span {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  friend bool operator==(const Span&, const Span&) = default;
};

/// Says what a text is meant to be.
enum class TextKind { script, expression };

struct Source {
  std::string name;  ///< its name in messages
  std::string text;  ///< std::string keeps a NUL behind its end, which the lexer relies on
  std::filesystem::path directory;  ///< where its files are looked for
  std::uint32_t base = 0;
  std::vector<std::uint32_t> line_starts;  ///< relative to base
};

/// Returns where the lines of a text begin. A line ends with \n, \r\n or \r.
std::vector<std::uint32_t> find_line_starts(std::string_view text);

/// Returns the number of the line, from 0, that holds an offset from the source's base.
std::size_t line_of(const Source& source, std::uint32_t offset);

/// Returns a line that there is, without its end.
std::string_view line_at(const Source& source, std::size_t line);

class SourceMap {
 public:
  /// Offsets are 32 bits wide. What the limits allow is cut down to this.
  static constexpr std::size_t most_bytes = std::size_t{1} << 30;

  /// Adds a text. The reference stays valid.
  const Source& add(std::string name, std::string text, std::filesystem::path directory = {});

  /// Returns the bytes of all texts together.
  std::size_t size() const { return next_base_; }

  SourcePlace place(Span span) const;

  /// Returns the line on which `span` begins, without its end. A very long line is cut off.
  std::string line_text(Span span) const;

  /// Returns the text of a piece of a source.
  std::string_view text(Span span) const;

  /// Returns the source that a place is in. There is at least one.
  const Source& source_of(Span span) const;

 private:
  std::deque<Source> sources_;
  std::uint32_t next_base_ = 0;
};

}  // namespace crt::lang
