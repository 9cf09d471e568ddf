// These are objects of all kinds, close together and through each other, to try rays on.
#pragma once

#include <cstddef>
#include <glm/geometric.hpp>
#include <vector>

#include "crt/scene.hpp"
#include "support/numbers.hpp"

namespace crt::test {

/// A Target is a place to aim at, and how far its edge is from it. If it is a torus (or, without a
/// ring, a sphere, or if it has a length a cylinder) lines can run along its surface.
struct Target {
  Vec3 center;
  double reach;
  Vec3 axis{0, 0, 0};
  double ring = 0;
  double tube = 0;
  double half_length = 0;
};

struct Crowd {
  Scene scene;
  std::vector<Target> targets;

  void add(const Entity& entity, const Vec3& center, double reach) {
    scene.entities.push_back(entity);
    targets.push_back({center, reach});
  }
};

inline Crowd crowd(Numbers& numbers, Precision precision) {
  Crowd crowd;
  crowd.scene.settings.precision = precision;
  for (int i = 0; i < 40; ++i) {
    const Vec3 center = numbers.point(4);
    const double size = numbers.size(0.01, 1.5);
    crowd.add(Sphere{.center = center, .radius = size}, center, size);
    crowd.targets.back().axis = {0, 1, 0};
    crowd.targets.back().tube = size;
    // One copy coincides with it, and one is turned as well.
    if (i % 8 == 0) crowd.add(Sphere{.center = center, .radius = size}, center, size);
    const Transform turned = rotate_degrees(numbers.point(180));
    if (i % 5 == 0) crowd.add(Entity(Sphere{.radius = size}).transformed(turned), Vec3(0), size);
  }
  for (int i = 0; i < 20; ++i) {
    const Vec3 center = numbers.point(4);
    const double ring = numbers.size(0.1, 1.5);
    const double tube = ring * numbers.size(0.02, 1.5);
    const double factor = numbers.size(0.2, 3);
    const Transform turned = rotate_degrees(numbers.point(180));
    const Vec3 axis = numbers.direction();
    Entity torus = Entity(Torus{.axis = axis, .radius = ring, .thickness = tube})
                       .transformed(scale(i % 4 == 0 ? Vec3(factor, 1, 1) : Vec3(factor)))
                       .transformed(turned)
                       .transformed(translate(center));
    crowd.add(torus, center, factor * (ring + tube));
    if (i % 4 == 0) continue;
    Target& target = crowd.targets.back();
    target.axis = {glm::dot(turned.row_x, axis), glm::dot(turned.row_y, axis),
                   glm::dot(turned.row_z, axis)};
    target.ring = factor * ring;
    target.tube = factor * tube;
  }
  for (int i = 0; i < 30; ++i) {
    const Vec3 center = numbers.point(4);
    const Vec3 axis = numbers.direction();
    const double half_length = numbers.size(0.1, 3);
    const double radius = half_length * numbers.size(1e-4, 0.4);
    const Vec3 from = center - half_length * axis;
    const Vec3 to = center + half_length * axis;
    const Transform scaled = scale(Vec3(numbers.size(0.2, 3)));
    if (i % 3 == 0)
      crowd.add(Cylinder{.from = from, .to = to, .radius = radius}, center, half_length);
    if (i % 3 == 1) {
      crowd.add(
          Cone{.from = from, .to = to, .radius = radius, .radius2 = radius * numbers.within(0, 1)},
          center, half_length);
    }
    if (i % 3 == 2) {
      const Vec3 corner(radius, half_length, radius / 2);
      const Entity bar = Entity(Box{.corner_a = -corner, .corner_b = corner});
      crowd.add(bar.transformed(rotate_degrees(numbers.point(180)))
                    .transformed(scaled)
                    .transformed(translate(center)),
                center, half_length);
      continue;
    }
    Target& target = crowd.targets.back();
    target.axis = axis;
    target.tube = radius;
    target.half_length = half_length;
  }
  for (int i = 0; i < 10; ++i) {
    const Vec3 center = numbers.point(4);
    const double size = numbers.size(0.05, 0.8);
    const Entity box =
        Box{.corner_a = center - Vec3(size), .corner_b = center + Vec3(size, size / 2, size)};
    const Entity ball = Sphere{.center = center + Vec3(size / 2), .radius = size};
    const Entity other = Sphere{.center = center - Vec3(size / 2), .radius = size};
    crowd.add(i % 3 == 0 ? box : i % 3 == 1 ? box - ball : ball ^ other, center, size);
    crowd.add(Disc{.center = center, .normal = numbers.direction(), .radius = 2 * size}, center,
              2 * size);
  }
  crowd.scene.entities.emplace_back(Plane{.normal = {0, 1, 0}, .position = {0, -3, 0}});
  crowd.scene.entities.emplace_back(Plane{.normal = {0.3, 1, -0.2}, .position = {0, -2, 0}});
  return crowd;
}

/// Keeps so many objects of a crowd.
inline void keep(Crowd& crowd, std::size_t count, Numbers& numbers) {
  std::vector<Entity>& entities = crowd.scene.entities;
  while (entities.size() > count) {
    const int index = numbers.below(static_cast<int>(entities.size()));
    entities.erase(entities.begin() + index);
  }
}

}  // namespace crt::test
