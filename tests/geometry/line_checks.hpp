// Tests of shapes with many faces share these lines, and what they check of crossings.
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/geometry/shape.hpp"
#include "core/math/vector.hpp"
#include "crt/query.hpp"
#include "geometry/oracle.hpp"

namespace crt::test {

inline core::CrossingList crossings(const core::Shape& shape, const core::ObjectRay& ray) {
  core::CrossingList result;
  REQUIRE_FALSE(shape.crossings(ray, result));
  return result;
}

inline bool are_alike(const core::Crossing& a, const core::Crossing& b) {
  return a.t == b.t && a.t_low == b.t_low && a.error == b.error && a.face == b.face &&
         a.entering == b.entering;
}

/// Returns a ray of small whole numbers, of which many pass through corners, along faces or through
/// the y axis, or any ray.
inline core::ObjectRay hard_ray(Random& random) {
  const auto whole = [&] { return std::floor(random.uniform(-5, 5)); };
  core::ObjectRay ray;
  ray.origin = {whole(), whole(), whole()};
  do {
    ray.direction = {whole(), whole(), whole()};
    for (int axis = 0; axis < 3; ++axis) {
      if (random.one_in(4)) ray.direction[axis] = 0;
    }
  } while (core::largest_component(ray.direction) == 0);
  if (random.one_in(4)) ray.origin.x = ray.origin.z = 0;
  if (random.one_in(3)) ray.origin += 0.5 * random.in_cube();
  if (random.one_in(3)) ray.direction += random.in_cube();
  return ray;
}

/// Checks that hits come in order, enter and leave by turns, and face the ray as their normals say.
inline void check_turns(const std::vector<Hit>& hits, const Ray& ray) {
  REQUIRE(hits.size() % 2 == 0);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    REQUIRE(hits[i].entering == (i % 2 == 0));
    if (i > 0) REQUIRE(hits[i - 1].t <= hits[i].t);
    const double along = glm::dot(hits[i].normal, ray.direction) / glm::length(ray.direction);
    if (std::abs(along) > 1e-9) REQUIRE((along < 0) == hits[i].entering);
  }
}

}  // namespace crt::test
