#include "lang/objects.hpp"

#include <algorithm>
#include <string>

#include "lang/object_builder.hpp"
#include "text/format.hpp"
#include "text/letters.hpp"

namespace crt::lang {

namespace {

/// Removes what differs between "cornerA" and "corner_a", the script's and the core's name of a
/// field.
std::string without_style(std::string_view name) {
  std::string result;
  for (const char c : name) {
    if (c != '_') result += text::small_letter(c);
  }
  return result;
}

bool is_name_byte(char c) {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
}

/// Replaces the name of another field, as in "must differ from corner_a", by the script's name
/// 'cornerA'.
void name_other_field(std::string& message, std::span<const Given> attributes) {
  constexpr std::string_view introduction = "must differ from ";
  const std::size_t found = message.find(introduction);
  if (found == std::string::npos) return;
  const std::size_t begin = found + introduction.size();
  std::size_t end = begin;
  while (end < message.size() && is_name_byte(message[end])) ++end;
  const std::string field = without_style(std::string_view(message).substr(begin, end - begin));
  for (const Given& given : attributes) {
    if (without_style(given.type->name) != field) continue;
    message.replace(begin, end - begin, "'" + std::string(given.type->name) + "'");
    return;
  }
}

}  // namespace

std::string text_of_default(double value) {
  return text::format("{}", value);
}

std::string text_of_default(const std::string& value) {
  return text::format("\"{}\"", value);
}

std::string text_of_default(const Vec3& value) {
  return text::format("vec3({}, {}, {})", value.x, value.y, value.z);
}

std::string text_of_default(const Color& value) {
  return text::format("rgb({}, {}, {})", value.r, value.g, value.b);
}

const ObjectType* find_object_type(std::string_view name) {
  const std::span<const ObjectType> types = object_types();
  const auto found = std::find_if(types.begin(), types.end(),
                                  [name](const ObjectType& type) { return type.name == name; });
  return found == types.end() ? nullptr : &*found;
}

std::size_t find_attribute(const ObjectType& type, std::string_view name) {
  const auto found =
      std::find_if(type.attributes.begin(), type.attributes.end(),
                   [name](const AttributeType& attribute) { return attribute.name == name; });
  return static_cast<std::size_t>(found - type.attributes.begin());
}

const Given* find_given(std::span<const Given> attributes, std::string_view name) {
  const auto found = std::find_if(attributes.begin(), attributes.end(),
                                  [name](const Given& given) { return given.type->name == name; });
  return found == attributes.end() ? nullptr : &*found;
}

void blame(const Error& error, Span otherwise, std::span<const Given> attributes) {
  const std::string field = without_style(error.argument());
  std::string message = error.what();
  for (const Given& given : attributes) {
    if (field.empty() || without_style(given.type->name) != field) continue;
    // The core's messages begin with the field's name in C++.
    if (message.starts_with(error.argument())) message.erase(0, error.argument().size());
    name_other_field(message, attributes);
    message = "'" + std::string(given.type->name) + "'" +
              (given.type->rule.empty() ? message : " " + std::string(given.type->rule));
    throw Failure{.span = given.value_span, .message = std::move(message), .code = error.code()};
  }
  throw Failure{.span = otherwise, .message = std::move(message), .code = error.code()};
}

}  // namespace crt::lang
