// The random numbers and the noise that scripts can ask for: the same everywhere and every time.
#pragma once

#include <cstdint>

#include "crt/vec.hpp"

namespace crt::lang {

/// SplitMix64: G. L. Steele, D. Lea and C. H. Flood, "Fast splittable pseudorandom number generators",
/// OOPSLA 2014, section 6. It is seeded with 0 for each run of a script.
class Random {
 public:
  std::uint64_t next();

  /// Uniform in [0, 1): a multiple of 2^-53.
  double next_float();

 private:
  std::uint64_t state_ = 0;
};

/// Gradient noise after K. Perlin, "Improving noise", SIGGRAPH 2002: 0 at points with whole
/// coordinates, smooth between them, in [-1, 1]. The gradients are chosen by a hash instead of a table.
double gradient_noise(const Vec3& point);

}  // namespace crt::lang
