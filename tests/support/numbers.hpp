// This makes random numbers, directions and sizes, which are equal in every run.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <random>

#include "crt/vec.hpp"

namespace crt::test {

class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : engine_(seed) {}

  double within(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  int below(int end) { return std::uniform_int_distribution<int>(0, end - 1)(engine_); }
  Vec3 point(double size) {
    return {within(-size, size), within(-size, size), within(-size, size)};
  }
  Vec3 direction() {
    Vec3 v = point(1);
    while (glm::dot(v, v) < 0.01) v = point(1);
    return glm::normalize(v);
  }
  /// Returns a size. Sizes differ greatly.
  double size(double low, double high) { return low * std::pow(high / low, within(0, 1)); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace crt::test
