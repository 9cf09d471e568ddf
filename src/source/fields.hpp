// The fields of a struct are those that are not as their defaults.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "crt/color.hpp"
#include "source/syntax.hpp"

namespace crt::source {

/// A StructField has a value as text, or a vector, which C assigns number by number.
struct StructField {
  std::string name;
  std::variant<std::string, Vec3> value;
};

/// Returns what a script calls a field of C++: "cornerA" for "corner_a", "bumpheight" for
/// "bump_height".
std::string script_name(const std::string& cpp);

/// Fields are those of one struct in the language that is written. Each is named as C++ has it and
/// as C and Python have it. An empty name says that there is no such field. Scripts have the fields
/// of C++.
class Fields {
 public:
  explicit Fields(const Syntax& syntax) : syntax_(syntax) {}

  void add_text(const char* cpp, const char* c, std::string text);
  void add(const char* cpp, const char* c, double value, double usual);
  void add(const char* cpp, const char* c, const Vec3& value, const Vec3& usual);
  /// Adds a colour, whose alpha is a field of its own but in C++. `alpha` may be empty.
  void add(const char* cpp, const char* c, const char* alpha, const Color& value,
           const Color& usual);
  void add_string(const char* name, const std::string& value);
  void add_flag(const char* cpp, const char* c, bool value, bool usual);
  template <class Enum>
  void add_enum(const char* cpp, const char* c, const char* type, const char* prefix,
                std::span<const char* const> names, Enum value, Enum usual) {
    if (value != usual) {
      add_text(cpp, c, syntax_.enumerator(type, prefix, names[static_cast<std::size_t>(value)]));
    }
  }

  /// Returns the default of a field. In scripts, which must have this field, no value equals it.
  double required(double usual) const;
  Vec3 required(const Vec3& usual) const;
  Color required(const Color& usual) const;

  const std::vector<StructField>& all() const { return fields_; }
  /// Returns "name -> value", "name=value" or ".name = value" for each field.
  std::vector<std::string> assignments() const;

  /// Returns "Name{.field = value}", "crt.Name(field=value)" or "Name { field -> value }".
  std::string constructed(const std::string& name) const;

 private:
  std::string name_of(const char* cpp, const char* c) const;

  Syntax syntax_;
  std::vector<StructField> fields_;
};

}  // namespace crt::source
