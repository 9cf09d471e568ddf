// The gradients of a surface's (u, v) turn a picture laid over it into a bump map.
#pragma once

#include "core/geometry/shape.hpp"

namespace crt::core {

/// A UvGradient has gradients within the surface, in object space, per unit of length.
struct UvGradient {
  Vec3 u{0, 0, 0};
  Vec3 v{0, 0, 0};
};

/// Computes the gradients at a point of a face, by asking the shape for (u, v) of points beside it.
/// They are 0 where there are none. `normal` is the face's there, of unit length and either sign.
/// `scratch` is memory to reuse.
UvGradient uv_gradient(const Shape& shape, std::uint32_t face, const Vec3& position,
                       const Vec3& normal, CrossingList& scratch);

}  // namespace crt::core
