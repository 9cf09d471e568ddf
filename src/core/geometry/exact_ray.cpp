#include "core/geometry/exact_ray.hpp"

#include "core/math/vector.hpp"

namespace crt::core {
ExactLine ExactRay::exact() const {
  if (escalations != nullptr) ++*escalations;
  ExactLine line;
  line.origin = exactly(world_origin);
  line.direction = exactly(world_direction);
  if (to_world == nullptr) return line;
  line.origin = line.origin - exactly(to_world->translation);
  if (*to_world == Transform{.translation = to_world->translation}) return line;

  // Cramer's rule: the columns of the inverse times the determinant are cross products of the rows.
  const DyadicVector x = exactly(to_world->row_x);
  const DyadicVector y = exactly(to_world->row_y);
  const DyadicVector z = exactly(to_world->row_z);
  const DyadicVector yz = cross(y, z);
  const DyadicVector zx = cross(z, x);
  const DyadicVector xy = cross(x, y);
  line.weight = dot(x, yz);
  const bool mirrored = line.weight.sign() < 0;
  if (mirrored) line.weight = -line.weight;
  const auto solve = [&](const DyadicVector& v) {
    DyadicVector result;
    for (std::size_t i = 0; i < 3; ++i) {
      result[i] = yz[i] * v[0] + zx[i] * v[1] + xy[i] * v[2];
      if (mirrored) result[i] = -result[i];
    }
    return result;
  };
  line.origin = solve(line.origin);
  line.direction = solve(line.direction);
  return line;
}

double ExactRay::point_error(const Vec3& center, double t) const {
  const double way = std::abs(t) * largest_component(near.direction);
  return precise_roundoff * (largest_component(near.origin) + largest_component(center) + way) +
         origin_error + std::abs(t) * direction_error;
}

PreciseVec3 precise_from_center(const ObjectRay& ray, const Vec3& center, DoubleDouble t) {
  PreciseVec3 result;
  for (int axis = 0; axis < 3; ++axis) {
    const DoubleDouble offset = two_sum(ray.origin[axis], -center[axis]);
    const DoubleDouble way = two_product(t.hi, ray.direction[axis]);
    const DoubleDouble sum = two_sum(offset.hi, way.hi);
    const double low =
        ray.origin_low[axis] + std::fma(t.hi, ray.direction_low[axis], t.lo * ray.direction[axis]);
    result[static_cast<std::size_t>(axis)] = two_sum(sum.hi, sum.lo + (offset.lo + way.lo + low));
  }
  return result;
}

}  // namespace crt::core
