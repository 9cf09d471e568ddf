// Bump mapping shades a surface as if a pattern had raised it. Here the height is a function of
// space, whose gradient tilts the normal.
//
// Source: Blinn, Simulation of wrinkled surfaces, SIGGRAPH 1978.
#pragma once

#include <cstdint>

#include "core/shading/prepared_pattern.hpp"
#include "core/shading/uv_gradient.hpp"

namespace crt::core {

struct LuminanceGradient {
  Vec3 gradient{0, 0, 0};  ///< in object space, a covector
  int lookups = 0;         ///< how often the pattern was looked up
};

/// Returns how fast a pattern's luminance changes at a point, by central differences.
LuminanceGradient luminance_gradient(const PreparedPattern& pattern, const SurfacePoint& point,
                                     const Shape& shape, std::uint32_t face, CrossingList& scratch);

/// Returns the normal of a surface raised along `normal` by a height of the given gradient, both in
/// one space.
Vec3 tilted_normal(const Vec3& normal, const Vec3& height_gradient);

/// Returns the normal that a colour of a normal map stands for, at a surface with that normal and
/// those gradients of (u, v), all in one space. Where (u, v) do not change it is the normal itself.
///
/// Source: Blinn, 1978, for the frame of the surface. The colours are those that glTF 2.0 has for
/// normal textures (section 3.9.3).
Vec3 mapped_normal(const Vec3& normal, const UvGradient& uv, const Rgb& color);

/// Returns `normal` if a viewer looking along `view` can see a surface turned like that. Otherwise
/// it returns the nearest normal of one that is just visible.
Vec3 visible_normal(const Vec3& normal, const Vec3& view);

}  // namespace crt::core
