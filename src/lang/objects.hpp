// The objects of the language are one table with a row for each object. Most rows follow from the
// schema (crt/schema.hpp).
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "crt/schema.hpp"
#include "lang/context.hpp"
#include "lang/source_map.hpp"
#include "lang/value.hpp"

namespace crt::lang {

struct Given;

struct AttributeType {
  std::string_view name;
  bool required = false;
  /// Names the type that it takes as the reference does: "Float".
  std::string_view type;
  /// The default is as the reference writes it, and empty for a required attribute.
  std::string default_text;
  /// Lists the words that it takes, if it takes only some.
  std::span<const schema::Name> choices;
  /// States the range in the script's units, where the core's own message has others: "must be ...
  /// degrees". Elsewhere it is empty.
  std::string_view rule;
  /// Says what it means, as the reference does, if it is a row of the schema.
  std::string_view about;
  bool is_of_schema = false;
  /// Puts a value into the C++ struct that the object becomes. Throws a Failure at the value.
  std::function<void(void* object, const Given& given, Context& context)> assign;
};

/// Given is an attribute with its value, as it stands in a script.
struct Given {
  const AttributeType* type = nullptr;
  Span name_span;
  Span value_span;
  Value value;
};

/// An ObjectSite is an object as it stands in a script. Each required attribute is there, and none
/// is there twice.
struct ObjectSite {
  Context& context;
  Span name_span;
  std::span<const Given> attributes;
  const SharedMaterial* base = nullptr;  ///< what a material begins with, if it is derived
};

struct ObjectType {
  std::string_view name;
  std::vector<AttributeType> attributes;
  /// Makes the value. Throws a Failure at what is wrong.
  std::function<Value(const ObjectSite&)> build;
};

/// Returns the row of an object, or null.
const ObjectType* find_object_type(std::string_view name);

std::span<const ObjectType> object_types();

/// Returns the index of an attribute in a row, or the number of attributes if it is not there.
std::size_t find_attribute(const ObjectType& type, std::string_view name);

/// Returns the attribute of a name, or null if it is not given.
const Given* find_given(std::span<const Given> attributes, std::string_view name);

/// Turns the core's error about a value into a Failure at the attribute that it is about.
[[noreturn]] void blame(const Error& error, Span otherwise, std::span<const Given> attributes);

}  // namespace crt::lang
