#include "oracle/ruling_rays.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace crt::test {
namespace {

constexpr double farthest_proportion = 6;  // a power of ten

double log_uniform_tilt(Counted& random) {
  return random.power_of_ten(-16, -1) * random.sign();
}

/// One in eight is next to a coordinate axis, and Counted::direction() has those themselves.
Vec3 any_axis(Counted& random) {
  const Vec3 axis = random.direction();
  if (random.integer(0, 7) != 0) return axis;
  Vec3 nearly(0);
  nearly[random.integer(0, 2)] = random.sign();
  return nearly + log_uniform_tilt(random) * axis;
}

struct Proportions {
  double height;
  double radius;
};
Proportions any_proportions(Counted& random, double size) {
  const double less = size * random.power_of_ten(-farthest_proportion, 0);
  return random.integer(0, 1) == 0 ? Proportions{size, less} : Proportions{less, size};
}

/// A unit vector across `v`: anywhere, or one of the first two turns of a coordinate axis without rounding.
Vec3 any_across(Counted& random, const Vec3& v) {
  const Vec3 n = glm::normalize(v);
  const Vec3 other = std::abs(n.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 a = glm::normalize(glm::cross(n, other));
  const Vec3 b = glm::cross(n, a);
  if (random.integer(0, 7) == 0) return random.sign() * (random.integer(0, 1) == 0 ? a : b);
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  return std::cos(angle) * a + std::sin(angle) * b;
}

/// Where along a ruling, from 0 at `from` to 1 at `to`.
double any_share(Counted& random) {
  switch (random.integer(0, 7)) {
    case 0:
      return -random.power_of_ten(-16, 3);
    case 1:
      return 1 + random.power_of_ten(-16, 3);
    case 2:
      return random.power_of_ten(-16, 0);
    case 3:
      return 1 - random.power_of_ten(-16, 0);
    default:
      return random.uniform(0, 1);
  }
}

TestRay ray_along(Counted& random, const Vec3& from, const Vec3& to, double r1, double r2) {
  const Vec3 axis = to - from;
  const double height = glm::length(axis);
  const double size = std::max({height, r1, r2});
  const Vec3 out = any_across(random, axis);
  const Vec3 ruling = glm::normalize(axis + (r2 - r1) * out);
  const double share = any_share(random);
  Vec3 target = from + share * axis + (r1 + (r2 - r1) * share) * out;
  Vec3 d = random.sign() * ruling;

  const bool shifted = random.integer(0, 3) != 0;
  const bool turned = random.integer(0, 3) != 0;
  const Vec3 normal = glm::normalize(height * out + (r1 - r2) * (axis / height));
  const auto any_way = [&]() -> Vec3 {
    switch (random.integer(0, 2)) {
      case 0:
        return normal;
      case 1:
        return glm::cross(normal, ruling);
      default:
        return random.direction();
    }
  };
  if (shifted) {
    const double unit = random.integer(0, 1) == 0 ? size : std::max(r1, r2);
    target += unit * log_uniform_tilt(random) * any_way();
  }
  if (turned) d += log_uniform_tilt(random) * any_way();

  TestRay ray;
  ray.kind = RayKind::along_ruling;
  const double exponent = random.uniform(lowest_decade, highest_decade + 1);
  ray.decade = static_cast<int>(std::floor(exponent));
  if (random.integer(0, 2) == 0) {
    ray.origin = target;
    ray.direction = d * random.uniform(0.5, 2);
    return ray;
  }
  // From where the origin comes to be, so that the line still passes the target.
  ray.origin = target - size * std::pow(10.0, exponent) * d;
  ray.direction = target - ray.origin;
  if (random.integer(0, 3) == 0) ray.direction = glm::normalize(ray.direction);
  return ray;
}

}  // namespace

void make_extreme(Counted& random, const Vec3& at, double size, Cylinder& c) {
  const Proportions proportions = any_proportions(random, size);
  c.from = at;
  c.to = at + proportions.height * any_axis(random);
  c.radius = proportions.radius;
}

void make_extreme(Counted& random, const Vec3& at, double size, Cone& c) {
  const Proportions proportions = any_proportions(random, size);
  c.from = at;
  c.to = at + proportions.height * any_axis(random);
  c.radius = proportions.radius;
  switch (random.integer(0, 3)) {
    case 0:
      c.radius2 = 0;
      break;
    case 1:
      c.radius2 = c.radius * random.power_of_ten(-farthest_proportion, 0);
      break;
    case 2:
      c.radius2 = c.radius * (1 - random.power_of_ten(-16, 0));
      break;
    default:
      c.radius2 = c.radius * random.uniform(0, 1);
      break;
  }
  if (c.radius2 > 0 && random.integer(0, 1) == 0) std::swap(c.radius, c.radius2);
}

TestRay make_ruling_ray(Counted& random, const Cylinder& cylinder) {
  TestRay ray = ray_along(random, cylinder.from, cylinder.to, cylinder.radius, cylinder.radius);
  ray.primitive = cylinder;
  return ray;
}

TestRay make_ruling_ray(Counted& random, const Cone& cone) {
  TestRay ray = ray_along(random, cone.from, cone.to, cone.radius, cone.radius2);
  ray.primitive = cone;
  return ray;
}

}  // namespace crt::test
