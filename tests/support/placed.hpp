// This is a primitive, and the transforms from it to the world.
#pragma once

#include <glm/geometric.hpp>
#include <vector>

#include "core/math/vector.hpp"
#include "core/prepare/prepared_data.hpp"
#include "crt/scene.hpp"
#include "support/numbers.hpp"

namespace crt::test {

template <class Primitive>
struct Placed {
  Primitive primitive;
  std::vector<Transform> steps;

  Entity entity() const {
    Entity entity = primitive;
    for (const Transform& step : steps) entity = entity.transformed(step);
    return entity;
  }
  Vec3 direction_to_world(Vec3 v) const {
    for (const Transform& step : steps) {
      v = {glm::dot(step.row_x, v), glm::dot(step.row_y, v), glm::dot(step.row_z, v)};
    }
    return v;
  }
  Vec3 to_place(Vec3 p) const {
    for (const Transform& step : steps) {
      p = Vec3(glm::dot(step.row_x, p), glm::dot(step.row_y, p), glm::dot(step.row_z, p)) +
          step.translation;
    }
    return p;
  }
};

/// Returns some transforms: not moved, moved, turned, or scaled unevenly.
inline std::vector<Transform> some_steps(Numbers& numbers, double scale) {
  std::vector<Transform> steps;
  const int kind = numbers.below(4);
  const Transform moved = translate(scale * numbers.point(numbers.below(2) == 0 ? 1 : 1e3));
  const Vec3 factors(numbers.size(0.1, 10), numbers.size(0.1, 10), numbers.size(0.1, 10));
  if (kind > 1) {
    steps = {kind == 2 ? crt::scale(numbers.size(0.1, 10)) : crt::scale(factors),
             rotate_degrees(numbers.point(180))};
  }
  if (kind > 0) steps.push_back(moved);
  return steps;
}

/// Makes a ray along d (in the primitive's own space) through a place of something of that size,
/// from nearby or afar.
template <class Primitive>
core::WorldRay ray_through(const Placed<Primitive>& placed, const Vec3& place, const Vec3& d,
                           double object_size, Numbers& numbers) {
  const double away =
      object_size * (numbers.below(4) == 0 ? numbers.within(-1, 1) : numbers.size(1, 1e6));
  core::WorldRay ray{.origin = placed.to_place(place - away * d),
                     .direction = placed.direction_to_world(d)};
  ray.direction /= core::largest_component(ray.direction);
  const double size = core::largest_component(ray.origin - placed.to_place(place));
  if (numbers.below(8) == 0) ray.direction *= numbers.size(1e-3, 1e3);
  if (numbers.below(8) == 0) ray.t_min = numbers.within(-1, 2) * size;
  if (numbers.below(8) == 0) ray.t_max = ray.t_min + numbers.within(0, 2) * size;
  return ray;
}

}  // namespace crt::test
