// The vector type of the whole library is three doubles, from GLM.
#pragma once

#include <glm/vec3.hpp>

namespace crt {

/// A Vec3 is a point, direction or extent: x to the right, y up, z into the screen (left-handed),
/// in scene units.
using Vec3 = glm::dvec3;

}  // namespace crt
