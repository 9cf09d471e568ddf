// This file implements meshes of the C interface.
#include "crt/mesh.hpp"

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "capi/numbers.hpp"
#include "capi/structs.hpp"
#include "crt/polyhedron.hpp"
#include "text/format.hpp"

namespace crt::capi {

template <>
crt_mesh defaults<crt_mesh>() {
  crt_mesh mesh{};
  mesh.smooth = -1;
  return mesh;
}

template <>
crt_mesh_options defaults<crt_mesh_options>() {
  crt_mesh_options options{};
  options.fill = -1;
  return options;
}

template <>
crt_mesh_report defaults<crt_mesh_report>() {
  crt_mesh_report report{};
  report.fill = CRT_FILL_EVEN_ODD;
  return report;
}

MeshOptions to_mesh_options(const crt_mesh_options* options) {
  if (options == nullptr) return {};
  const auto given = taken(options, "options");
  MeshOptions result{.weld = given.weld, .stitch = given.stitch};
  if (given.fill != -1)
    result.fill = to_enum(given.fill, FillRule::even_odd, "fill", "crt_fill_rule");
  return result;
}

namespace {

/// Returns groups of `size` numbers each, made by `make` of the first of them.
template <class Group, std::size_t size, class Number, class Make>
std::vector<Group> to_groups(const Number* numbers, std::uint64_t count, const char* argument,
                             const Make& make) {
  std::vector<Group> groups;
  if (count == 0) return groups;
  require(numbers, argument);
  groups.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i) groups.push_back(make(numbers + size * i));
  return groups;
}

std::vector<TriangleIndices> to_triangles(const std::uint32_t* numbers, std::uint64_t count,
                                          const char* argument) {
  return to_groups<TriangleIndices, 3>(numbers, count, argument, [](const std::uint32_t* p) {
    return TriangleIndices{p[0], p[1], p[2]};
  });
}

/// Returns the indices of corners, of which there may be none.
std::vector<TriangleIndices> to_corners(const std::uint32_t* numbers, std::uint64_t triangles) {
  if (numbers == nullptr) return {};
  return to_triangles(numbers, triangles, "indices");
}

/// Returns a material that either of two lists has.
SharedMaterial material_of_number(const crt_mesh& mesh, std::uint64_t number) {
  const crt_principled* const principled = mesh.principled ? mesh.principled[number] : nullptr;
  const crt_material* const material = mesh.materials ? mesh.materials[number] : nullptr;
  if (principled == nullptr) {
    require(material, "materials");
    return to_material(material);
  }
  if (material != nullptr)
    reject(text::format("principled[{}]", number), "must be NULL, as materials has that number");
  return to_material(principled);
}

MeshAttributes to_attributes(const crt_mesh& mesh) {
  MeshAttributes attributes;
  attributes.normals = to_vectors(mesh.normals, mesh.normal_count, "normals");
  attributes.normal_indices = to_corners(mesh.normal_indices, mesh.triangle_count);
  attributes.uv =
      to_groups<std::array<double, 2>, 2>(mesh.uv, mesh.uv_count, "uv", [](const double* p) {
        return std::array<double, 2>{p[0], p[1]};
      });
  attributes.uv_indices = to_corners(mesh.uv_indices, mesh.triangle_count);
  for (std::uint64_t i = 0; i < mesh.material_count; ++i)
    attributes.materials.push_back(material_of_number(mesh, i));
  if (mesh.material_of_triangle != nullptr) {
    attributes.material_of_triangle.assign(mesh.material_of_triangle,
                                           mesh.material_of_triangle + mesh.triangle_count);
  }
  if (std::isnan(mesh.smooth)) reject("smooth", "must be a number");
  if (mesh.smooth >= 0) attributes.smooth = mesh.smooth;
  return attributes;
}

const MeshReport& report_of(const crt_entity* entity) {
  require(entity, "entity");
  const MeshReport* const report = mesh_report(entity->value);
  if (report == nullptr) reject("entity", "must be one mesh");
  return *report;
}

}  // namespace

std::vector<Vec3> to_vectors(const double* numbers, std::uint64_t count, const char* argument) {
  return to_groups<Vec3, 3>(numbers, count, argument,
                            [](const double* p) { return Vec3(p[0], p[1], p[2]); });
}

}  // namespace crt::capi

