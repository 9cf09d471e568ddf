#include "lang/random.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace crt::lang {

namespace {

/// Mixes bits as SplitMix64 does. Its constants are David Stafford's variant 13.
std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31);
}

constexpr std::uint64_t golden_gamma = 0x9E3779B97F4A7C15U;

/// Returns 6 t^5 - 15 t^4 + 10 t^3, whose first and second derivatives are 0 at both ends.
double fade(double t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}

double mix_linear(double t, double a, double b) {
  return a + t * (b - a);
}

/// Returns the dot product of (x, y, z) with the gradient of a lattice point. That is one of the 12
/// directions from a cube's centre to the middles of its edges.
double slope(std::uint64_t hash, double x, double y, double z) {
  constexpr std::uint64_t directions = 12;
  constexpr std::array<std::array<int, 3>, directions> gradients = {{{1, 1, 0},
                                                                     {-1, 1, 0},
                                                                     {1, -1, 0},
                                                                     {-1, -1, 0},
                                                                     {1, 0, 1},
                                                                     {-1, 0, 1},
                                                                     {1, 0, -1},
                                                                     {-1, 0, -1},
                                                                     {0, 1, 1},
                                                                     {0, -1, 1},
                                                                     {0, 1, -1},
                                                                     {0, -1, -1}}};
  const auto& gradient = gradients[hash % directions];
  return gradient[0] * x + gradient[1] * y + gradient[2] * z;
}

}  // namespace

std::uint64_t Random::next() {
  state_ += golden_gamma;
  return mix(state_);
}

double Random::next_float() {
  constexpr double unit = 0x1p-53;
  return static_cast<double>(next() >> 11) * unit;
}

std::uint64_t Random2015::next(int bits) {
  constexpr int state_bits = 48;
  constexpr std::uint64_t increment = 0xB;
  state_ = (state_ * multiplier + increment) & ((std::uint64_t{1} << state_bits) - 1);
  return state_ >> (state_bits - bits);
}

double Random2015::next_float() {
  constexpr double unit = 0x1p-53;
  constexpr int high_bits = 26;
  constexpr int low_bits = 27;
  const std::uint64_t high = next(high_bits) << low_bits;
  return static_cast<double>(high + next(low_bits)) * unit;
}

double gradient_noise(const Vec3& point) {
  // Every double beyond this is whole, where the noise is 0. Up to here floor() fits an integer.
  constexpr double all_are_whole = 0x1p52;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(std::abs(point[axis]) < all_are_whole)) return 0;
  }
  const std::array<double, 3> corner = {std::floor(point.x), std::floor(point.y),
                                        std::floor(point.z)};
  const double x = point.x - corner[0];
  const double y = point.y - corner[1];
  const double z = point.z - corner[2];
  const auto at = [&](int dx, int dy, int dz) {
    std::uint64_t hash = 0;
    const std::array<int, 3> offset = {dx, dy, dz};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int64_t cell = static_cast<std::int64_t>(corner[axis]) + offset[axis];
      hash = mix(hash + golden_gamma + static_cast<std::uint64_t>(cell));
    }
    return slope(hash, x - dx, y - dy, z - dz);
  };
  const double u = fade(x);
  const double v = fade(y);
  const double w = fade(z);
  const double near = mix_linear(v, mix_linear(u, at(0, 0, 0), at(1, 0, 0)),
                                 mix_linear(u, at(0, 1, 0), at(1, 1, 0)));
  const double far = mix_linear(v, mix_linear(u, at(0, 0, 1), at(1, 0, 1)),
                                mix_linear(u, at(0, 1, 1), at(1, 1, 1)));
  // The sum can pass 1 by a few hundredths.
  return std::clamp(mix_linear(w, near, far), -1.0, 1.0);
}

}  // namespace crt::lang
