// Vectors of a plane.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace crt::core {

using Vec2 = glm::dvec2;

/// Returns a x b for vectors of the plane.
inline double cross(const Vec2& a, const Vec2& b) {
  return a.x * b.y - a.y * b.x;
}

/// Returns v turned by a quarter of a turn from x to y.
inline Vec2 quarter_turned(const Vec2& v) {
  return {-v.y, v.x};
}

}  // namespace crt::core
