// The rows of the object table are written with these functions.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "lang/attributes.hpp"
#include "lang/objects.hpp"

namespace crt::lang {

template <class Object, class Field>
AttributeType attribute(std::string_view name, Field Object::*field,
                        std::string_view default_text) {
  return {.name = name,
          .required = default_text.empty(),
          .type = type_text(static_cast<const Field*>(nullptr)),
          .default_text = default_text,
          .rule = {},
          .assign = [field](void* object, const Given& given, Context& context) {
            convert(given, context, static_cast<Object*>(object)->*field);
          }};
}

template <class Object, class Field>
AttributeType required(std::string_view name, Field Object::*field) {
  return attribute(name, field, "");
}

/// Makes an attribute for an angle that a script gives in degrees and the core takes in radians.
template <class Object, class Angle>
AttributeType degrees(std::string_view name, Angle Object::*field, std::string_view default_text,
                      std::string_view rule) {
  constexpr double radians_per_degree = std::numbers::pi / 180;
  AttributeType type = attribute(name, field, default_text);
  type.rule = rule;
  type.assign = [field](void* object, const Given& given, Context& context) {
    double angle = 0;
    convert(given, context, angle);
    static_cast<Object*>(object)->*field = angle * radians_per_degree;
  };
  return type;
}

/// Returns the struct with the attributes of a script. All other fields have the defaults of the
/// struct.
template <class Object>
Object assemble(const ObjectSite& site, Object object = {}) {
  for (const Given& given : site.attributes) given.type->assign(&object, given, site.context);
  return object;
}

/// Returns the struct of an object that gives no attributes.
template <class Object>
Object initial(const Context&) {
  return {};
}
/// In scripts of 2015 cameras have a lens if they do not say otherwise.
template <>
inline Camera initial<Camera>(const Context& context) {
  Camera camera;
  if (context.compat == compat_2015) {
    camera.aperture = 3;
    camera.focal_distance = 0.5;
  }
  return camera;
}

/// Makes a row whose `finish` makes a value of the filled struct. An error of the core becomes one
/// at the attribute.
template <class Object>
ObjectType object(std::string_view name, std::vector<AttributeType> attributes,
                  Value (*finish)(Object, const ObjectSite&)) {
  return {
      .name = name, .attributes = std::move(attributes), .build = [finish](const ObjectSite& site) {
        try {
          return finish(assemble(site, initial<Object>(site.context)), site);
        } catch (const Error& error) {
          blame(error, site.name_span, site.attributes);
        }
      }};
}

}  // namespace crt::lang
