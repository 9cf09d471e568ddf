// These functions make scenes of any size.
#pragma once

#include <crt/crt.hpp>

#include <random>
#include <vector>

namespace crt::test {

inline std::vector<Entity> balls(int count, double radius, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-5, 5);
  std::vector<Entity> result;
  for (int i = 0; i < count; ++i) {
    const double x = place(random);
    const double y = place(random);
    result.emplace_back(Sphere{.center = {x, y, place(random)}, .radius = radius});
  }
  return result;
}

inline const Entity block = Box{.corner_a = {-5, -5, -5}, .corner_b = {5, 5, 5}};

}  // namespace crt::test
