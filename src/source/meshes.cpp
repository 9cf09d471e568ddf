// Meshes are written as the triangles and attributes that make them again.
#include <array>
#include <cmath>
#include <limits>

#include "core/geometry/mesh/facet_attributes.hpp"
#include "core/geometry/mesh/triangles.hpp"
#include "crt/error.hpp"
#include "crt/mesh_file.hpp"
#include "source/mesh_parts.hpp"
#include "source/shapes.hpp"
#include "source/values.hpp"
#include "text/format.hpp"

namespace crt::source {

namespace {

using core::FacetAttributes;

/// Returns a vector whose direction rounds to the floats that are given. They are those of a unit
/// vector, each rounded. Of all ways back to unit length, the one that uses the same share of every
/// rounding surely does not use more of them than there is.
Vec3 direction_that_rounds_to(const std::array<float, 4>& rounded) {
  const Vec3 v(rounded[0], rounded[1], rounded[2]);
  if (v == Vec3(0)) return v;
  const double excess = (v.x * v.x + v.y * v.y + v.z * v.z - 1) / 2;
  Vec3 half_step(0);
  double whole = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float size = std::abs(rounded[static_cast<std::size_t>(axis)]);
    const float next = std::nextafter(size, std::numeric_limits<float>::infinity());
    half_step[axis] = (double{next} - double{size}) / 2;
    whole += double{size} * half_step[axis];
  }
  Vec3 result = v;
  for (int axis = 0; axis < 3; ++axis)
    result[axis] -= std::copysign(half_step[axis], v[axis]) * excess / whole;
  return result;
}

MeshParts parts_of(const MeshTriangles& mesh) {
  MeshParts parts;
  parts.fill = mesh.report().fill;
  for (std::uint32_t i = 0; i < mesh.size(); ++i) {
    const TriangleIndices& corners = mesh.corners(i);
    const auto [a, b, c, material] = mesh.triangle(i);
    const Vec3 places[] = {a, b, c};
    for (std::size_t k = 0; k < corners.size(); ++k) {
      if (corners[k] >= parts.positions.size()) parts.positions.resize(corners[k] + 1, a);
      parts.positions[corners[k]] = places[k];
    }
    parts.triangles.push_back(corners);
  }
  const FacetAttributes* attributes = mesh.attributes();
  if (attributes == nullptr) return parts;
  MeshAttributes& given = parts.attributes;
  if (attributes->has_normals()) {
    for (const auto& normal : attributes->normals().values)
      given.normals.push_back(direction_that_rounds_to(normal));
    given.normal_indices = attributes->normals().of_facets;
  }
  if (attributes->has_uv()) {
    for (const auto& [u, v] : attributes->uv().values) given.uv.push_back({u, v});
    given.uv_indices = attributes->uv().of_facets;
  }
  if (attributes->has_materials()) {
    given.materials.assign(attributes->materials().begin(), attributes->materials().end());
    for (std::uint32_t i = 0; i < mesh.size(); ++i)
      given.material_of_triangle.push_back(attributes->material(i) - 1);
  }
  return parts;
}

/// Refuses a mesh that would be another one if it were made again.
void check_parts(const MeshParts& parts, const MeshTriangles& mesh) {
  const auto again =
      mesh_triangles(parts.positions, parts.triangles, parts.attributes, {.fill = parts.fill});
  if (again->size() == mesh.size() && again->is_closed() == mesh.is_closed() &&
      again->is_oriented() == mesh.is_oriented())
    return;
  throw Error(ErrorCode::unsupported,
              "a mesh that is closed by triangles without area cannot be written as source code: "
              "load it from its file");
}

/// Writes rows of numbers, each as a list of its own but in C.
template <class Rows>
std::vector<std::string> row_items(const Syntax& syntax, const Rows& rows) {
  std::vector<std::string> items;
  for (const auto& row : rows) {
    std::vector<std::string> numbers;
    if constexpr (requires { row.x; }) {
      numbers = number_items(std::array<double, 3>{row.x, row.y, row.z});
    } else {
      for (const auto number : row) numbers.push_back(text::format("{}", number));
    }
    if (syntax.is_c()) {
      items.insert(items.end(), numbers.begin(), numbers.end());
    } else {
      items.push_back(syntax.list(numbers));
    }
  }
  return items;
}

/// A MeshWriter makes arrays of the parts, and names them as fields.
class MeshWriter {
 public:
  MeshWriter(Program& program, const MeshParts& parts)
      : program_(program), parts_(parts), fields_(program.syntax()) {}

