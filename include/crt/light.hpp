// The lights of a scene. All cast shadows. `ambient` is the share of a light's colour that every
// point gets, lit or not (>= 0). `falloff` above 0 makes the light fade with the distance D as
// falloff / D^2, with D as Settings::falloff_model says. 0 or less means that distance does not
// matter.
#pragma once

#include <crt/color.hpp>
#include <crt/vec.hpp>
#include <numbers>
#include <variant>

namespace crt {

/// A PointLight shines from a point in all directions.
struct PointLight {
  Vec3 origin{0, 0, 0};
  Color color = {1, 1, 1};
  double falloff = 0;
  double ambient = 0;
};

/// A ParallelLight shines along the direction from `from` to `pointing` everywhere, like a sun.
struct ParallelLight {
  Vec3 from{0, 1, 0};
  Vec3 pointing{0, 0, 0};
  Color color = {1, 1, 1};
  double ambient = 0;
};

/// A SpotLight shines from a point into a cone about the direction to `pointing`.
struct SpotLight {
  Vec3 origin{0, 1, 0};
  Vec3 pointing{0, 0, 0};
  Color color = {1, 1, 1};
  /// This is the full angle of the cone in radians, in (0, 2 pi].
  double angle = std::numbers::pi / 3;
  /// Says how far the light fades inwards from the cone's edge, in radians of the half angle, in
  /// [0, angle / 2].
  double penumbra = std::numbers::pi / 36;
  double falloff = 0;
  double ambient = 0;
};

/// A CylinderLight sends parallel rays that fill a cylinder starting at `origin` towards
/// `pointing`. Falloff counts the distance along the axis.
struct CylinderLight {
  Vec3 origin{0, 1, 0};
  Vec3 pointing{0, 0, 0};
  Color color = {1, 1, 1};
  double radius = 1;
  double falloff = 0;
  double ambient = 0;
};

/// A Light is any of the lights.
using Light = std::variant<PointLight, ParallelLight, SpotLight, CylinderLight>;

}  // namespace crt
