#include "core/mesh_files/ply_header.hpp"

#include <string>
#include <utility>

#include "core/base/text_numbers.hpp"
#include "core/mesh_files/refused_mesh.hpp"
#include "core/mesh_files/text_cursor.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

std::optional<PlyType> type_named(std::string_view word) {
  using enum PlyType;
  constexpr std::pair<std::string_view, PlyType> names[] = {
      {"char", int8},     {"int8", int8},       {"uchar", uint8},    {"uint8", uint8},
      {"short", int16},   {"int16", int16},     {"ushort", uint16},  {"uint16", uint16},
      {"int", int32},     {"int32", int32},     {"uint", uint32},    {"uint32", uint32},
      {"float", float32}, {"float32", float32}, {"double", float64}, {"float64", float64}};
  for (const auto& [name, type] : names) {
    if (name == word) return type;
  }
  return {};
}

PlyType read_type(TextCursor& cursor) {
  const std::string_view word = cursor.word_of_line();
  const std::optional<PlyType> type = type_named(word);
  if (!type) {
    refuse_line(cursor.line(), text::format("{} is no type of PLY files: they have char, uchar, "
                                            "short, ushort, int, uint, float and double",
                                            in_quotes(word)));
  }
  return *type;
}

PlyProperty read_property(TextCursor& cursor) {
  PlyProperty property;
  const std::string_view word = cursor.word_of_line();
  if (word == "list") {
    property.count_type = read_type(cursor);
  } else {
    cursor.put_back(word);
  }
  property.type = read_type(cursor);
  property.name = cursor.word_of_line();
  if (property.name.empty()) refuse_line(cursor.line(), "a property has no name");
  return property;
}

PlyElement read_element(TextCursor& cursor) {
  PlyElement element;
  element.name = cursor.word_of_line();
  const std::string_view word = cursor.word_of_line();
  const std::optional<std::int64_t> count = integer_of(word);
  if (!count || *count < 0) {
    refuse_line(cursor.line(),
                text::format("an element needs a name and a number of rows, and here "
                             "the number is {}",
                             in_quotes(word)));
  }
  element.count = static_cast<std::uint64_t>(*count);
  return element;
}

std::optional<std::endian> read_format(TextCursor& cursor) {
  const std::string_view format = cursor.word_of_line();
  const std::string_view version = cursor.word_of_line();
  if (version != "1.0") {
    refuse_line(cursor.line(),
                text::format("the version is {}; CRT reads version 1.0", in_quotes(version)));
  }
  if (format == "ascii") return {};
  if (format == "binary_little_endian") return std::endian::little;
  if (format == "binary_big_endian") return std::endian::big;
  refuse_line(cursor.line(), text::format("the format is {}; it should be ascii, "
                                          "binary_little_endian or binary_big_endian",
                                          in_quotes(format)));
}

}  // namespace

std::size_t size_of(PlyType type) {
  using enum PlyType;
  switch (type) {
    case int8:
    case uint8:
      return 1;
    case int16:
    case uint16:
      return 2;
    case int32:
    case uint32:
    case float32:
      return 4;
    case float64:
      break;
  }
  return 8;
}

bool is_ply(std::string_view content) {
  return content.starts_with("ply\n") || content.starts_with("ply\r");
}

PlyHeader read_ply_header(std::string_view content) {
  if (!is_ply(content)) refuse_line(1, "it does not begin with a line 'ply'");
  TextCursor cursor(content);
  PlyHeader header;
  bool has_format = false;
  cursor.next_line();
  for (;; cursor.next_line()) {
    const std::string_view word = cursor.word();
    if (word == "end_header") break;
    if (word == "format") {
      header.binary = read_format(cursor);
      has_format = true;
    } else if (word == "element") {
      header.elements.push_back(read_element(cursor));
    } else if (word == "property") {
      if (header.elements.empty())
        refuse_line(cursor.line(), "a property stands before the first element");
      header.elements.back().properties.push_back(read_property(cursor));
    } else if (word.empty()) {
      refuse_line(cursor.line(), "the header has no end: there is no line 'end_header'");
    } else if (word != "comment" && word != "obj_info") {
      refuse_line(cursor.line(), text::format("a line of the header begins with {}; it should be "
                                              "format, element, property or comment",
                                              in_quotes(word)));
    }
  }
  if (!has_format) refuse_line(cursor.line(), "the header has no line 'format'");
  // Numbers follow at once, and may look like ends of lines. So this one is as the first of all.
  header.lines = cursor.line();
  const std::string_view rest = cursor.rest();
  const std::size_t line_end = content.starts_with("ply\r\n") ? 2 : 1;
  const std::size_t blanks = std::min(rest.find_first_of("\r\n"), rest.size());
  header.size = cursor.place() + std::min(blanks + line_end, rest.size());
  return header;
}

}  // namespace crt::core
