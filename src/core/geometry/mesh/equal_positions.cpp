#include "core/geometry/mesh/equal_positions.hpp"

#include <algorithm>
#include <bit>
#include <tuple>

namespace crt::core {

namespace {

/// Returns a number that other positions hardly have. Finding equal ones is faster with it, and
/// nothing but that depends on it.
std::uint64_t hash_of(const Vec3& position) {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) {
    hash ^= std::bit_cast<std::uint64_t>(position[axis] + 0.0);  // which makes 0 of -0
    hash *= 0x9e3779b97f4a7c15u;                                 // 2^64 over the golden ratio
    hash ^= hash >> 32;
  }
  return hash;
}

/// A PlacedVertex is a position in the order in which equal ones are neighbours.
struct PlacedVertex {
  std::uint64_t hash;
  std::uint32_t vertex;
};

}  // namespace

std::vector<std::uint32_t> first_equal(std::span<const Vec3> positions) {
  std::vector<PlacedVertex> order(positions.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = {hash_of(positions[i]), i};
  std::sort(order.begin(), order.end(), [&](const PlacedVertex& a, const PlacedVertex& b) {
    if (a.hash != b.hash) return a.hash < b.hash;
    const Vec3& p = positions[a.vertex];
    const Vec3& q = positions[b.vertex];
    return std::tie(p.x, p.y, p.z, a.vertex) < std::tie(q.x, q.y, q.z, b.vertex);
  });
  std::vector<std::uint32_t> first(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::uint32_t vertex = order[i].vertex;
    const bool is_new = i == 0 || positions[order[i - 1].vertex] != positions[vertex];
    first[vertex] = is_new ? vertex : first[order[i - 1].vertex];
  }
  return first;
}

}  // namespace crt::core
