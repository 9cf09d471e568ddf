// The fields of a struct are those that are not as their defaults.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "crt/color.hpp"
#include "crt/schema.hpp"
#include "source/syntax.hpp"

namespace crt::source {

/// A StructField has a value as text, or a vector, which C assigns number by number.
struct StructField {
  std::string name;
  std::variant<std::string, Vec3> value;
};

/// Fields are those of one struct in the language that is written. Each is named as C++ has it and
/// as C and Python have it. An empty name says that there is no such field. Scripts have the fields
/// of C++.
class Fields {
 public:
  explicit Fields(const Syntax& syntax) : syntax_(syntax) {}

  void add_text(std::string_view cpp, std::string_view c, std::string text);
  void add_vector(std::string_view cpp, std::string_view c, const Vec3& value);
  template <class Enum>
  void add_enum(std::string_view cpp, std::string_view c, Enum value, Enum usual) {
    if (value == usual) return;
    const auto& choices = schema::choices<Enum>;
    add_text(cpp, c,
             syntax_.enumerator(choices.type, choices.c_prefix,
                                choices.names.at(schema::place_of(value))));
  }

  const std::vector<StructField>& all() const { return fields_; }
  /// Returns "name -> value", "name=value" or ".name = value" for each field.
  std::vector<std::string> assignments() const;

  /// Returns "Name{.field = value}", "crt.Name(field=value)" or "Name { field -> value }".
  std::string constructed(const std::string& name) const;

 private:
  std::string name_of(std::string_view cpp, std::string_view c) const;

  Syntax syntax_;
  std::vector<StructField> fields_;
};

}  // namespace crt::source
