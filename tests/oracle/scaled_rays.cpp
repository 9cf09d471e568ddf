#include "oracle/scaled_rays.hpp"

#include <cmath>

#include "core/math/vector.hpp"

namespace crt::test {

void round_scaled(TestRay& ray) {
  ray.direction = (ray.scale * ray.direction) * (1 / ray.scale);
}

void scale_direction(Counted& random, TestRay& ray) {
  // If components differ by more, a line meets a plane where no number can say.
  constexpr double farthest = 280;
  const Vec3 before = ray.direction;
  const int axis = random.integer(0, 2);
  const int form = random.integer(0, 3);
  if (form > 0) ray.direction[axis] *= random.power_of_ten(-farthest, 0);
  if (form > 2) ray.direction[(axis + 1) % 3] *= random.power_of_ten(-farthest, 0);
  // The numbers that t is compared with take it with its largest component near 1.
  const double largest = core::largest_component(ray.direction);
  const int exponent = largest > 0 ? std::ilogb(largest) : 0;
  for (int i = 0; i < 3; ++i) ray.direction[i] = std::scalbn(ray.direction[i], -exponent);
  constexpr int max_powers = 850;
  ray.scale = std::ldexp(1.0, random.integer(-max_powers, max_powers));
  ray.kind = RayKind::extreme_length;
  round_scaled(ray);
  if (ray.direction == Vec3(0)) ray.direction = before;
  round_scaled(ray);
}

}  // namespace crt::test
