// The vector type of the whole library is three doubles, from GLM.
#pragma once

#include <glm/vec3.hpp>

namespace crt {

/// A Vec3 is a point, direction or extent: x to the right, y up, z into the screen (left-handed),
/// in scene units. It is glm::dvec3, and stays without padding where a program defines
/// GLM_FORCE_DEFAULT_ALIGNED_GENTYPES: the library was built without.
using Vec3 = glm::vec<3, double, glm::packed_highp>;

static_assert(
    sizeof(Vec3) == 3 * sizeof(double) && alignof(Vec3) == alignof(double),
    "CRT's library takes vectors for three doubles without padding, and GLM is configured "
    "otherwise here: include CRT's headers without GLM_FORCE_ALIGNED_GENTYPES and the like");

}  // namespace crt
