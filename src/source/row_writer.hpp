// Values become source code by the rows of the schema.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "crt/light.hpp"
#include "crt/material.hpp"
#include "source/program.hpp"

namespace crt::source {

/// Adds the fields of a struct that has a table in the schema: those that are not as usual, and in
/// scripts those that must be there.
class RowWriter {
 public:
  RowWriter(Program& program, Fields& fields)
      : program_(program), syntax_(program.syntax()), fields_(fields) {}

  /// Adds all fields of an object that are not as usual, but for the one of that name.
  template <class Struct>
  void add_all(const Struct& object, const Struct& usual = {}, std::string_view but = {}) {
    schema::for_each_field<Struct>([&]<class Row>(const Row& row) {
      if (row.name == but) return;
      must_be_there_ = syntax_.is_script() && (row.uses.required || row.uses.always_written);
      const bool is_pattern = std::is_same_v<typename Row::Value, SharedPattern>;
      if (!syntax_.is_script() || row.uses.in_scripts || is_pattern)
        add(row.name, row.c_name(), row.uses, object.*row.member, usual.*row.member);
    });
  }

 private:
  using Text = std::string_view;
  using Uses = schema::Uses;

  void add(Text cpp, Text c, const Uses& uses, double value, double usual);
  void add(Text cpp, Text c, const Uses&, int value, int usual);
  void add(Text cpp, Text c, const Uses&, const Vec3& value, const Vec3& usual);
  /// In C and Python alpha is a field of its own, if there is any.
  void add(Text cpp, Text c, const Uses& uses, const Color& value, const Color& usual);
  void add(Text cpp, Text c, const Uses&, const std::string& value, const std::string&);
  /// In C and Python a flag is 0 or 1, and that of what is not there has the other one.
  void add(Text cpp, Text c, const Uses&, bool value, bool usual);
  void add(Text cpp, Text c, const Uses&, std::uint64_t value, std::uint64_t usual);
  template <class Enum>
  requires std::is_enum_v<Enum>
  void add(Text cpp, Text c, const Uses&, Enum value, Enum usual) {
    fields_.add_enum(cpp, c, value, usual);
  }
  void add(Text cpp, Text c, const Uses&, const std::optional<double>& value,
           const std::optional<double>&);
  void add(Text cpp, Text c, const Uses& uses, const std::variant<Color, Pattern>& value,
           const std::variant<Color, Pattern>& usual);
  void add(Text cpp, Text c, const Uses& uses, const Share& value, const Share& usual);
  void add(Text cpp, Text c, const Uses&, const std::optional<Pattern>& value,
           const std::optional<Pattern>&);
  /// In a script it stands in the place of a colour.
  void add(Text cpp, Text c, const Uses&, const SharedPattern& value, const SharedPattern&);
  void add(Text cpp, Text c, const Uses&, const std::shared_ptr<const Image>& value,
           const std::shared_ptr<const Image>&);
  void add(Text, Text, const Uses&, const std::vector<ColorStop>& stops,
           const std::vector<ColorStop>&);

  Program& program_;
  const Syntax& syntax_;
  Fields& fields_;
  bool must_be_there_ = false;
};

/// Says what a kind of a pattern or light is in the three languages.
struct KindNames {
  std::string cpp;
  std::string python;
  std::string c;
};

/// Returns the names of a kind of a family: "SpotLight", "Light.spot" and "CRT_LIGHT_SPOT".
KindNames names_of(std::string_view family, std::string_view kind);

/// Returns what makes a kind of a light, or in C the name of the struct.
template <class Kind>
std::string light_of_kind(Program& program, const Kind& kind) {
  const KindNames names = names_of("Light", schema::table<Kind>.name);
  Fields fields(program.syntax());
  RowWriter(program, fields).add_all(kind);
  // In C and Python a disc has a point that it faces.
  if constexpr (std::is_same_v<Kind, DiscLight>) {
    const bool has_normal = program.syntax().is_cpp() || program.syntax().is_script();
    if (!has_normal) fields.add_vector("", "pointing", kind.center + kind.normal);
  }
  return program.structure("light", program.syntax().is_python() ? names.python : names.cpp, fields,
                           names.c);
}

}  // namespace crt::source
