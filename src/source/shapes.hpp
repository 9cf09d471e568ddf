// Primitives become source code.
#pragma once

#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "crt/primitives.hpp"
#include "crt/schema.hpp"
#include "source/program.hpp"

namespace crt::source {

/// Returns the contours of a profile as a list in scripts, Python and C++.
std::string contour_lists(const Syntax& syntax, const Profile& profile);

/// An Argument is a field of a primitive, as C++ and as Python name it. C has those that Python
/// has, in their order. An empty name says that there is none.
struct Argument {
  std::string_view cpp;
  std::string_view python;
  std::variant<double, Vec3> value;
  bool is_angle = false;  ///< which Python has in degrees
};

/// A ShapeCode says how a primitive is made of numbers.
struct ShapeCode {
  std::string name;  ///< in C++ and Python
  std::string c;     ///< "sphere", of crt_sphere_create
  std::vector<Argument> arguments;
};

/// Returns how a primitive is made by the rows of the schema that are numbers.
template <class Kind>
ShapeCode shape_code_of(const Kind& it) {
  ShapeCode code{std::string(schema::table<Kind>.name),
                 std::string(schema::c_name(schema::table<Kind>.name).text()),
                 {}};
  schema::for_each_field<Kind>([&]<class Row>(const Row& row) {
    using Value = typename Row::Value;
    if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, Vec3>) {
      code.arguments.push_back({row.name, row.c_name(), it.*row.member, !row.uses.degrees.empty()});
    }
  });
  return code;
}

/// Returns how a primitive is made, but for what it shares with others: its profile, triangles,
/// heights or field.
ShapeCode shape_code(const Primitive& primitive);

/// Returns what makes a primitive, without its material. Throws Error (unsupported) for a Custom
/// shape.
std::string shape_value(Program& program, const Primitive& primitive);

/// Returns the material of a primitive, or null.
const std::optional<SharedMaterial>& material_of(const Primitive& primitive);

/// Returns a field as an expression of the CRT language. Throws Error (limit) if it has more than
/// so many bytes.
std::string field_text(const Field& field, std::size_t most_bytes);

/// Returns a field as scripts have it: an expression, or a call of a macro that is written before.
std::string field_value(Program& program, const Field& field);

/// Returns what makes a mesh, without its material.
std::string mesh_value(Program& program, const Mesh& mesh);

}  // namespace crt::source
