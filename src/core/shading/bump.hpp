// Bump mapping: a surface shaded as if a pattern had raised it. Source: Blinn, Simulation of
// wrinkled surfaces, SIGGRAPH 1978; here the height is a function of space, whose gradient tilts
// the normal.
#pragma once

#include <cstdint>

#include "core/shading/prepared_pattern.hpp"
#include "core/shading/uv_gradient.hpp"

namespace crt::core {

struct LuminanceGradient {
  Vec3 gradient{0, 0, 0};  ///< in object space, a covector
  int lookups = 0;         ///< of the pattern
};

/// How fast a pattern's luminance changes at a point, by central differences.
LuminanceGradient luminance_gradient(const PreparedPattern& pattern, const SurfacePoint& point,
                                     const Shape& shape, std::uint32_t face, CrossingList& scratch);

/// The normal of a surface raised along `normal` by a height of the given gradient, both in one
/// space.
Vec3 tilted_normal(const Vec3& normal, const Vec3& height_gradient);

/// `normal` if a viewer looking along `view` can see a surface turned like that; otherwise the
/// nearest normal of one that is just visible.
Vec3 visible_normal(const Vec3& normal, const Vec3& view);

}  // namespace crt::core
