#include "format/format.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "format/layout.hpp"
#include "lang/compat.hpp"
#include "lang/parser.hpp"
#include "lang/utf8.hpp"

namespace crt::format {

namespace {

constexpr std::size_t indentation = 4;
/// Lines are not moved further in than this, so that no text grows beyond measure.
constexpr std::size_t max_indentation = 160;
/// A comment behind code stands at least so far from it.
constexpr std::size_t least_before_comment = 2;
/// Comments are not put into a common column further right than this.
constexpr std::size_t furthest_column = 120;

bool is_opening(Role role) {
  return role == Role::opening || role == Role::suffix_opening || role == Role::opening_brace ||
         role == Role::opening_modifiers;
}

bool is_closing(Role role) {
  return role == Role::closing || role == Role::closing_brace || role == Role::closing_modifiers;
}

bool blank_between(const Piece& left, const Piece& right) {
  switch (left.role) {
    case Role::opening:
    case Role::suffix_opening:
    case Role::opening_modifiers:
    case Role::joint:
      return false;
    case Role::prefix:
      // Two minus signs must not touch: they would begin a comment.
      return right.role == Role::prefix && left.text != "!";
    default:
      break;
  }
  return right.role != Role::comma && right.role != Role::joint &&
         right.role != Role::suffix_opening && right.role != Role::closing &&
         right.role != Role::closing_modifiers;
}

/// A Line is one line of the result.
struct Line {
  std::string code;
  std::string_view comment;  ///< empty, or behind the code
  std::size_t comment_column = 0;
  bool blank_before = false;
};

/// Puts pieces into lines.
class Writer {
 public:
  explicit Writer(const std::vector<Piece>& pieces) : pieces_(pieces) {}

  std::vector<Line> write() {
    for (std::size_t i = 0; i < pieces_.size();) i = write_line(i);
    return std::move(lines_);
  }

 private:
  /// Writes the line that begins with a piece, and returns the first piece behind it.
  std::size_t write_line(std::size_t first) {
    Line& line = lines_.emplace_back();
    line.blank_before = pieces_[first].lines_before > 1 && lines_.size() > 1;
    const std::size_t indent = indent_of(first);
    line.code.assign(std::min(indent, max_indentation), ' ');
    std::size_t i = first;
    for (; i < pieces_.size() && (i == first || pieces_[i].lines_before == 0); ++i) {
      const Piece& piece = pieces_[i];
      if (piece.role == Role::comment && i > first) {
        line.comment = piece.text;
        line.comment_column = piece.column;
        continue;
      }
      if (i > first && blank_between(pieces_[i - 1], piece)) line.code += ' ';
      line.code += piece.text;
      if (is_closing(piece.role) && !open_.empty()) open_.pop_back();
      if (is_opening(piece.role)) open_.push_back(indent);
    }
    return i;
  }

  std::size_t indent_of(std::size_t first) {
    if (is_closing(pieces_[first].role)) return open_.empty() ? 0 : open_.back();
    const std::size_t inside = open_.empty() ? 0 : open_.back() + indentation;
    // A comment stands where the code below it stands. That is looked for once for all that are
    // above it.
    code_below_ = std::max(code_below_, first);
    while (code_below_ + 1 < pieces_.size() && pieces_[code_below_].role == Role::comment)
      ++code_below_;
    return inside + (pieces_[code_below_].continues ? indentation : 0);
  }