using namespace crt::capi;

crt_status crt_mesh_init(crt_mesh* mesh, size_t struct_size) {
  return guarded([&] { initialise(mesh, struct_size, defaults<crt_mesh>()); });
}

crt_status crt_mesh_create(const double* positions, size_t vertex_count, const uint32_t* indices,
                           size_t triangle_count, crt_entity** out) {
  return create(out, [&] {
    require(positions, "positions");
    require(indices, "indices");
    return crt::triangle_mesh(to_vectors(positions, vertex_count, "positions"),
                              to_triangles(indices, triangle_count, "indices"));
  });
}

crt_status crt_mesh_from_triangles_rule(const double* positions, size_t vertex_count,
                                        const uint32_t* indices, size_t triangle_count,
                                        int32_t rule, crt_entity** out) {
  return create(out, [&] {
    require(positions, "positions");
    require(indices, "indices");
    const auto fill = to_enum(rule, crt::FillRule::even_odd, "rule", "crt_fill_rule");
    return crt::triangle_mesh(to_vectors(positions, vertex_count, "positions"),
                              to_triangles(indices, triangle_count, "indices"), {}, {.fill = fill});
  });
}

crt_status crt_mesh_create_with(const crt_mesh* mesh, crt_entity** out) {
  return crt_mesh_create_with_options(mesh, nullptr, out);
}

crt_status crt_mesh_options_init(crt_mesh_options* options, size_t struct_size) {
  return guarded([&] { initialise(options, struct_size, defaults<crt_mesh_options>()); });
}

crt_status crt_mesh_report_init(crt_mesh_report* report, size_t struct_size) {
  return guarded([&] { initialise(report, struct_size, defaults<crt_mesh_report>()); });
}

crt_status crt_entity_mesh_report(crt_entity* entity, crt_mesh_report* report) {
  return guarded([&] {
    const crt::MeshReport& found = report_of(entity);
    crt_mesh_report values{};
    values.fill = static_cast<std::int32_t>(found.fill);
    values.welded_vertices = found.welded_vertices;
    values.welded_triangles = found.welded_triangles;
    values.stitched_vertices = found.stitched_vertices;
    values.repeated_triangles = found.repeated_triangles;
    put(values.first_repeated, found.first_repeated);
    values.shells = found.shells;
    values.overlapping_shells = found.overlapping_shells;
    put(values.first_overlap, found.first_overlap);
    fill_in(report, "report", values);
  });
}

crt_status crt_entity_mesh_warnings(crt_entity* entity, char* text, size_t capacity,
                                    size_t* length) {
  return guarded([&] {
    std::string lines;
    for (const std::string& warning : report_of(entity).warnings) lines += warning + "\n";
    give_text(lines, "text", text, capacity, length);
  });
}

crt_status crt_mesh_create_with_options(const crt_mesh* mesh, const crt_mesh_options* options,
                                        crt_entity** out) {
  return create(out, [&] {
    const auto given = taken(mesh, "mesh");
    if (given.reserved != 0) reject("mesh", "has a reserved field that is not 0");
    return crt::triangle_mesh(to_vectors(given.positions, given.vertex_count, "positions"),
                              to_triangles(given.indices, given.triangle_count, "indices"),
                              to_attributes(given), to_mesh_options(options));
  });
}

crt_status crt_polyhedron_create(const double* points, size_t point_count, const uint32_t* corners,
                                 const uint32_t* sizes, size_t face_count, crt_entity** out) {
  return create(out, [&] {
    crt::Polyhedron solid{.points = to_vectors(points, point_count, "points")};
    if (face_count > 0) {
      require(corners, "corners");
      require(sizes, "sizes");
    }
    for (const std::uint32_t size : std::span(sizes, face_count)) {
      if (size > crt::most_corners_of_face) reject("sizes", "must be at most 1024");
      solid.faces.emplace_back(corners, corners + size);
      corners += size;
    }
    return solid;
  });
}

crt_status crt_hull_create(const double* points, size_t count, crt_entity** out) {
  return create(out, [&] {
    // One more than is possible is refused, and more are not looked at.
    return crt::Hull{.points =
                         to_vectors(points, std::min(count, crt::most_hull_points + 1), "points")};
  });
}
