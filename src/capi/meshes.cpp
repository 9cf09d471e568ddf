// This file implements meshes of the C interface.
#include "crt/mesh.hpp"

#include <array>
#include <cmath>
#include <vector>

#include "capi/structs.hpp"

namespace crt::capi {

template <>
crt_mesh defaults<crt_mesh>() {
  crt_mesh mesh{};
  mesh.smooth = -1;
  return mesh;
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

std::vector<Vec3> to_vectors(const double* numbers, std::uint64_t count, const char* argument) {
  return to_groups<Vec3, 3>(numbers, count, argument,
                            [](const double* p) { return Vec3(p[0], p[1], p[2]); });
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

MeshAttributes to_attributes(const crt_mesh& mesh) {
  MeshAttributes attributes;
  attributes.normals = to_vectors(mesh.normals, mesh.normal_count, "normals");
  attributes.normal_indices = to_corners(mesh.normal_indices, mesh.triangle_count);
  attributes.uv =
      to_groups<std::array<double, 2>, 2>(mesh.uv, mesh.uv_count, "uv", [](const double* p) {
        return std::array<double, 2>{p[0], p[1]};
      });
  attributes.uv_indices = to_corners(mesh.uv_indices, mesh.triangle_count);
  if (mesh.material_count > 0) require(mesh.materials, "materials");
  for (std::uint64_t i = 0; i < mesh.material_count; ++i) {
    require(mesh.materials[i], "materials");
    attributes.materials.emplace_back(to_material(mesh.materials[i]));
  }
  if (mesh.material_of_triangle != nullptr) {
    attributes.material_of_triangle.assign(mesh.material_of_triangle,
                                           mesh.material_of_triangle + mesh.triangle_count);
  }
  if (std::isnan(mesh.smooth)) reject("smooth", "must be a number");
  if (mesh.smooth >= 0) attributes.smooth = mesh.smooth;
  return attributes;
}

}  // namespace

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

crt_status crt_mesh_create_with(const crt_mesh* mesh, crt_entity** out) {
  return create(out, [&] {
    const auto given = taken(mesh, "mesh");
    if (given.reserved != 0) reject("mesh", "has a reserved field that is not 0");
    return crt::triangle_mesh(to_vectors(given.positions, given.vertex_count, "positions"),
                              to_triangles(given.indices, given.triangle_count, "indices"),
                              to_attributes(given));
  });
}
