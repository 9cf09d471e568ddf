// Reads OBJ files: Wavefront, Advanced Visualizer manual, appendix B1 (object files).
#include "core/mesh_files/obj.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/mesh_files/readers.hpp"
#include "core/mesh_files/refused_mesh.hpp"
#include "core/mesh_files/text_cursor.hpp"
#include "core/mesh_files/text_numbers.hpp"

namespace crt::core {

namespace {

template <std::size_t count>
bool is_one_of(const std::array<std::string_view, count>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Returns the place of the vertex that a corner such as "7/1/3" or "-2//5" names.
std::uint32_t vertex_of(std::string_view corner, const TextCursor& cursor, std::size_t count) {
  const std::optional<std::int64_t> index = integer_of(corner.substr(0, corner.find('/')));
  const bool is_clean = corner.find_first_not_of("0123456789+-/") == std::string_view::npos;
  if (!index || !is_clean) {
    refuse_line(cursor.line(),
                fmt::format("a corner is {}; it should be the number of a vertex, as in 7 or 7/1/3",
                            in_quotes(corner)));
  }
  if (*index == 0)
    refuse_line(cursor.line(), "there is no vertex 0: they count from 1, or -1 back");
  const auto known = static_cast<std::int64_t>(count);
  if (*index > known || *index < -known) {
    refuse_line(cursor.line(), fmt::format("there is no vertex {}: {} {} before this line", *index,
                                           known, known == 1 ? "is" : "are"));
  }
  return static_cast<std::uint32_t>(*index > 0 ? *index - 1 : known + *index);
}

void read_face(TextCursor& cursor, MeshBuilder& mesh, std::vector<std::uint32_t>& corners) {
  corners.clear();
  const std::size_t line = cursor.line();
  for (std::string_view corner = cursor.word_of_line(); !corner.empty();
       corner = cursor.word_of_line())
    corners.push_back(vertex_of(corner, cursor, mesh.position_count()));
  if (corners.size() < 3) {
    refuse_line(line, fmt::format("a face needs at least three corners, and here {} {}",
                                  corners.size() == 1 ? "is" : "are", corners.size()));
  }
  mesh.add_face(corners);
}

}  // namespace

ObjStatement obj_statement(std::string_view word) {
  constexpr std::array<std::string_view, 37> others = {
      "vt",     "vn",       "vp",         "vc",        "g",     "s",     "mg",    "o",
      "usemtl", "mtllib",   "usemap",     "maplib",    "p",     "l",     "bevel", "c_interp",
      "lod",    "d_interp", "shadow_obj", "trace_obj", "ctech", "stech", "deg",   "bmat",
      "step",   "cstype",   "call",       "csh",       "parm",  "trim",  "hole",  "scrv",
      "sp",     "end",      "con",        "res",       "cdc"};
  constexpr std::array<std::string_view, 6> curved = {"curv", "curv2", "surf", "bzp", "bsp", "cdp"};
  if (word == "v") return ObjStatement::vertex;
  if (word == "f" || word == "fo") return ObjStatement::face;
  if (is_one_of(curved, word)) return ObjStatement::curved;
  return is_one_of(others, word) ? ObjStatement::other : ObjStatement::unknown;
}

void read_obj(std::string_view content, MeshBuilder& mesh) {
  TextCursor cursor(content, {.comments = true, .continuations = true});
  std::vector<std::uint32_t> corners;
  for (; !cursor.at_end(); cursor.next_line()) {
    const std::string_view word = cursor.word_of_line();
    switch (obj_statement(word)) {
      case ObjStatement::vertex:
        mesh.add_position(cursor.position_of_line());
        break;
      case ObjStatement::face:
        read_face(cursor, mesh, corners);
        break;
      case ObjStatement::other:
        break;
      case ObjStatement::curved:
        refuse_line(cursor.line(), fmt::format("{} makes a curve or a curved surface; CRT reads "
                                               "faces alone",
                                               in_quotes(word)));
      case ObjStatement::unknown:
        refuse_line(cursor.line(),
                    fmt::format("a line begins with {}, which is no statement of OBJ files",
                                in_quotes(word)));
    }
  }
}

}  // namespace crt::core
