// Some primitives have no size: a sphere of radius 0, a flat box. Scripts may make them, as
// animations do that begin with nothing. The core's shapes all have a size.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "crt/schema_primitives.hpp"
#include "text/format.hpp"

namespace crt::lang {

/// Says why a primitive has no size.
struct NoSize {
  std::string_view attribute;  ///< the attribute of the script's object that is the cause
  std::string reason;          ///< what it does: "is 0"
};

/// Replaces a length of 0 by another length.
inline std::optional<NoSize> size_given(double& length, std::string_view attribute) {
  if (length != 0) return std::nullopt;
  length = 1;
  return NoSize{attribute, "is 0"};
}

/// Replaces lengths of 0 likewise.
inline std::optional<NoSize> sizes_given(Vec3& lengths, std::string_view attribute) {
  std::optional<NoSize> found;
  for (int axis = 0; axis < 3; ++axis) {
    if (size_given(lengths[axis], attribute)) found = NoSize{attribute, "has a 0"};
  }
  return found;
}

/// Separates two ends at one place.
inline std::optional<NoSize> size_given(const Vec3& from, Vec3& to) {
  if (from != to) return std::nullopt;
  to = from == Vec3(0) ? Vec3(1) : Vec3(0);
  return NoSize{"to", "is the same point as 'from'"};
}

/// Moves a corner of a flat box.
inline std::optional<NoSize> corner_moved(const Vec3& corner, std::string_view other,
                                          Vec3& opposite, std::string_view attribute) {
  bool is_flat = false;
  for (int axis = 0; axis < 3; ++axis) {
    if (corner[axis] != opposite[axis]) continue;
    is_flat = true;
    opposite[axis] = opposite[axis] == 0 ? 1 : 0;
  }
  if (!is_flat) return std::nullopt;
  return NoSize{attribute, text::format("does not differ from '{}' in every coordinate",
                                        schema::script_name(other).text())};
}

// These give a size to what the rules of the schema do not know to be a length.

template <class Shape>
std::optional<NoSize> give_own_size(Shape&) {
  return std::nullopt;
}

inline std::optional<NoSize> give_own_size(Cylinder& cylinder) {
  return size_given(cylinder.from, cylinder.to);
}

inline std::optional<NoSize> give_own_size(Cone& cone) {
  auto height = size_given(cone.from, cone.to);
  if (cone.radius == 0 && cone.radius2 > 0) {
    // Its tip is where other cones have their base.
    std::swap(cone.from, cone.to);
    std::swap(cone.radius, cone.radius2);
  }
  return height;
}

inline std::optional<NoSize> give_own_size(Extrusion& extrusion) {
  return size_given(extrusion.to, "height");
}

inline std::optional<NoSize> give_own_size(Revolution& revolution) {
  return size_given(revolution.angle, "angle");
}

inline std::optional<NoSize> give_own_size(RoundedBox& box) {
  // No radius fits the shortest side of a flat one, which is moved below.
  for (int axis = 0; axis < 3; ++axis) {
    if (box.corner_a[axis] == box.corner_b[axis]) box.radius = std::min(box.radius, 0.0);
  }
  return std::nullopt;
}

/// Gives a primitive without a size one, so that all else about it can be checked as usual.
template <class Shape>
std::optional<NoSize> give_size(Shape& shape) {
  const std::optional<NoSize> own = give_own_size(shape);
  std::optional<NoSize> found;
  schema::for_each_field<Shape>([&]<class Row>(const Row& row) {
    const auto note = [&found](std::optional<NoSize> no_size) {
      if (!found) found = std::move(no_size);
    };
    if constexpr (std::is_same_v<typename Row::Value, double>) {
      if (row.rule.kind == schema::Rule::length)
        note(size_given(shape.*row.member, row.script_name()));
    } else if constexpr (std::is_same_v<typename Row::Value, Vec3>) {
      if (row.rule.kind == schema::Rule::length)
        note(sizes_given(shape.*row.member, row.script_name()));
      if (row.rule.kind == schema::Rule::corner)
        note(corner_moved(schema::value_of<Vec3>(shape, row.rule.other), row.rule.other,
                          shape.*row.member, row.script_name()));
    }
  });
  return found ? found : own;
}

}  // namespace crt::lang
