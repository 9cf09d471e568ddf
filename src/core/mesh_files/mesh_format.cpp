#include "core/mesh_files/mesh_format.hpp"

#include "core/mesh_files/obj.hpp"
#include "core/mesh_files/off.hpp"
#include "core/mesh_files/ply_header.hpp"
#include "core/mesh_files/stl.hpp"
#include "core/mesh_files/text_cursor.hpp"
#include "text/letters.hpp"

namespace crt::core {

namespace {

/// OBJ files have no mark. They begin with comments and statements.
bool is_obj(std::string_view content) {
  TextCursor cursor(content, {.comments = true, .continuations = true});
  const std::string_view word = cursor.word();
  return !word.empty() && obj_statement(word) != ObjStatement::unknown;
}

bool is_off(std::string_view content) {
  TextCursor cursor(content, {.comments = true});
  cursor.at_end();
  return off_word_length(cursor.rest()).has_value();
}

std::optional<MeshFormat> format_of_ending(const std::string& name) {
  const std::string ending =
      text::in_small_letters(name.substr(std::min(name.rfind('.'), name.size())));
  if (ending == ".obj") return MeshFormat::obj;
  if (ending == ".ply") return MeshFormat::ply;
  if (ending == ".stl") return MeshFormat::stl;
  if (ending == ".off") return MeshFormat::off;
  if (ending == ".3mf") return MeshFormat::three_mf;
  return {};
}

}  // namespace

std::optional<MeshFormat> mesh_format(std::string_view content, const std::string& name) {
  if (is_ply(content)) return MeshFormat::ply;
  if (content.starts_with("PK\x03\x04")) return MeshFormat::three_mf;
  if (has_size_of_binary_stl(content) || is_text_stl(content)) return MeshFormat::stl;
  if (is_off(content)) return MeshFormat::off;
  if (is_obj(content)) return MeshFormat::obj;
  return format_of_ending(name);
}

}  // namespace crt::core
