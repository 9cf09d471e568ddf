// Instances of every primitive are made at random from the fields alone, so no primitive needs a
// line here.
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <iterator>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/geometry/description.hpp"
#include "core/geometry/shape.hpp"
#include "crt/error.hpp"
#include "crt/validate.hpp"
#include "geometry/custom_shapes.hpp"
#include "geometry/height_fields.hpp"
#include "geometry/meshes.hpp"
#include "geometry/profiles.hpp"
#include "geometry/random.hpp"
#include "geometry/random_fields.hpp"
#include "geometry/turned_profiles.hpp"

namespace crt::test {

/// Returns a field as a user writes it (a small whole number, or a half) or any, of either sign.
inline double random_field(Random& random) {
  if (random.one_in(2)) return std::floor(random.uniform(-4, 5)) / 2;
  return random.uniform(-2, 2);
}

/// Fills in the fields of a primitive, which need not fit together. All are doubles.
template <class Description>
void set_at_random(Description& description, std::size_t bytes, Random& random) {
  std::vector<double> fields(bytes / sizeof(double));
  for (double& field : fields) field = random_field(random);
  std::memcpy(static_cast<void*>(&description), fields.data(), bytes);
}
inline void set_at_random(Mesh& mesh, std::size_t /*bytes*/, Random& random) {
  const TriangleList list = random_mesh(random);
  mesh.triangles = mesh_triangles(list.positions, list.triangles);
}

inline void set_at_random(Extrusion& extrusion, std::size_t /*bytes*/, Random& random) {
  extrusion.profile =
      make_profile(random.one_in(2) ? whole_contours(random) : random_contours(random, 2));
  extrusion.from = random_field(random);
  extrusion.to = random_field(random);
}

inline void set_at_random(Revolution& revolution, std::size_t /*bytes*/, Random& random) {
  revolution.profile =
      random.one_in(2) ? whole_turned_profile(random) : random_turned_profile(random, 2);
  revolution.angle = random_turn(random);
}

inline void set_at_random(HeightField& field, std::size_t /*bytes*/, Random& random) {
  field.heights = random_grid(random);
  for (int axis = 0; axis < 3; ++axis) {
    field.corner_a[axis] = random_field(random);
    field.corner_b[axis] = random_field(random);
  }
}

/// Makes a field without poles, as of others the normal may be any.
inline void set_at_random(Implicit& implicit, std::size_t /*bytes*/, Random& random) {
  implicit.field = random_field_of(random, 3, false);
  for (int axis = 0; axis < 3; ++axis) {
    implicit.lower[axis] = random_field(random);
    implicit.upper[axis] = random_field(random);
  }
}

inline Primitive random_instance(std::size_t kind, Random& random);

/// Makes a custom shape of a finite solid.
inline void set_at_random(Custom& custom, std::size_t /*bytes*/, Random& random) {
  const Primitive some[] = {Sphere{}, Box{}, Cylinder{}, Cone{}, Torus{}, Capsule{}};
  custom = as_custom(random_instance(some[random.bits() % std::size(some)].index(), random));
}

/// Returns a valid instance of the primitive that stands at this place in the list.
inline Primitive random_instance(std::size_t kind, Random& random) {
  Primitive primitive;
  const auto make = [&]<std::size_t... places>(std::index_sequence<places...>) {
    ((places == kind ? void(primitive.emplace<places>()) : void()), ...);
  };
  make(std::make_index_sequence<std::variant_size_v<Primitive>>());
  while (true) {
    std::visit(
        [&](auto& description) {
          set_at_random(description, core::description_of(primitive).size(), random);
        },
        primitive);
    try {
      validate(primitive);
      return primitive;
    } catch (const Error&) {
      continue;
    }
  }
}

/// Returns a ray from around the instance to near its middle. Some are along a coordinate axis.
inline core::ObjectRay random_ray(Random& random) {
  const Vec3 aim = 1.5 * random.in_cube();
  const Vec3 direction = random.direction() * random.power_of_ten(-1, 1);
  return {.origin = aim - random.uniform(-1, 6) * direction, .direction = direction};
}

inline std::string name_of(std::size_t kind) {
  return "primitive " + std::to_string(kind) + " of the list";
}

struct Crossings {
  core::CrossingList list;
  bool starts_inside = false;
};

inline Crossings crossings_of(const core::Shape& shape, const core::ObjectRay& ray) {
  Crossings result;
  result.starts_inside = shape.crossings(ray, result.list);
  return result;
}

/// Calls check(kind, primitive, shape, random) for `count` instances of every primitive.
template <class Check>
void for_instances(int count, const Check& check) {
  for (std::size_t kind = 0; kind < std::variant_size_v<Primitive>; ++kind) {
    INFO(name_of(kind));
    Random random(100 + kind);
    for (int i = 0; i < count; ++i) {
      const Primitive primitive = random_instance(kind, random);
      check(primitive, *core::make_shape(primitive), random);
    }
  }
}

}  // namespace crt::test
