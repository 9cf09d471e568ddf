#include "core/shading/noise.hpp"

#include <algorithm>
#include <cmath>

namespace crt::core {

namespace {

/// This is the most that the eight gradients around a point can add up to, if all of them are the
/// best for it. It is reached near (0.519, 0.355, 0.5). A test searches for more.
constexpr double largest_sum = 1.0363538112118028;

/// A LatticeCoordinate is a whole number and how far past it a coordinate is, in [0, 1].
struct LatticeCoordinate {
  std::uint64_t cell = 0;
  double past = 0;
};

LatticeCoordinate lattice_coordinate(double value) {
  constexpr double all_whole = 0x1p52;
  if (!(std::abs(value) < all_whole)) return {};
  const double below = std::floor(value);
  return {static_cast<std::uint64_t>(static_cast<std::int64_t>(below)), value - below};
}

/// Applies the finaliser of SplitMix64 (Steele, Lea, Flood, Fast splittable pseudorandom number
/// generators, 2014). Every input bit changes about half of the output's.
std::uint64_t scrambled(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
  return bits ^ (bits >> 31);
}

std::uint64_t lattice_hash(std::uint64_t x, std::uint64_t y, std::uint64_t z, std::uint32_t seed) {
  constexpr std::uint64_t odd_x = 0x9e3779b97f4a7c15u;  // from the golden ratio
  constexpr std::uint64_t odd_y = 0xd1b54a32d192ed03u;  // from its kin in more dimensions
  constexpr std::uint64_t odd_z = 0x8cb92ba72f3d8dd7u;
  return scrambled(scrambled(x * odd_x + y * odd_y + seed) + z * odd_z);
}

/// Returns the product of (x, y, z) with one of the twelve directions to the edges of a cube. Four
/// of them come twice, which nobody can see (Perlin 2002, section 4).
double gradient_product(std::uint64_t hash, double x, double y, double z) {
  const auto choice = static_cast<unsigned>(hash >> 60);
  const double first = choice < 8 ? x : y;
  const double second = choice < 4 ? y : (choice == 12 || choice == 14 ? x : z);
  return ((choice & 1) != 0 ? -first : first) + ((choice & 2) != 0 ? -second : second);
}

/// Returns 6 s^5 - 15 s^4 + 10 s^3, which goes from 0 to 1 with first and second derivatives of 0
/// at the ends.
double fade(double s) {
  return s * s * s * (s * (s * 6 - 15) + 10);
}

double between(double a, double b, double share) {
  return a + share * (b - a);
}

}  // namespace

double gradient_noise(const Vec3& position, std::uint32_t seed) {
  const LatticeCoordinate x = lattice_coordinate(position.x);
  const LatticeCoordinate y = lattice_coordinate(position.y);
  const LatticeCoordinate z = lattice_coordinate(position.z);

  double corners[8];
  for (unsigned corner = 0; corner < 8; ++corner) {
    const unsigned dx = corner & 1;
    const unsigned dy = corner >> 1 & 1;
    const unsigned dz = corner >> 2;
    const std::uint64_t hash = lattice_hash(x.cell + dx, y.cell + dy, z.cell + dz, seed);
    corners[corner] = gradient_product(hash, x.past - dx, y.past - dy, z.past - dz);
  }
  const double share_x = fade(x.past);
  const double share_y = fade(y.past);
  const double near_z = between(between(corners[0], corners[1], share_x),
                                between(corners[2], corners[3], share_x), share_y);
  const double far_z = between(between(corners[4], corners[5], share_x),
                               between(corners[6], corners[7], share_x), share_y);
  return std::clamp(between(near_z, far_z, fade(z.past)) / largest_sum, -1.0, 1.0);
}

double fractal_noise(const Vec3& position, int octaves) {
  // The shift moves the octaves against each other. Without it all of them are 0 at the same
  // points.
  const Vec3 shift(0.3183098861837907, 0.5772156649015329, 0.6931471805599453);
  double sum = 0;
  double strengths = 0;
  double frequency = 1;
  for (int octave = 0; octave < octaves; ++octave) {
    const double strength = 1 / frequency;
    const Vec3 place = position * frequency + static_cast<double>(octave) * shift;
    sum += strength * gradient_noise(place, static_cast<std::uint32_t>(octave));
    strengths += strength;
    frequency *= 2;
  }
  return sum / strengths;
}

}  // namespace crt::core
