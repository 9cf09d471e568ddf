// Corners of triangles are one if they are equal.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crt/vec.hpp"

namespace crt::core {

/// Returns for each position the number of the first that is equal to it; 0 and -0 are equal. It
/// takes O(n log n) for any positions, as a hash table would not.
std::vector<std::uint32_t> first_equal(std::span<const Vec3> positions);

}  // namespace crt::core
