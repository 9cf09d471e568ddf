// Scripts can ask for these random numbers and this noise, which are equal everywhere and every
// time.
#pragma once

#include <cstdint>

#include "crt/vec.hpp"

namespace crt::lang {

/// Random is SplitMix64: G. L. Steele, D. Lea and C. H. Flood, "Fast splittable pseudorandom number
/// generators", OOPSLA 2014, section 6. It is seeded with 0 for each run of a script.
class Random {
 public:
  std::uint64_t next();

  /// Returns a uniform number in [0, 1), a multiple of 2^-53.
  double next_float();

 private:
  std::uint64_t state_ = 0;
};

/// Random2015 is the generator of java.util.Random, as its documentation defines it, seeded with
/// 1337. Scripts of 2015 draw from it. It is linear congruential modulo 2^48 (D. E. Knuth, The art
/// of computer programming, volume 2, section 3.2.1).
class Random2015 {
 public:
  /// Returns a uniform number in [0, 1), a multiple of 2^-53, from 26 bits of one step and 27 of
  /// the next. This is nextDouble().
  double next_float();

 private:
  static constexpr std::uint64_t multiplier = 0x5DEECE66D;
  static constexpr std::uint64_t seed = 1337;

  std::uint64_t next(int bits);

  std::uint64_t state_ = seed ^ multiplier;
};

/// Returns gradient noise after K. Perlin, "Improving noise", SIGGRAPH 2002. It is 0 at points with
/// whole coordinates, smooth between them, in [-1, 1]. The gradients are chosen by a hash instead
/// of a table.
double gradient_noise(const Vec3& point);

}  // namespace crt::lang
