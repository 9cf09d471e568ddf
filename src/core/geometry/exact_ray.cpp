#include "core/geometry/exact_ray.hpp"

#include "core/math/vector.hpp"

namespace crt::core {
ExactLine ExactRay::exact() const {
  if (escalations != nullptr) ++*escalations;
  ExactLine line;
  line.origin = exactly(world_origin);
  line.direction = exactly(world_direction);
  if (to_world == nullptr) return line;
  const DyadicTransform map = chain != nullptr ? exact_product(*chain) : exactly(*to_world);
  line.origin = line.origin - map.translation;
  if (chain == nullptr && *to_world == Transform{.translation = to_world->translation}) return line;
  const DyadicInverse inverse(map);
  line.weight = inverse.weight;
  line.origin = inverse * line.origin;
  line.direction = inverse * line.direction;
  return line;
}

double ExactRay::point_error(const Vec3& center, double t) const {
  const double along = std::abs(t) * largest_component(near.direction);
  return precise_roundoff * (largest_component(near.origin) + largest_component(center) + along) +
         origin_error + std::abs(t) * direction_error;
}

PreciseVec3 precise_from_center(const ObjectRay& ray, const Vec3& center, DoubleDouble t) {
  PreciseVec3 result;
  for (int axis = 0; axis < 3; ++axis) {
    const DoubleDouble offset = two_sum(ray.origin[axis], -center[axis]);
    const DoubleDouble along = two_product(t.hi, ray.direction[axis]);
    const DoubleDouble sum = two_sum(offset.hi, along.hi);
    const double low =
        ray.origin_low[axis] + std::fma(t.hi, ray.direction_low[axis], t.lo * ray.direction[axis]);
    result[static_cast<std::size_t>(axis)] = two_sum(sum.hi, sum.lo + (offset.lo + along.lo + low));
  }
  return result;
}

}  // namespace crt::core