  std::string write() {
    const MeshAttributes& attributes = parts_.attributes;
    const std::string positions = rows("positions", "Vec3", "double", parts_.positions);
    const std::string triangles =
        rows("triangles", "TriangleIndices", "uint32_t", parts_.triangles);
    add_rows("normals", "Vec3", "double", attributes.normals);
    add_rows("normal_indices", "TriangleIndices", "uint32_t", attributes.normal_indices);
    add_rows("uv", "std::array<double, 2>", "double", attributes.uv);
    add_rows("uv_indices", "TriangleIndices", "uint32_t", attributes.uv_indices);
    add_materials();
    const Syntax& syntax = program_.syntax();
    const bool is_nonzero = parts_.fill == FillRule::nonzero;
    if (syntax.is_cpp()) {
      const std::string all = fields_.all().empty() ? "" : fields_.constructed("MeshAttributes");
      if (is_nonzero) {
        return program_.define(
            "mesh", "auto",
            text::format("mesh_triangles({}, {},\n      {},\n      MeshOptions{{.fill = "
                         "FillRule::nonzero}})",
                         positions, triangles, all.empty() ? "MeshAttributes{}" : all));
      }
      return program_.define(
          "mesh", "auto",
          all.empty()
              ? text::format("mesh_triangles({}, {})", positions, triangles)
              : text::format("mesh_triangles({}, {},\n      {})", positions, triangles, all));
    }
    Fields all(syntax);
    all.add_text("", "positions", positions);
    all.add_text("", syntax.is_c() ? "vertex_count" : "", std::to_string(parts_.positions.size()));
    all.add_text("", "indices", triangles);
    all.add_text("", syntax.is_c() ? "triangle_count" : "",
                 std::to_string(parts_.triangles.size()));
    for (const StructField& field : fields_.all())
      all.add_text("", field.name.c_str(), std::get<std::string>(field.value));
    if (is_nonzero && syntax.is_python()) all.add_text("", "fill", "\"nonzero\"");
    const std::string mesh = program_.structure("mesh", "Mesh", all);
    if (!syntax.is_c()) return program_.define("mesh", "", mesh);
    if (!is_nonzero) return program_.create("entity", "crt_mesh_create_with", {"&" + mesh});
    Fields options(syntax);
    options.add_text("", "fill", "CRT_FILL_NONZERO");
    const std::string rule = program_.structure("mesh_options", "", options);
    return program_.create("entity", "crt_mesh_create_with_options", {"&" + mesh, "&" + rule});
  }

 private:
  template <class Rows>
  std::string rows(const char* name, const char* cpp_type, const char* c_type,
                   const Rows& content) {
    const Syntax& syntax = program_.syntax();
    return program_.array(name, syntax.is_cpp() ? cpp_type : c_type, row_items(syntax, content));
  }

  template <class Rows>
  void add_rows(const char* name, const char* cpp_type, const char* c_type, const Rows& content) {
    if (content.empty()) return;
    add_array(name, rows(name, cpp_type, c_type, content));
    const std::string field = name;
    if (!program_.syntax().is_c() || field.ends_with("_indices")) return;
    fields_.add_text("", field == "uv" ? "uv_count" : "normal_count",
                     std::to_string(content.size()));
  }

  void add_array(const char* name, const std::string& array) {
    fields_.add_text(name, name,
                     program_.syntax().is_cpp()
                         ? text::format("{{std::begin({0}), std::end({0})}}", array)
                         : array);
  }

  void add_materials() {
    const MeshAttributes& attributes = parts_.attributes;
    if (attributes.materials.empty()) return;
    const Syntax& syntax = program_.syntax();
    if (syntax.is_c()) {
      add_material_pointers("materials", "const crt_material*", false);
      add_material_pointers("principled", "const crt_principled*", true);
      fields_.add_text("", "material_count", std::to_string(attributes.materials.size()));
    } else {
      std::vector<std::string> names;
      for (const SharedMaterial& material : attributes.materials)
        names.push_back(material_name(program_, material));
      fields_.add_text("materials", "materials", syntax.list(names));
    }
    std::vector<std::string> numbers;
    for (const std::uint32_t number : attributes.material_of_triangle)
      numbers.push_back(std::to_string(number));
    add_array("material_of_triangle",
              program_.array("material_of_triangle", syntax.is_cpp() ? "std::uint32_t" : "uint32_t",
                             numbers));
  }

  /// Adds those materials that are of one kind, if there are any. In C each kind has a list.
  void add_material_pointers(const char* field, const char* type, bool is_principled) {
    std::vector<std::string> pointers;
    bool has_any = false;
    for (const SharedMaterial& material : parts_.attributes.materials) {
      const bool is_here = (material.principled() != nullptr) == is_principled;
      pointers.push_back(is_here ? "&" + material_name(program_, material) : "NULL");
      has_any = has_any || is_here;
    }
    if (has_any) fields_.add_text("", field, program_.local_array(field, type, pointers));
  }

  Program& program_;
  const MeshParts& parts_;
  Fields fields_;
};

/// Returns the attribute that a script needs for the rule of a mesh, if its file has another one.
std::string fill_text(const MeshParts& parts) {
  const MeshFile file{
      .positions = parts.positions, .triangles = parts.triangles, .attributes = parts.attributes};
  if (mesh_report(load_mesh(file, ""))->fill == parts.fill) return "";
  return parts.fill == FillRule::nonzero ? " fill -> \"nonzero\"" : " fill -> \"evenodd\"";
}

}  // namespace

std::string mesh_value(Program& program, const Mesh& mesh) {
  std::string name = program.known(mesh.triangles.get());
  if (name.empty()) {
    const bool is_script = program.syntax().is_script();
    if (!is_script) program.require_space(std::size_t{3} * mesh.triangles->size());
    const MeshParts parts = parts_of(*mesh.triangles);
    check_parts(parts, *mesh.triangles);
    name = program.remember(mesh.triangles.get(),
                            is_script ? obj_file_name(program, parts) + fill_text(parts)
                                      : MeshWriter(program, parts).write());
  }
  if (program.syntax().is_c()) return name;
  const std::string material = mesh.material ? material_name(program, *mesh.material) : "";
  if (program.syntax().is_script()) {
    return material.empty() ? text::format("Mesh {{ file -> {} }}", name)
                            : text::format("Mesh {{ file -> {} material -> {} }}", name, material);
  }
  if (program.syntax().is_python())
    return material.empty() ? name : text::format("{}.with_material({})", name, material);
  return material.empty() ? text::format("Mesh{{.triangles = {}}}", name)
                          : text::format("Mesh{{.triangles = {}, .material = {}}}", name, material);
}

}  // namespace crt::source
