// Reads OFF files: Geomview manual, section 4.2.5 (OFF). Their first word may be missing.
#include "core/mesh_files/off.hpp"

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/text_numbers.hpp"
#include "core/mesh_files/readers.hpp"
#include "core/mesh_files/refused_mesh.hpp"
#include "core/mesh_files/text_cursor.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

struct Counts {
  std::int64_t vertices = 0;
  std::int64_t faces = 0;
};

Counts read_counts(TextCursor& cursor) {
  Counts counts;
  counts.vertices = cursor.integer("the number of vertices");
  counts.faces = cursor.integer("the number of faces");
  if (counts.vertices < 0 || counts.faces < 0)
    refuse_line(cursor.line(), "a number of vertices or faces is negative");
  // The third is that of edges, which nothing needs. Some files do without it.
  cursor.next_line();
  return counts;
}

void read_off_face(TextCursor& cursor, MeshBuilder& mesh, std::vector<std::uint32_t>& corners) {
  const std::int64_t count = cursor.integer("the number of a face's corners");
  const std::size_t line = cursor.line();
  if (count < 3)
    refuse_line(line,
                text::format("a face needs at least three corners, and here it is {}", count));
  corners.clear();
  for (std::int64_t i = 0; i < count; ++i) {
    const std::string_view word = cursor.word_of_line();
    if (word.empty())
      refuse_line(line, text::format("a face has {} corners, and the line only {}", count, i));
    const std::optional<std::int64_t> index = integer_of(word);
    const auto vertices = static_cast<std::int64_t>(mesh.position_count());
    if (!index || *index < 0 || *index >= vertices) {
      refuse_line(line, text::format("a corner is {}; it should be between 0 and {}",
                                     in_quotes(word), vertices - 1));
    }
    corners.push_back(static_cast<std::uint32_t>(*index));
  }
  mesh.add_face(corners);
}

/// Reads what follows the word OFF.
void read_elements(TextCursor& cursor, MeshBuilder& mesh) {
  const Counts counts = read_counts(cursor);
  for (std::int64_t i = 0; i < counts.vertices; ++i) {
    if (cursor.at_end()) {
      refuse_line(cursor.line(),
                  text::format("the file ends after {} of {} vertices", i, counts.vertices));
    }
    mesh.add_position(cursor.position_of_line());
    cursor.next_line();  // past the vertex's normal, colour or texture coordinates
  }
  std::vector<std::uint32_t> corners;
  for (std::int64_t i = 0; i < counts.faces; ++i) {
    if (cursor.at_end())
      refuse_line(cursor.line(),
                  text::format("the file ends after {} of {} faces", i, counts.faces));
    read_off_face(cursor, mesh, corners);
    cursor.next_line();  // past its colour
  }
  if (!cursor.at_end()) {
    refuse_line(cursor.line(),
                text::format("there is more than the {} vertices and {} faces that the file begins "
                             "with",
                             counts.vertices, counts.faces));
  }
}

}  // namespace

std::optional<std::size_t> off_word_length(std::string_view text) {
  std::size_t place = 0;
  for (const std::string_view part : {"ST", "C", "N", "4", "n"}) {
    if (text.substr(place).starts_with(part)) place += part.size();
  }
  constexpr std::string_view name = "OFF";
  if (!text.substr(place).starts_with(name)) return {};
  place += name.size();
  const bool ends =
      place == text.size() ||
      std::string_view(" \t\r\n#0123456789").find(text[place]) != std::string_view::npos;
  return ends ? std::optional(place) : std::nullopt;
}

void read_off(std::string_view content, MeshBuilder& mesh) {
  TextCursor cursor(content, {.comments = true});
  cursor.at_end();
  const std::optional<std::size_t> length = off_word_length(cursor.rest());
  if (!length) {
    const std::string_view first = cursor.word();
    if (!integer_of(first)) refuse_line(cursor.line(), "it does not begin with the word OFF");
    mesh.warn(text::format("line {}: it does not begin with the word OFF, but is read as if it did",
                           cursor.line()));
    cursor.put_back(first);
    read_elements(cursor, mesh);
    return;
  }
  const std::string_view word = cursor.rest().substr(0, *length);
  if (word.find_first_of("4n") != std::string_view::npos) {
    refuse_line(cursor.line(), text::format("{} has vertices of other than three coordinates; CRT "
                                            "reads OFF, with C, N and ST before it",
                                            in_quotes(word)));
  }
  cursor.skip(*length);
  if (const std::string_view mode = cursor.word_of_line(); mode == "BINARY") {
    refuse_line(cursor.line(), "it is a binary OFF file; CRT reads those that are text");
  } else if (!mode.empty()) {
    cursor.put_back(mode);  // the counts are on the line of the word
  }
  read_elements(cursor, mesh);
}

}  // namespace crt::core
