// Gradient noise is a smooth random function of space, which never changes.
#pragma once

#include <cstdint>

#include "crt/vec.hpp"

namespace crt::core {

/// Returns noise with features about 1 in size, in [-1, 1], 0 at whole coordinates, with continuous
/// first and second derivatives. Another seed gives another function. Any finite position is valid.
/// Beyond 2^52, where doubles are whole numbers, it is 0 all along.
///
/// Source: Perlin, Improving Noise, SIGGRAPH 2002. Gradients are chosen by a hash of the lattice
/// point and not by a table of permutations, so that nothing repeats after 256 cells.
double gradient_noise(const Vec3& position, std::uint32_t seed = 0);

/// Returns the sum of `octaves` noises, each half as large and half as strong as the one before, in
/// [-1, 1].
double fractal_noise(const Vec3& position, int octaves);

}  // namespace crt::core
