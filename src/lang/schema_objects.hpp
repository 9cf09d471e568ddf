// Objects whose rows are those of the schema are made here: primitives and lights.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "crt/entity.hpp"
#include "crt/validate.hpp"
#include "lang/no_size.hpp"
#include "lang/object_builder.hpp"

namespace crt::lang {

/// Warns of an entity that draws nothing.
void warn_of(const NoSize& no_size, const ObjectSite& site);

inline constexpr std::size_t steps_per_primitive = 20;

/// Returns what it takes to make a solid, beside its primitives.
template <class Shape>
std::size_t steps_to_make(const Shape&) {
  return 0;
}
inline std::size_t steps_to_make(const Hull& hull) {
  return hull.points.size() * hull.points.size() / 32;
}
inline std::size_t steps_to_make(const Polyhedron& solid) {
  std::size_t steps = 0;
  for (const auto& face : solid.faces) steps += face.size() * face.size() / 32;
  return steps;
}

/// Makes the row of a primitive, which takes what its table has.
template <class Shape>
ObjectType entity() {
  return object<Shape>(
      schema::table<Shape>.name, attributes_of<Shape>(),
      +[](Shape shape, const ObjectSite& site) -> Value {
        site.context.count_made(site.name_span);
        const std::optional<NoSize> no_size = give_size(shape);
        site.context.spend(site.name_span, steps_to_make(shape));
        Entity entity(std::move(shape));
        // What is made of many primitives is paid for by each.
        if (entity.primitive_count() > 1)
          site.context.spend(site.name_span, steps_per_primitive * entity.primitive_count());
        if (!no_size) return entity;
        warn_of(*no_size, site);
        return empty_entity();
      });
}

/// Makes the row of a light.
template <class Kind>
ObjectType light() {
  return object<Kind>(
      schema::table<Kind>.name, attributes_of<Kind>(), +[](Kind kind, const ObjectSite&) -> Value {
        auto light = std::make_shared<const Light>(kind);
        validate(*light);
        return light;
      });
}

}  // namespace crt::lang
