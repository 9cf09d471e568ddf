// The lights of a scene. All cast shadows. `ambient` is the share of a light's colour that every
// point gets, lit or not (>= 0). `falloff` above 0 makes the light fade with the distance D as
// falloff / D^2, with D as Settings::falloff_model says. 0 or less means that distance does not
// matter.
//
// Lights with a size make soft shadows. Each camera ray sees them from one point of theirs or more
// (Settings::light_samples), so that shadows are noisy with few samples a pixel. A surface of
// radiance L that is seen under the projected solid angle W makes a white surface L W / pi bright.
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
  /// Above 0 it is a ball of this radius, in scene units, and softens shadows. What faces it gets
  /// as much light as of a point. It is not seen.
  double radius = 0;
};

/// A ParallelLight shines along the direction from `from` to `pointing` everywhere, like a sun.
struct ParallelLight {
  Vec3 from{0, 1, 0};
  Vec3 pointing{0, 0, 0};
  Color color = {1, 1, 1};
  double ambient = 0;
  /// Above 0 it shines from all directions of a cone about the first, and softens shadows. This is
  /// the full angle in radians, in [0, pi]; the sun's is 0.0093. What faces it gets as much light.
  double angle = 0;
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

/// A SphereLight is the surface of a sphere that shines outwards. Its colour is its radiance.
struct SphereLight {
  Vec3 center{0, 1, 0};
  double radius = 1;
  Color color = {1, 1, 1};
  /// Camera rays, mirrors and glass show it, in front of what is behind it. It blocks no light.
  bool visible = true;
};

/// A DiscLight is a disc that shines to the side of its normal, a vector of any length but 0. Its
/// colour is its radiance.
struct DiscLight {
  Vec3 center{0, 1, 0};
  Vec3 normal{0, -1, 0};
  double radius = 1;
  Color color = {1, 1, 1};
  bool visible = true;     ///< as a SphereLight's
  bool two_sided = false;  ///< it shines to both sides
};

/// A RectangleLight is the parallelogram from `corner` along two edges. It shines along the cross
/// product of the first and the second: to the side of z for x and y. The edges must not be
/// parallel. Its colour is its radiance.
struct RectangleLight {
  Vec3 corner{0, 1, 0};
  Vec3 edge_a{1, 0, 0};
  Vec3 edge_b{0, 0, 1};
  Color color = {1, 1, 1};
  bool visible = true;     ///< as a SphereLight's
  bool two_sided = false;  ///< it shines to both sides
};

/// An EnvironmentLight is the background, which without it is merely seen. It shines from all
/// directions, times `scale`; what it shows is not scaled.
struct EnvironmentLight {
  double scale = 1;
};

/// A Light is any of the lights.
using Light = std::variant<PointLight, ParallelLight, SpotLight, CylinderLight, SphereLight,
                           DiscLight, RectangleLight, EnvironmentLight>;

}  // namespace crt
