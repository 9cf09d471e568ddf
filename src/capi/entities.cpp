// This file implements the entities of the C interface.
#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "capi/structs.hpp"
#include "crt/implicit_shapes.hpp"
#include "crt/schema_primitives.hpp"
#include "crt/source_code.hpp"

namespace crt::capi {

namespace {

/// Returns the entities behind `count` handles.
std::vector<Entity> to_entities(crt_entity* const* handles, std::size_t count,
                                const char* argument) {
  std::vector<Entity> entities;
  if (count == 0) return entities;
  require(handles, argument);
  entities.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    require(handles[i], argument);
    entities.push_back(handles[i]->value);
  }
  return entities;
}

/// Makes a transform from the rows of a 3x4 matrix.
Transform to_transform(const double* affine) {
  require(affine, "affine");
  const std::span<const double, 12> m(affine, 12);
  for (const double number : m) {
    if (!std::isfinite(number)) reject("affine", "must be finite");
  }
  return {.row_x = {m[0], m[1], m[2]},
          .row_y = {m[4], m[5], m[6]},
          .row_z = {m[8], m[9], m[10]},
          .translation = {m[3], m[7], m[11]}};
}

/// Copies heights. Sizes that no grid may have are refused before any height is read.
std::shared_ptr<const HeightGrid> to_height_grid(const double* heights, std::uint32_t columns,
                                                 std::uint32_t rows) {
  const std::uint64_t count = std::uint64_t{columns} * rows;
  const bool is_fine = columns > 1 && rows > 1 && count <= crt::most_heights;
  std::vector<double> copied;
  if (is_fine) copied.assign(heights, heights + count);
  return make_height_grid(std::move(copied), columns, rows);
}

void take(bool& field, bool argument, std::string_view) {
  field = argument;
}
void take(double& field, double argument, std::string_view) {
  field = argument;
}
void take(Vec3& field, const double* argument, std::string_view name) {
  field = to_vec3(argument, name.data());
}

/// Makes a primitive of its fields, in the order of its table in the schema.
template <class Shape, class... Arguments>
crt_status create_of(crt_entity** out, Arguments... arguments) {
  return create(out, [&] {
    Shape shape;
    [&]<std::size_t... places>(std::index_sequence<places...>) {
      const auto& rows = schema::table<Shape>.fields;
      (take(shape.*std::get<places>(rows).member, arguments, std::get<places>(rows).name), ...);
    }
    (std::index_sequence_for<Arguments...>());
    return shape;
  });
}

}  // namespace

}  // namespace crt::capi

using namespace crt::capi;

crt_status crt_sphere_create(const double center[3], double radius, crt_entity** out) {
  return create_of<crt::Sphere>(out, center, radius);
}

crt_status crt_box_create(const double corner_a[3], const double corner_b[3], crt_entity** out) {
  return create_of<crt::Box>(out, corner_a, corner_b);
}

crt_status crt_plane_create(const double normal[3], const double position[3], crt_entity** out) {
  return create_of<crt::Plane>(out, normal, position);
}

crt_status crt_half_plane_create(const double normal[3], const double position[3],
                                 const double direction[3], crt_entity** out) {
  return create_of<crt::HalfPlane>(out, normal, position, direction);
}

crt_status crt_cylinder_create(const double from[3], const double to[3], double radius,
                               crt_entity** out) {
  return create_of<crt::Cylinder>(out, from, to, radius);
}

crt_status crt_cone_create(const double from[3], const double to[3], double radius, double radius2,
                           crt_entity** out) {
  return create_of<crt::Cone>(out, from, to, radius, radius2);
}

crt_status crt_capsule_create(const double from[3], const double to[3], double radius,
                              crt_entity** out) {
  return create_of<crt::Capsule>(out, from, to, radius);
}

crt_status crt_ellipsoid_create(const double center[3], const double radii[3], crt_entity** out) {
  return create_of<crt::Ellipsoid>(out, center, radii);
}

crt_status crt_thread_create(const double from[3], const double to[3], double diameter,
                             double pitch, int32_t left, crt_entity** out) {
  return create_of<crt::Thread>(out, from, to, diameter, pitch, left != 0);
}

crt_status crt_helix_create(const double from[3], const double to[3], double radius,
                            double thickness, double pitch, int32_t left, crt_entity** out) {
  return create_of<crt::Helix>(out, from, to, radius, thickness, pitch, left != 0);
}

crt_status crt_rounded_box_create(const double corner_a[3], const double corner_b[3], double radius,
                                  crt_entity** out) {
  return create_of<crt::RoundedBox>(out, corner_a, corner_b, radius);
}

crt_status crt_torus_create(const double center[3], const double axis[3], double radius,
                            double thickness, crt_entity** out) {
  return create_of<crt::Torus>(out, center, axis, radius, thickness);
}

crt_status crt_disc_create(const double center[3], const double normal[3], double radius,
                           crt_entity** out) {
  return create_of<crt::Disc>(out, center, normal, radius);
}

crt_status crt_triangle_create(const double a[3], const double b[3], const double c[3],
                               crt_entity** out) {
  return create_of<crt::Triangle>(out, a, b, c);
}

