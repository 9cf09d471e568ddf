#include "core/geometry/angles.hpp"

#include "core/math/vector.hpp"

namespace crt::core {

AxisFrame frame_about(const Vec3& axis) {
  const Vec3 along = unit_vector(axis);
  const Vec3 size = glm::abs(along);
  Vec3 start(0, 0, 1);
  if (size.z > size.x && size.z > size.y) start = {1, 0, 0};
  const Vec3 zero = unit_vector(start - along * glm::dot(along, start));
  return {zero + Vec3(0.0), accurate_cross(along, zero) + Vec3(0.0), along};
}

}  // namespace crt::core
