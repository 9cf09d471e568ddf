// Reads OBJ files: Wavefront, Advanced Visualizer manual, appendix B1 (object files).
#include "core/mesh_files/obj.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/text_numbers.hpp"
#include "core/mesh_files/mtl.hpp"
#include "core/mesh_files/readers.hpp"
#include "core/mesh_files/refused_mesh.hpp"
#include "core/mesh_files/text_cursor.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

template <std::size_t count>
bool is_one_of(const std::array<std::string_view, count>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// A Counted is a kind of lines that corners of faces name by number.
struct Counted {
  const char* name;
  std::size_t count;  ///< before this line
};

/// Returns the place of the line that the number names, such as 7, or -2 back from here.
std::uint32_t place_of(std::string_view number, const Counted& kind, std::string_view corner,
                       const TextCursor& cursor) {
  const std::optional<std::int64_t> index = integer_of(number);
  const bool is_clean = number.find_first_not_of("0123456789+-") == std::string_view::npos;
  if (!index || !is_clean) {
    refuse_line(
        cursor.line(),
        text::format("a corner is {}; it should be the number of a vertex, as in 7 or 7/1/3",
                     in_quotes(corner)));
  }
  if (*index == 0) {
    refuse_line(cursor.line(),
                text::format("there is no {} 0: they count from 1, or -1 back", kind.name));
  }
  const auto known = static_cast<std::int64_t>(kind.count);
  if (*index > known || *index < -known) {
    refuse_line(cursor.line(), text::format("there is no {} {}: {} {} before this line", kind.name,
                                            *index, known, known == 1 ? "is" : "are"));
  }
  return static_cast<std::uint32_t>(*index > 0 ? *index - 1 : known + *index);
}

/// Takes what is before the next '/' away from a corner.
std::string_view next_number(std::string_view& corner) {
  const std::size_t end = std::min(corner.find('/'), corner.size());
  const std::string_view number = corner.substr(0, end);
  corner.remove_prefix(std::min(end + 1, corner.size()));
  return number;
}

/// An ObjReader reads a file line by line.
class ObjReader {
 public:
  ObjReader(std::string_view content, MeshBuilder& mesh)
      : cursor_(content, {.comments = true, .continuations = true}),
        mesh_(mesh),
        materials_(mesh) {}

  void read() {
    for (; !cursor_.at_end(); cursor_.next_line()) read_line();
    materials_.finish();
  }

 private:
  void read_line();
  void read_face();
  void read_corner(std::string_view corner);
  void read_normal();
  void read_uv();

  /// Returns the rest of a line as one name, which may have blanks.
  std::string_view name_of_line() const {
    const std::string_view rest = cursor_.rest();
    const std::string_view line = rest.substr(0, rest.find_first_of("\r\n"));
    const std::size_t begin = std::min(line.find_first_not_of(" \t"), line.size());
    return line.substr(begin, line.find_last_not_of(" \t") + 1 - begin);
  }
  /// Returns the next number of the line. Throws RefusedMesh if it is none or too large.
  double component(const char* of, double most);

  TextCursor cursor_;
  MeshBuilder& mesh_;
  MtlLibraries materials_;
  // These are the corners of a face, whose lists are empty if no corner names any.
  std::vector<std::uint32_t> corners_;
  std::vector<std::uint32_t> uv_;
  std::vector<std::uint32_t> normals_;
  bool has_uv_ = false;
  bool has_normals_ = false;
};

void ObjReader::read_corner(std::string_view corner) {
  std::string_view rest = corner;
  const std::string_view position = next_number(rest);
  const std::string_view uv = next_number(rest);
  const std::string_view normal = next_number(rest);
  const auto place = [&](std::string_view number, const Counted& kind) {
    return place_of(number, kind, corner, cursor_);
  };
  corners_.push_back(place(position, {"vertex", mesh_.position_count()}));
  uv_.push_back(uv.empty() ? no_index : place(uv, {"texture coordinate", mesh_.uv_count()}));
  normals_.push_back(normal.empty() ? no_index : place(normal, {"normal", mesh_.normal_count()}));
  has_uv_ = has_uv_ || !uv.empty();
  has_normals_ = has_normals_ || !normal.empty();
}

void ObjReader::read_face() {
  corners_.clear();
  uv_.clear();
  normals_.clear();
  has_uv_ = has_normals_ = false;
  const std::size_t line = cursor_.line();
  for (std::string_view corner = cursor_.word_of_line(); !corner.empty();
       corner = cursor_.word_of_line())
    read_corner(corner);
  if (corners_.size() < 3) {
    refuse_line(line, text::format("a face needs at least three corners, and here {} {}",
                                   corners_.size() == 1 ? "is" : "are", corners_.size()));
  }
  FaceCorners face{.positions = corners_};
  if (has_uv_) face.uv = uv_;
  if (has_normals_) face.normals = normals_;
  mesh_.add_face(face);
}

double ObjReader::component(const char* of, double most) {
  const std::string_view text = cursor_.word_of_line();
  const std::optional<double> value = number_of(text);
  if (value && std::abs(*value) <= most) return *value;
  refuse_line(cursor_.line(), text::format("{} has {}; it should be a number of at most {:g} in "
                                           "magnitude",
                                           of, in_quotes(text), most));
}

void ObjReader::read_normal() {
  Vec3 normal{};
  for (int axis = 0; axis < 3; ++axis) normal[axis] = component("a normal", largest_normal);
  mesh_.add_normal(normal);
}

void ObjReader::read_uv() {
  const double u = component("a texture coordinate", largest_uv);
  // The second number is 0 if it is left out, and the third is for textures in space.
  const std::string_view second = cursor_.word_of_line();
  if (!second.empty()) cursor_.put_back(second);
  mesh_.add_uv(u, second.empty() ? 0 : component("a texture coordinate", largest_uv));
}

void ObjReader::read_line() {
  const std::string_view word = cursor_.word_of_line();
  switch (obj_statement(word)) {
    case ObjStatement::vertex:
      mesh_.add_position(cursor_.position_of_line());
      break;
    case ObjStatement::face:
      read_face();
      break;
    case ObjStatement::normal:
      read_normal();
      break;
    case ObjStatement::uv:
      read_uv();
      break;
    case ObjStatement::material:
      mesh_.set_material(materials_.number_of(name_of_line(), cursor_.line()));
      break;
    case ObjStatement::library:
      materials_.add_libraries(name_of_line(), cursor_.line());
      break;
    case ObjStatement::other:
      break;
    case ObjStatement::curved:
      refuse_line(cursor_.line(), text::format("{} makes a curve or a curved surface; CRT reads "
                                               "faces alone",
                                               in_quotes(word)));
    case ObjStatement::unknown:
      refuse_line(cursor_.line(),
                  text::format("a line begins with {}, which is no statement of OBJ files",
                               in_quotes(word)));
  }
}

}  // namespace

