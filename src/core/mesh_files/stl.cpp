// Reads STL files: 3D Systems, StereoLithography interface specification (1989).
#include "core/mesh_files/stl.hpp"

#include <algorithm>
#include <array>

#include "core/mesh_files/binary_numbers.hpp"
#include "core/mesh_files/readers.hpp"
#include "core/mesh_files/refused_mesh.hpp"
#include "core/mesh_files/text_cursor.hpp"
#include "text/format.hpp"
#include "text/letters.hpp"

namespace crt::core {

namespace {

/// Compares with a word in lower case.
bool is_word(std::string_view word, std::string_view lower) {
  return std::equal(word.begin(), word.end(), lower.begin(), lower.end(),
                    [](char c, char wanted) { return text::small_letter(c) == wanted; });
}

std::uint32_t claimed_triangles(std::string_view content) {
  return number_at<std::uint32_t>(content, stl_header_size);
}

[[noreturn]] void refuse_word(const TextCursor& cursor, std::string_view word, const char* wanted) {
  refuse_line(cursor.line(), word.empty() ? text::format("the file ends where {} should be", wanted)
                                          : text::format("here is {} where {} should be",
                                                         in_quotes(word), wanted));
}

void expect(TextCursor& cursor, const char* wanted) {
  const std::string_view word = cursor.word();
  if (!is_word(word, wanted)) refuse_word(cursor, word, wanted);
}

/// Adds a face whose corners are the last three positions.
void add_last_face(MeshBuilder& mesh) {
  const auto count = static_cast<std::uint32_t>(mesh.position_count());
  mesh.add_face(std::array{count - 3, count - 2, count - 1});
}

/// Reads what follows the word "facet".
void read_facet(TextCursor& cursor, MeshBuilder& mesh) {
  std::string_view word = cursor.word();
  if (is_word(word, "normal")) {
    // It follows from the vertices, and is no number in many files.
    for (int axis = 0; axis < 3; ++axis) word = cursor.word();
    word = cursor.word();
  }
  if (!is_word(word, "outer")) refuse_word(cursor, word, "outer loop");
  expect(cursor, "loop");
  for (int corner = 0; corner < 3; ++corner) {
    expect(cursor, "vertex");
    Vec3 position{};
    for (int axis = 0; axis < 3; ++axis) {
      position[axis] = cursor.number("a coordinate");
      if (const char* const fault = coordinate_fault(position[axis]))
        refuse_line(cursor.line(), text::format("a coordinate {}", fault));
    }
    mesh.add_position(position);
  }
  add_last_face(mesh);
  expect(cursor, "endloop");
  expect(cursor, "endfacet");
}

void read_text(std::string_view content, MeshBuilder& mesh) {
  TextCursor cursor(content);
  for (bool is_first = true; !cursor.at_end(); is_first = false) {
    const std::string_view begin = cursor.word();
    if (!is_first && !is_word(begin, "solid")) {
      mesh.warn(
          text::format("line {}: here is {} where solid or the end should be: it is left out, "
                       "with all that follows",
                       cursor.line(), in_quotes(begin)));
      return;
    }
    if (!is_word(begin, "solid")) refuse_word(cursor, begin, "solid");
    cursor.next_line();  // past the name
    for (;;) {
      const std::string_view word = cursor.word();
      if (is_word(word, "endsolid")) break;
      if (!is_word(word, "facet")) refuse_word(cursor, word, "facet or endsolid");
      read_facet(cursor, mesh);
    }
    cursor.next_line();
  }
}

/// Returns how many triangles to read. A count of 0 or of 2^32 - 1 says nothing. Otherwise, if
/// there are whole triangles and nothing behind them, the count is wrong, and so it is if the file
/// is cut off. With something else behind the triangles the count is right.
std::size_t triangle_count(std::string_view content, MeshBuilder& mesh) {
  const std::size_t size = content.size() - stl_begin_size;
  const std::size_t places = size / stl_triangle_size;
  if (has_size_of_binary_stl(content)) return places;
  const std::uint64_t claimed = claimed_triangles(content);
  const bool is_whole = size % stl_triangle_size == 0;
  const std::string fault = text::format(
      "the file says that it has {} triangles, which take {} bytes; but it has {} bytes, which are "
      "{} triangles{}",
      claimed, stl_begin_size + claimed * stl_triangle_size, content.size(), places,
      is_whole ? "" : " and a part of one");
  const bool says_nothing = claimed == 0 || claimed == 0xffffffff;
  // What has less than half of what it says is more likely no STL file at all.
  if (!says_nothing && claimed > 2 * places) refuse_byte(stl_header_size, fault);
  const std::size_t read =
      is_whole ? places : std::min<std::size_t>(says_nothing ? places : claimed, places);
  mesh.warn(text::format("byte {}: {}: it is read as {}", stl_header_size, fault, read));
  return read;
}

void read_binary(std::string_view content, MeshBuilder& mesh) {
  if (content.size() < stl_begin_size) {
    throw RefusedMesh(text::format(
        "it has {} bytes; a binary STL file begins with a header of {}, and text with 'solid'",
        content.size(), stl_begin_size));
  }
  const std::size_t count = triangle_count(content, mesh);
  for (std::size_t i = 0; i < count; ++i) {
    // Each triangle begins with its normal.
    std::size_t place = stl_begin_size + i * stl_triangle_size + 3 * sizeof(float);
    for (int corner = 0; corner < 3; ++corner) {
      Vec3 position{};
      for (int axis = 0; axis < 3; ++axis, place += sizeof(float)) {
        position[axis] = static_cast<double>(number_at<float>(content, place));
        if (const char* const fault = coordinate_fault(position[axis]))
          refuse_byte(place, text::format("a coordinate of triangle {} {}", i, fault));
      }
      mesh.add_position(position);
    }
    add_last_face(mesh);
  }
}

}  // namespace

bool has_size_of_binary_stl(std::string_view content) {
  return content.size() >= stl_begin_size &&
         content.size() ==
             stl_begin_size + std::uint64_t{claimed_triangles(content)} * stl_triangle_size;
}

bool is_text_stl(std::string_view content) {
  TextCursor cursor(content);
  if (!is_word(cursor.word(), "solid")) return false;
  cursor.next_line();
  const std::string_view word = cursor.word();
  return is_word(word, "facet") || is_word(word, "endsolid") || word.empty();
}

void read_stl(std::string_view content, MeshBuilder& mesh) {
  if (!has_size_of_binary_stl(content) && is_text_stl(content)) {
    read_text(content, mesh);
  } else {
    read_binary(content, mesh);
  }
}

}  // namespace crt::core
