// The solids of a script that is to be written: objects, and what is made of others. The reader of
// each format makes them, and one writer writes them.
#pragma once

#include <crt/vec.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace crt::importing {

struct Solid;

/// Is null for what has no points.
using SharedSolid = std::shared_ptr<const Solid>;

struct Solid {
  enum class Kind {
    object,        ///< "Sphere", with attributes
    sum,           ///< a union
    difference,    ///< the first part without the others
    intersection,  ///< what all parts share
    changed,       ///< the only part, with modifiers
  };
  Kind kind = Kind::object;
  std::string type{};
  std::vector<std::string> texts{};  ///< attributes "radius -> 1", or modifiers "translate ..."
  std::vector<SharedSolid> parts{};
  std::string name{};  ///< what the file calls it, if it does
};

SharedSolid make_object(std::string_view type, std::vector<std::string> attributes);
SharedSolid make_sum(std::vector<SharedSolid> parts);
/// Parts without a point are left out. Without the first one nothing is left.
SharedSolid make_difference(std::vector<SharedSolid> parts);
/// With a part without a point nothing is left.
SharedSolid make_intersection(std::vector<SharedSolid> parts);
/// Applies modifiers in their order. Without any it is the solid.
SharedSolid make_changed(SharedSolid solid, const std::vector<std::string>& modifiers);
SharedSolid make_named(const SharedSolid& solid, const std::string& name);

/// Returns the shortest text that reads as the number, and no negative zero.
std::string number_text(double number);
/// Returns "vec3(1, 2, 3)".
std::string vector_text(const Vec3& v);
/// Returns "name -> value".
std::string attribute(std::string_view name, std::string_view value);
std::string attribute(std::string_view name, double value);
std::string attribute(std::string_view name, const Vec3& value);
/// Returns "[a, b]".
std::string list_text(const std::vector<std::string>& items);
/// Returns a string literal of scripts.
std::string quoted_text(std::string_view text);

/// A Faces is a solid that flat faces enclose.
struct Faces {
  std::vector<Vec3> points{};
  std::vector<std::vector<std::uint32_t>> faces{};
};
SharedSolid make_polyhedron(const Faces& faces);

}  // namespace crt::importing
