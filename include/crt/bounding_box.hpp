// A BoundingBox is what an entity, or a custom shape, lies within.
#pragma once

#include <crt/vec.hpp>

namespace crt {

/// A BoundingBox is an axis-parallel box. What has no points has lower > upper, and what reaches to
/// infinity has infinite sides.
struct BoundingBox {
  Vec3 lower{0, 0, 0};
  Vec3 upper{0, 0, 0};
};

}  // namespace crt