  const std::vector<Piece>& pieces_;
  std::vector<Line> lines_;
  std::vector<std::size_t> open_;  ///< indentation of the line that each open bracket is on
  std::size_t code_below_ = 0;     ///< the first piece from the last line on that is no comment
};

/// Returns the column for the comments behind the lines [begin, end): that which they stand in, if
/// they stand in one that is far enough, else the nearest.
std::size_t column_of(const std::vector<Line>& lines, std::size_t begin, std::size_t end) {
  std::size_t widest = 0;
  bool in_one_column = true;
  for (std::size_t i = begin; i < end; ++i) {
    widest = std::max(widest, lang::count_code_points(lines[i].code));
    in_one_column = in_one_column && lines[i].comment_column == lines[begin].comment_column;
  }
  const std::size_t nearest = widest + least_before_comment;
  const std::size_t column = lines[begin].comment_column;
  return in_one_column && column >= nearest && column <= furthest_column ? column : nearest;
}

std::string join(const std::vector<Line>& lines, std::string_view line_end) {
  std::string text;
  for (std::size_t i = 0; i < lines.size();) {
    std::size_t end = i;
    while (end < lines.size() && !lines[end].comment.empty() &&
           (end == i || !lines[end].blank_before))
      ++end;
    const std::size_t column = column_of(lines, i, end);
    for (end = std::max(end, i + 1); i < end; ++i) {
      const Line& line = lines[i];
      if (line.blank_before) text += line_end;
      text += line.code;
      if (!line.comment.empty()) {
        const std::size_t width = lang::count_code_points(line.code);
        text.append(column <= furthest_column ? column - width : least_before_comment, ' ');
        text += line.comment;
      }
      text += line_end;
    }
  }
  return text;
}

/// Returns how the lines of a text end: as the first of them does.
std::string_view line_end_of(std::string_view text) {
  const std::size_t first = text.find('\n');
  return first != std::string_view::npos && first > 0 && text[first - 1] == '\r' ? "\r\n" : "\n";
}

/// Holds a parsed text. It must have no syntax errors to be laid out.
struct Parsed {
  lang::SymbolTable symbols;
  lang::Script script;
  lang::TokenList list;
};

Parsed parse(const lang::SourceMap& sources, const lang::Source& source, lang::Reporter& reporter) {
  Parsed parsed;
  const int compat = lang::written_compat(sources, source) == compat_2015 ? compat_2015 : 0;
  std::size_t memory_left = ScriptLimits{}.memory_bytes;
  parsed.script =
      lang::parse(source, lang::TextKind::script, compat, parsed.symbols, reporter, memory_left);
  if (!reporter.has_errors())
    parsed.list = lang::read_tokens(source, compat, parsed.symbols, reporter);
  return parsed;
}

bool same_pieces(const std::vector<Piece>& a, const std::vector<Piece>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Piece& x, const Piece& y) {
    return x.role == y.role && x.text == y.text;
  });
}

std::optional<std::string> format(const std::string& text, const std::string& name,
                                  lang::SourceMap& sources, lang::Reporter& reporter) {
  const lang::Source& source = sources.add(name, text);
  const Parsed parsed = parse(sources, source, reporter);
  if (reporter.has_errors()) return std::nullopt;
  const std::vector<Piece> pieces = lay_out(source, parsed.list, parsed.script);
  std::string result = join(Writer(pieces).write(), line_end_of(text));
  // The result has the same tokens by how it was made. That is too important not to be looked at.
  const lang::Source& again = sources.add(name, result);
  const Parsed reparsed = parse(sources, again, reporter);
  if (reporter.has_errors() || !same_pieces(pieces, lay_out(again, reparsed.list, reparsed.script)))
    return text;
  return result;
}

}  // namespace

Formatted format_script(std::string_view text, const std::string& name) {
  Formatted result;
  lang::SourceMap sources;
  lang::Reporter reporter(sources, ScriptLimits{}.errors);
  if (text.size() > ScriptLimits{}.source_bytes) {
    sources.add(name, {});
    result.diagnostics.push_back({.code = ErrorCode::limit,
                                  .message = "the script is too long to be formatted",
                                  .place = {.file = name}});
    return result;
  }
  try {
    result.text = format(std::string(text), name, sources, reporter);
  } catch (const lang::GiveUp&) {
    // Everything was reported already.
  }
  result.diagnostics = std::move(reporter.diagnostics());
  return result;
}

}  // namespace crt::format
