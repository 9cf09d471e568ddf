// Writes Wavefront OBJ files: an object and group for each part.
#include "core/mesh_files/surface_writers.hpp"

namespace crt::core {

namespace {

/// Returns a name as a word of OBJ: a backslash would go on in the next line.
std::string obj_name(const std::string& name) {
  std::string word = name;
  for (char& letter : word)
    if (letter == '\\' || letter == '#' || letter == ' ') letter = '_';
  return word;
}

}  // namespace

std::string obj_bytes(const SurfaceFile& file) {
  std::string text = "# CRT, " + deviation_text(file) + "\n";
  std::uint64_t first = 1;  // the corners of all parts count from there
  for (const SurfacePart& part : file.parts) {
    const std::string name = obj_name(part.name);
    for (const char* const keyword : {"o ", "g "}) {
      text += keyword;
      text += name;
      text += '\n';
    }
    for (const Vec3& position : part.mesh->positions) {
      text += 'v';
      for (int axis = 0; axis < 3; ++axis) {
        text += ' ';
        append_number(text, position[axis]);
      }
      text += '\n';
    }
    for (const auto& corners : part.mesh->triangles) {
      text += 'f';
      for (const std::uint32_t corner : corners) {
        text += ' ';
        append_number(text, first + corner);
      }
      text += '\n';
    }
    first += part.mesh->positions.size();
  }
  return text;
}

}  // namespace crt::core