ObjStatement obj_statement(std::string_view word) {
  constexpr std::array<std::string_view, 33> others = {
      "vp",         "vc",        "g",     "s",     "mg",       "o",    "usemap",
      "maplib",     "p",         "l",     "bevel", "c_interp", "lod",  "d_interp",
      "shadow_obj", "trace_obj", "ctech", "stech", "deg",      "bmat", "step",
      "cstype",     "call",      "csh",   "parm",  "trim",     "hole", "scrv",
      "sp",         "end",       "con",   "res",   "cdc"};
  constexpr std::array<std::string_view, 6> curved = {"curv", "curv2", "surf", "bzp", "bsp", "cdp"};
  if (word == "v") return ObjStatement::vertex;
  if (word == "vn") return ObjStatement::normal;
  if (word == "vt") return ObjStatement::uv;
  if (word == "usemtl") return ObjStatement::material;
  if (word == "mtllib") return ObjStatement::library;
  if (word == "f" || word == "fo") return ObjStatement::face;
  if (is_one_of(curved, word)) return ObjStatement::curved;
  return is_one_of(others, word) ? ObjStatement::other : ObjStatement::unknown;
}

void read_obj(std::string_view content, MeshBuilder& mesh) {
  ObjReader(content, mesh).read();
}

}  // namespace crt::core
