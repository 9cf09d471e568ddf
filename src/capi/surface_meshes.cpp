// This file implements the surface meshes of the C interface.
#include <limits>
#include <string>
#include <vector>

#include "capi/handles.hpp"
#include "capi/structs.hpp"
#include "text/format.hpp"

static_assert(sizeof(crt::Vec3) == 3 * sizeof(double));
static_assert(sizeof(decltype(crt::SurfaceMesh::triangles)::value_type) ==
              3 * sizeof(std::uint32_t));

namespace crt::capi {

namespace {

std::string surface_path(const char* path) {
  require(path, "path");
  if (*path == 0) reject("path", "must not be empty");
  return path;
}

std::vector<SurfaceMeshPart> surface_parts(const crt_surface_mesh* const* meshes, std::size_t count,
                                           const char* const* names, const double* colors) {
  if (count > 0) require(meshes, "meshes");
  std::vector<SurfaceMeshPart> parts;
  parts.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (meshes[i] == nullptr) reject(text::format("meshes[{}]", i), "must not be NULL");
    SurfaceMeshPart& part = parts.emplace_back();
    part.mesh = &meshes[i]->value;
    if (names != nullptr && names[i] != nullptr) part.name = names[i];
    if (colors == nullptr) continue;
    const double* const color = colors + 4 * i;
    part.color = Color{color[0], color[1], color[2], color[3]};
  }
  return parts;
}

}  // namespace

}  // namespace crt::capi

using namespace crt::capi;

crt_status crt_entity_tessellate(crt_entity* entity, double deviation, crt_surface_mesh** out) {
  return crt_entity_tessellate_with(entity, deviation, nullptr, out);
}

crt_status crt_entity_tessellate_with(crt_entity* entity, double deviation,
                                      const crt_measure_options* options, crt_surface_mesh** out) {
  return guarded_with_cancel([&](const CancelValue& cancel_value) {
    require(entity, "entity");
    require(out, "out");
    *out = new crt_surface_mesh(
        crt::tessellate(entity->value, deviation, to_options(options, cancel_value)));
  });
}

const double* crt_surface_mesh_positions(const crt_surface_mesh* mesh, size_t* vertex_count) {
  if (vertex_count != nullptr) *vertex_count = mesh == nullptr ? 0 : mesh->value.positions.size();
  return mesh == nullptr ? nullptr : reinterpret_cast<const double*>(mesh->value.positions.data());
}

const uint32_t* crt_surface_mesh_indices(const crt_surface_mesh* mesh, size_t* triangle_count) {
  if (triangle_count != nullptr)
    *triangle_count = mesh == nullptr ? 0 : mesh->value.triangles.size();
  return mesh == nullptr ? nullptr
                         : reinterpret_cast<const uint32_t*>(mesh->value.triangles.data());
}

double crt_surface_mesh_deviation(const crt_surface_mesh* mesh) {
  return mesh == nullptr ? std::numeric_limits<double>::infinity() : mesh->value.deviation;
}

crt_status crt_surface_mesh_write(const crt_surface_mesh* mesh, const char* path) {
  return guarded([&] {
    require(mesh, "mesh");
    crt::write_surface_mesh(surface_path(path), mesh->value);
  });
}

crt_status crt_surface_meshes_write(const crt_surface_mesh* const* meshes, size_t count,
                                    const char* const* names, const double* colors, int32_t unit,
                                    const char* path) {
  return guarded([&] {
    const crt::Unit of_scene = to_enum(unit, crt::Unit::in, "unit", "crt_unit");
    const std::vector<crt::SurfaceMeshPart> parts = surface_parts(meshes, count, names, colors);
    crt::write_surface_mesh(surface_path(path), parts, {.unit = of_scene});
  });
}
