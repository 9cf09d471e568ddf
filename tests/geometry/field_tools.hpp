// The tests of fields compare them with other primitives.
#pragma once

#include <doctest/doctest.h>

#include <cmath>

#include "geometry/exact_tools.hpp"
#include "geometry/oracle.hpp"

namespace crt::test {

inline const Field x = Field::x();
inline const Field y = Field::y();
inline const Field z = Field::z();

inline core::CrossingList crossings(const Implicit& implicit, const core::ObjectRay& ray) {
  core::CrossingList result;
  core::make_shape(implicit)->crossings(ray, result);
  return result;
}

inline core::ObjectRay random_ray(Random& random, double reach) {
  const Vec3 aim = reach * random.in_cube();
  const Vec3 direction = random.direction() * random.power_of_ten(-1, 1);
  return {.origin = aim - random.uniform(-1, 6) * reach * direction, .direction = direction};
}

/// Requires that a field has the crossings of another primitive, where that is within its box.
inline void check_against(const Implicit& implicit, const Primitive& other, int count) {
  Random random(11);
  int disputed = 0;
  int found = 0;
  for (int i = 0; i < count; ++i) {
    const core::ObjectRay ray = random_ray(random, 1.5);
    const core::CrossingList truth = exact_crossings(other, Transform{}, ray.origin, ray.direction);
    for (const core::CrossingList& list :
         {crossings(implicit, ray),
          exact_crossings(implicit, Transform{}, ray.origin, ray.direction)}) {
      if (list.size() != truth.size()) {
        ++disputed;
        continue;
      }
      for (std::size_t k = 0; k < list.size(); ++k) {
        ++found;
        REQUIRE(list[k].entering == truth[k].entering);
        const double off = (list[k].t - truth[k].t) + (list[k].t_low - truth[k].t_low);
        REQUIRE(std::abs(off) <= list[k].error + truth[k].error);
        REQUIRE(list[k].error <= 1e-6);
      }
    }
  }
  CHECK(found > count / 4);
  CHECK(disputed * 1000 < count);
}

}  // namespace crt::test
