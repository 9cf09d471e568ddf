// The rows of the object table are made by these functions, most of them from rows of the schema.
#pragma once

#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "crt/schema.hpp"
#include "lang/attributes.hpp"
#include "lang/objects.hpp"
#include "text/format.hpp"

namespace crt::lang {

template <class Value>
struct WithoutOptional : std::type_identity<Value> {};
template <class Value>
struct WithoutOptional<std::optional<Value>> : std::type_identity<Value> {};

/// Returns the words of an enumeration that has some in the schema.
template <class Value>
std::span<const schema::Name> words_of() {
  using Enum = typename WithoutOptional<Value>::type;
  if constexpr (requires { schema::choices<Enum>.script_names; }) {
    return schema::choices<Enum>.script_names;
  } else {
    return {};
  }
}

template <class Object, class Field>
AttributeType attribute(std::string_view name, Field Object::*field, std::string default_text) {
  const bool is_required = default_text.empty();
  return {.name = name,
          .required = is_required,
          .type = type_text(static_cast<const Field*>(nullptr)),
          .default_text = std::move(default_text),
          .choices = words_of<Field>(),
          .rule = {},
          .about = {},
          .assign = [field](void* object, const Given& given, Context& context) {
            convert(given, context, static_cast<Object*>(object)->*field);
          }};
}

template <class Object, class Field>
AttributeType required(std::string_view name, Field Object::*field) {
  return attribute(name, field, "");
}

inline constexpr double radians_per_degree = std::numbers::pi / 180;

/// Makes an attribute for an angle that a script gives in degrees and the core takes in radians.
template <class Object, class Angle>
AttributeType degrees(std::string_view name, Angle Object::*field, std::string default_text,
                      std::string_view rule) {
  AttributeType type = attribute(name, field, std::move(default_text));
  type.rule = rule;
  type.assign = [field](void* object, const Given& given, Context& context) {
    double angle = 0;
    convert(given, context, angle);
    static_cast<Object*>(object)->*field = angle * radians_per_degree;
  };
  return type;
}

// ---- rows of the schema -------------------------------------------------------------------------

// Each returns a default as the reference writes it.
std::string text_of_default(double value);
std::string text_of_default(const std::string& value);
std::string text_of_default(const Vec3& value);
std::string text_of_default(const Color& value);

template <class Value>
std::string default_text(const Value& value) {
  if constexpr (std::is_same_v<Value, bool>) {
    return value ? "true" : "false";
  } else if constexpr (std::is_integral_v<Value>) {
    return std::to_string(value);
  } else if constexpr (std::is_enum_v<Value>) {
    return text_of_default(std::string(schema::script_name_of(value)));
  } else if constexpr (std::is_same_v<Value, std::variant<Color, Pattern>>) {
    return text_of_default(std::get<Color>(value));
  } else if constexpr (std::is_same_v<Value, Share>) {
    return text_of_default(std::get<double>(value));
  } else if constexpr (requires { text_of_default(value); }) {
    return text_of_default(value);
  } else {
    return "none";  // as nothing is in an optional, a pointer or a list
  }
}

/// Makes the attribute of a row of the schema. `Object` is its struct, or derived from that.
template <class Object, class Row>
AttributeType attribute(const Row& row) {
  typename Row::Value Object::*const member = row.member;
  const typename Row::Value usual = typename Row::Owner{}.*row.member;
  std::string text = row.uses.required ? "" : std::string(row.uses.default_text);
  if (text.empty() && !row.uses.required) text = default_text(usual);
  AttributeType type = attribute(row.script_name(), member, std::move(text));
  if constexpr (std::is_same_v<typename Row::Value, double>) {
    if (!row.uses.degrees.empty()) {
      type = degrees(row.script_name(), member, text::format("{:.10g}", usual / radians_per_degree),
                     row.uses.degrees);
    }
  }
  type.about = row.about;
  type.is_of_schema = true;
  return type;
}

/// Makes the attributes of a struct that has a table in the schema.
template <class Struct, class Object = Struct>
std::vector<AttributeType> attributes_of() {
  std::vector<AttributeType> attributes;
  schema::for_each_field<Struct>([&]<class Row>(const Row& row) {
    if constexpr (requires(const Given& given, Context& context, typename Row::Value& field) {
                    convert(given, context, field);
                  }) {
      if (row.uses.in_scripts) attributes.push_back(attribute<Object>(row));
    }
  });
  return attributes;
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
Object initial(const ObjectSite&) {
  return {};
}
template <>
inline Material initial<Material>(const ObjectSite& site) {
  return site.base != nullptr ? **site.base : Material{};
}
template <>
inline PrincipledMaterial initial<PrincipledMaterial>(const ObjectSite& site) {
  return site.base != nullptr ? *site.base->principled() : PrincipledMaterial{};
}
/// In scripts of 2015 cameras have a lens if they do not say otherwise.
template <>
inline Camera initial<Camera>(const ObjectSite& site) {
  Camera camera;
  if (site.context.compat == compat_2015) {
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
          return finish(assemble(site, initial<Object>(site)), site);
        } catch (const Error& error) {
          blame(error, site.name_span, site.attributes);
        }
      }};
}

}  // namespace crt::lang
