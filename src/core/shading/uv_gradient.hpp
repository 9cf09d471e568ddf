// How a surface's (u, v) change from point to point: what a picture laid over it needs to be a
// bump.
#pragma once

#include "core/geometry/shape.hpp"

namespace crt::core {

/// Gradients within the surface, in object space, per unit of length.
struct UvGradient {
  Vec3 u{0, 0, 0};
  Vec3 v{0, 0, 0};
};

/// At a point of a face, by asking the shape for (u, v) of points beside it; 0 where it has none.
/// `normal` is the face's there, of unit length and either sign; `scratch` is memory to reuse.
UvGradient uv_gradient(const Shape& shape, std::uint32_t face, const Vec3& position,
                       const Vec3& normal, CrossingList& scratch);

}  // namespace crt::core
