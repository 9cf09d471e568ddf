// Tests of geometry draw their random numbers here.
#pragma once

#include <cmath>
#include <cstdint>

#include "crt/vec.hpp"

namespace crt::test {

/// A Random makes reproducible random numbers.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits();
  double uniform(double low, double high);
  double power_of_ten(double low, double high);  ///< 10^low to 10^high
  bool one_in(int count) { return bits() % static_cast<std::uint64_t>(count) == 0; }
  Vec3 in_cube();    ///< [-1, 1]^3
  Vec3 direction();  ///< about unit length; one in four is a signed coordinate axis

 private:
  std::uint64_t state_;
};

inline std::uint64_t Random::bits() {  // splitmix64
  state_ += 0x9e3779b97f4a7c15u;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

inline double Random::uniform(double low, double high) {
  return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53);
}

inline double Random::power_of_ten(double low, double high) {
  return std::pow(10.0, uniform(low, high));
}

inline Vec3 Random::in_cube() {
  const double x = uniform(-1, 1);
  const double y = uniform(-1, 1);
  const double z = uniform(-1, 1);
  return {x, y, z};
}

inline Vec3 Random::direction() {
  if (one_in(4)) {
    Vec3 axis(0.0);
    axis[static_cast<int>(bits() % 3)] = one_in(2) ? 1 : -1;
    return axis;
  }
  for (;;) {
    const Vec3 v = in_cube();
    const double squared = v.x * v.x + v.y * v.y + v.z * v.z;
    if (squared > 0.01 && squared <= 1) return v / std::sqrt(squared);
  }
}

}  // namespace crt::test
