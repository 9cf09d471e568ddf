// Writes the OBJ files of scripts, and the libraries of their materials (MTL).
#include "crt/error.hpp"
#include "source/mesh_parts.hpp"
#include "source/values.hpp"
#include "text/format.hpp"

namespace crt::source {

namespace {

std::string numbers_line(const char* word, std::span<const double> numbers) {
  std::string line = word;
  for (const double number : numbers) line += " " + Syntax::number(number);
  return line + "\n";
}

[[noreturn]] void refuse_material(const char* what) {
  throw Error(ErrorCode::unsupported,
              text::format("a mesh has materials of its own with {}, which its file cannot have: "
                           "give the whole mesh one material",
                           what));
}

/// Refuses materials that are more than what a library says of them.
void check_material(const SharedMaterial& shared) {
  if (shared.principled() != nullptr) refuse_material("what principled ones have");
  const Material& material = *shared;
  const Material usual;
  if (material.reflectivity != usual.reflectivity) refuse_material("reflectivity");
  if (material.diffuse) refuse_material("diffuse");
  if (material.absorption != usual.absorption) refuse_material("absorption");
  if (material.bump) refuse_material("bumps");
  if (material.emission != usual.emission) refuse_material("light that they give off");
  if (material.specular != 0 && !(material.shininess > 0)) refuse_material("a shininess of 0");
  if (const auto* color = std::get_if<Color>(&material.color)) {
    if (color->a != 1) refuse_material("an alpha");
    return;
  }
  const auto* map = std::get_if<ImageMap>(&std::get<Pattern>(material.color));
  if (map == nullptr || map->mapping != ImageMapping::uv) refuse_material("a pattern");
}

/// Returns the definition of a material.
std::string definition_of(Program& program, const SharedMaterial& shared) {
  check_material(shared);
  const Material& material = *shared;
  std::string text;
  if (const auto* color = std::get_if<Color>(&material.color)) {
    text += numbers_line("Kd", std::array{color->r, color->g, color->b});
  } else {
    const auto& map = std::get<ImageMap>(std::get<Pattern>(material.color));
    text += text::format("map_Kd -s {} {} {}\n", map.repeat_u, map.repeat_v,
                         image_file_name(program, *map.image));
  }
  const double specular = material.specular;
  if (specular != 0) {
    text += numbers_line("Ks", std::array{specular, specular, specular});
    text += numbers_line("Ns", std::array{material.shininess});
  }
  text += numbers_line("Tr", std::array{material.transparency});
  return text + numbers_line("Ni", std::array{material.refractive_index});
}

std::string library_of(Program& program, std::span<const SharedMaterial> materials) {
  std::string text;
  for (std::size_t i = 0; i < materials.size(); ++i)
    text += text::format("newmtl material_{}\n{}", i, definition_of(program, materials[i]));
  return text;
}

/// Returns the number of a corner's normal or (u, v) as OBJ files have it: from 1 on, or nothing.
std::string number_at(const std::vector<TriangleIndices>& indices, std::size_t triangle,
                      std::size_t corner) {
  if (indices.empty() || indices[triangle][corner] == no_index) return "";
  return std::to_string(std::uint64_t{indices[triangle][corner]} + 1);
}

std::string face_line(const MeshParts& parts, std::size_t triangle) {
  const MeshAttributes& attributes = parts.attributes;
  std::string line = "f";
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const std::string uv = number_at(attributes.uv_indices, triangle, corner);
    const std::string normal = number_at(attributes.normal_indices, triangle, corner);
    line += text::format(" {}", std::uint64_t{parts.triangles[triangle][corner]} + 1);
    if (!uv.empty() || !normal.empty()) line += "/" + uv;
    if (!normal.empty()) line += "/" + normal;
  }
  return line + "\n";
}

std::string faces_of(const MeshParts& parts) {
  const MeshAttributes& attributes = parts.attributes;
  // A file that has named a material cannot take it back. The unknown one is grey, as none is.
  std::uint32_t current = no_index;
  std::string text;
  for (std::size_t i = 0; i < parts.triangles.size(); ++i) {
    if (!attributes.materials.empty() && attributes.material_of_triangle[i] != current) {
      current = attributes.material_of_triangle[i];
      text += current == no_index ? "usemtl\n" : text::format("usemtl material_{}\n", current);
    }
    text += face_line(parts, i);
  }
  return text;
}

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text));
}

}  // namespace

std::string obj_file_name(Program& program, const MeshParts& parts) {
  const MeshAttributes& attributes = parts.attributes;
  std::string text;
  if (!attributes.materials.empty()) {
    const std::string library = library_of(program, attributes.materials);
    text += text::format("mtllib {}\n", program.add_file(bytes_of(library), "mtl"));
  }
  for (const Vec3& v : parts.positions) text += numbers_line("v", std::array{v.x, v.y, v.z});
  for (const Vec3& n : attributes.normals) text += numbers_line("vn", std::array{n.x, n.y, n.z});
  for (const auto& uv : attributes.uv) text += numbers_line("vt", uv);
  text += faces_of(parts);
  return program.syntax().text(program.add_file(bytes_of(text), "obj"));
}

}  // namespace crt::source
