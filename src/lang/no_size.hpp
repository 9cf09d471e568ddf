// Some primitives have no size: a sphere of radius 0, a flat box. Scripts may make them, as
// animations do that begin with nothing. The core's shapes all have a size.
#pragma once

#include <optional>
#include <string_view>
#include <utility>

#include "crt/primitives.hpp"

namespace crt::lang {

/// Says why a primitive has no size.
struct NoSize {
  std::string_view attribute;  ///< the attribute of the script's object that is the cause
  std::string_view reason;     ///< what it does: "is 0"
};

/// Replaces a length of 0 by another length.
inline std::optional<NoSize> size_given(double& length, std::string_view attribute) {
  if (length != 0) return std::nullopt;
  length = 1;
  return NoSize{attribute, "is 0"};
}

/// Separates two ends at one place.
inline std::optional<NoSize> size_given(const Vec3& from, Vec3& to) {
  if (from != to) return std::nullopt;
  to = from == Vec3(0) ? Vec3(1) : Vec3(0);
  return NoSize{"to", "is the same point as 'from'"};
}

// If the primitive has no size these give it one, so that all else about it can be checked as
// usual.

template <class Shape>
std::optional<NoSize> give_size(Shape&) {
  return std::nullopt;
}

inline std::optional<NoSize> give_size(Sphere& sphere) {
  return size_given(sphere.radius, "radius");
}

inline std::optional<NoSize> give_size(Disc& disc) {
  return size_given(disc.radius, "radius");
}

inline std::optional<NoSize> give_size(Box& box) {
  bool is_flat = false;
  for (int axis = 0; axis < 3; ++axis) {
    if (box.corner_a[axis] != box.corner_b[axis]) continue;
    is_flat = true;
    box.corner_b[axis] = box.corner_a[axis] == 0 ? 1 : 0;
  }
  if (!is_flat) return std::nullopt;
  return NoSize{"cornerB", "does not differ from 'cornerA' in every coordinate"};
}

inline std::optional<NoSize> give_size(Cylinder& cylinder) {
  const auto height = size_given(cylinder.from, cylinder.to);
  const auto radius = size_given(cylinder.radius, "radius");
  return radius ? radius : height;
}

inline std::optional<NoSize> give_size(Capsule& capsule) {
  return size_given(capsule.radius, "radius");
}

inline std::optional<NoSize> give_size(Cone& cone) {
  const auto height = size_given(cone.from, cone.to);
  if (cone.radius == 0 && cone.radius2 > 0) {
    // Its tip is where other cones have their base.
    std::swap(cone.from, cone.to);
    std::swap(cone.radius, cone.radius2);
  }
  const auto radius = size_given(cone.radius, "radius");
  return radius ? radius : height;
}

inline std::optional<NoSize> give_size(Extrusion& extrusion) {
  return size_given(extrusion.to, "height");
}

inline std::optional<NoSize> give_size(Revolution& revolution) {
  return size_given(revolution.angle, "angle");
}

inline std::optional<NoSize> give_size(Torus& torus) {
  const auto thickness = size_given(torus.thickness, "thickness");
  const auto radius = size_given(torus.radius, "radius");
  return radius ? radius : thickness;
}

}  // namespace crt::lang
