// Triangles that share corners are taken apart where more than two of them meet at an edge, or
// where they meet in a corner alone. What is left is a closed manifold.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/tessellate/dual_mesh.hpp"

namespace crt::core {

/// Gives each fan of triangles a corner of its own. At each edge there must be as many triangles
/// one way as the other way. The cells of edges that are still shared by several pairs are added to
/// `tangled`.
void close(std::vector<DualVertex>& vertices, std::vector<std::array<std::uint32_t, 3>>& triangles,
           std::vector<std::uint32_t>& tangled);

}  // namespace crt::core
