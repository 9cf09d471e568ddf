#include "oracle/ruling_rays.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace crt::test {
namespace {

constexpr double farthest_proportion = 6;  // a power of ten

double log_uniform_tilt(Counted& random) {
  const double size = random.power_of_ten(-16, -1);
  return size * random.sign();
}

/// Returns an axis. One in eight is next to a coordinate axis, and Counted::direction() has those
/// themselves.
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

/// Returns a unit vector across `v`: anywhere, or one of the first two turns of a coordinate axis
/// without rounding.
Vec3 any_across(Counted& random, const Vec3& v) {
  const Vec3 n = glm::normalize(v);
  const Vec3 other = std::abs(n.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 a = glm::normalize(glm::cross(n, other));
  const Vec3 b = glm::cross(n, a);
  if (random.integer(0, 7) == 0) {
    const double sign = random.sign();
    return sign * (random.integer(0, 1) == 0 ? a : b);
  }
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  return std::cos(angle) * a + std::sin(angle) * b;
}

/// Returns where along a ruling, from 0 at `from` to 1 at `to`.
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

TestRay ray_along(Counted& random, const Cone& cone) {
  const double radius = std::max(cone.radius, cone.radius2);
  const double size = std::max(glm::length(cone.to - cone.from), radius);
  const Ruling ruling(random, cone);
  Vec3 target = ruling.at(any_share(random));
  Vec3 d = random.sign() * ruling.direction;

  const bool shifted = random.integer(0, 3) != 0;
  const bool turned = random.integer(0, 3) != 0;
  const auto any_way = [&]() -> Vec3 {
    switch (random.integer(0, 2)) {
      case 0:
        return ruling.normal;
      case 1:
        return glm::cross(ruling.normal, ruling.direction);
      default:
        return random.direction();
    }
  };
  if (shifted) {
    const double unit = random.integer(0, 1) == 0 ? size : radius;
    const double shift = unit * log_uniform_tilt(random);
    target += shift * any_way();
  }
  if (turned) {
    const double turn = log_uniform_tilt(random);
    d += turn * any_way();
  }

  TestRay ray;
  ray.kind = RayKind::along_ruling;
  const double exponent = random.uniform(lowest_decade, highest_decade + 1);
  ray.decade = static_cast<int>(std::floor(exponent));
  if (random.integer(0, 2) == 0) {
    ray.origin = target;
    ray.direction = d * random.uniform(0.5, 2);
    return ray;
  }
  // The line starts from the rounded origin, so that it still passes the target.
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

void make_extreme(Counted& random, const Vec3& at, double size, Capsule& c) {
  Cylinder side;
  make_extreme(random, at, size, side);
  c.from = side.from;
  c.to = side.to;
  c.radius = side.radius;
}

Ruling::Ruling(Counted& random, const Cone& cone) {
  const Vec3 axis = cone.to - cone.from;
  const double height = glm::length(axis);
  const double growth = cone.radius2 - cone.radius;
  const Vec3 out = any_across(random, axis);
  from = cone.from + cone.radius * out;
  way = axis + growth * out;
  direction = glm::normalize(way);
  normal = glm::normalize(height * out - growth * (axis / height));
}

TestRay make_ruling_ray(Counted& random, const Cylinder& cylinder) {
  TestRay ray = ray_along(random, {.from = cylinder.from,
                                   .to = cylinder.to,
                                   .radius = cylinder.radius,
                                   .radius2 = cylinder.radius});
  ray.primitive = cylinder;
  return ray;
}

TestRay make_ruling_ray(Counted& random, const Capsule& capsule) {
  TestRay ray = make_ruling_ray(
      random, Cylinder{.from = capsule.from, .to = capsule.to, .radius = capsule.radius});
  ray.primitive = capsule;
  return ray;
}

TestRay make_ruling_ray(Counted& random, const Cone& cone) {
  TestRay ray = ray_along(random, cone);
  ray.primitive = cone;
  return ray;
}

}  // namespace crt::test