crt_status crt_quadric_create(const double squares[3], const double products[3],
                              const double linear[3], double constant, crt_entity** out) {
  return create_of<crt::Quadric>(out, squares, products, linear, constant);
}

crt_status crt_height_field_create(const double* heights, uint32_t columns, uint32_t rows,
                                   const double corner_a[3], const double corner_b[3],
                                   crt_entity** out) {
  return create(out, [&] {
    require(heights, "heights");
    return crt::HeightField{.heights = to_height_grid(heights, columns, rows),
                            .corner_a = to_vec3(corner_a, "corner_a"),
                            .corner_b = to_vec3(corner_b, "corner_b")};
  });
}

crt_status crt_implicit_create(const char* field, size_t length, const double lower[3],
                               const double upper[3], crt_entity** out) {
  return create(out, [&] {
    require(field, "field");
    return crt::Implicit{.field = crt::parse_field({field, length}),
                         .lower = to_vec3(lower, "lower"),
                         .upper = to_vec3(upper, "upper")};
  });
}

crt_status crt_blob_create(const crt_blob_part* parts, size_t count, double threshold,
                           crt_entity** out) {
  return create(out, [&] {
    if (count > 0) require(parts, "parts");
    std::vector<crt::BlobPart> given;
    // One more than is possible is refused, and more are not looked at.
    for (const crt_blob_part& part : std::span(parts, std::min(count, crt::most_blob_parts + 1))) {
      given.push_back({.from = to_vec3(part.from, "parts"),
                       .to = to_vec3(part.to, "parts"),
                       .radius = part.radius,
                       .strength = part.strength});
    }
    return crt::blob(given, threshold);
  });
}

crt_status crt_superellipsoid_create(double east_west, double north_south, crt_entity** out) {
  return create(out, [&] { return crt::superellipsoid(east_west, north_south); });
}

crt_status crt_empty_create(crt_entity** out) {
  return create(out, [] { return crt::empty_entity(); });
}

crt_status crt_union_create(crt_entity* const* parts, size_t count, crt_entity** out) {
  return create(out, [&] { return crt::csg_union(to_entities(parts, count, "parts")); });
}

crt_status crt_intersection_create(crt_entity* const* parts, size_t count, crt_entity** out) {
  return create(out, [&] { return crt::csg_intersection(to_entities(parts, count, "parts")); });
}

crt_status crt_difference_create(crt_entity* from, crt_entity* const* cutters, size_t count,
                                 crt_entity** out) {
  return create(out, [&] {
    require(from, "from");
    return crt::csg_difference(from->value, to_entities(cutters, count, "cutters"));
  });
}

crt_status crt_entity_with_transform(crt_entity* entity, const double affine[12],
                                     crt_entity** out) {
  return create(out, [&] {
    require(entity, "entity");
    return entity->value.transformed(to_transform(affine));
  });
}

crt_status crt_entity_with_material(crt_entity* entity, const crt_material* material,
                                    crt_entity** out) {
  return create(out, [&] {
    require(entity, "entity");
    return entity->value.with_material(to_material(material));
  });
}

crt_status crt_entity_with_principled(crt_entity* entity, const crt_principled* material,
                                      crt_entity** out) {
  return create(out, [&] {
    require(entity, "entity");
    return entity->value.with_material(to_material(material));
  });
}

crt_status crt_entity_with_id(crt_entity* entity, uint32_t id, crt_entity** out) {
  return create(out, [&] {
    require(entity, "entity");
    return entity->value.with_id(id);
  });
}

crt_status crt_entity_with_user(crt_entity* entity, uint64_t user, crt_entity** out) {
  return create(out, [&] {
    require(entity, "entity");
    return entity->value.with_user(user);
  });
}

crt_status crt_entity_with_shadow(crt_entity* entity, int32_t casts, crt_entity** out) {
  return create(out, [&] {
    require(entity, "entity");
    return entity->value.with_shadow(casts != 0);
  });
}

crt_status crt_entity_with_visible(crt_entity* entity, int32_t visible, crt_entity** out) {
  return create(out, [&] {
    require(entity, "entity");
    return entity->value.with_visible(visible != 0);
  });
}

int32_t crt_entity_is_solid(const crt_entity* entity) {
  return entity != nullptr && entity->value.is_solid() ? 1 : 0;
}

crt_status crt_entity_solid_fault(crt_entity* entity, char* text, size_t capacity, size_t* length) {
  return guarded([&] {
    require(entity, "entity");
    give_text(entity->value.solid_fault(), "text", text, capacity, length);
  });
}

crt_status crt_entity_describe(crt_entity* entity, char* json, size_t capacity, size_t* length) {
  return guarded([&] {
    require(entity, "entity");
    crt::Scene scene;
    scene.entities = {entity->value};
    give_text(crt::descriptions_to_json(crt::describe_entities(scene)), "json", json, capacity,
              length);
  });
}

uint64_t crt_entity_primitive_count(const crt_entity* entity) {
  return entity == nullptr ? 0 : entity->value.primitive_count();
}
