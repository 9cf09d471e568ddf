// Positions near each other are found in the cells of a grid, four tolerances wide.
#include <array>
#include <cmath>
#include <map>

#include "core/geometry/mesh/equal_positions.hpp"
#include "core/geometry/mesh/repair.hpp"
#include "core/math/vector.hpp"

namespace crt::core {

namespace {

using Cell = std::array<double, 3>;  ///< whole numbers

/// A NearGrid has positions no two of which are within the tolerance. So few are in one cell.
class NearGrid {
 public:
  NearGrid(std::span<const Vec3> positions, double tolerance)
      : positions_(positions), tolerance_(tolerance) {}

  /// Returns the first of the grid's positions that is within the tolerance, or else adds this one.
  std::uint32_t first_near(std::uint32_t number) {
    const Vec3& place = positions_[number];
    const Cell lower = cell_of(place - Vec3(tolerance_));
    const Cell upper = cell_of(place + Vec3(tolerance_));
    std::uint32_t first = number;
    // A place is near one wall of its cell at most along each axis. So there are up to 8.
    for (int corner = 0; corner < 8; ++corner) {
      Cell cell{};
      bool is_new = true;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const bool is_upper = (corner >> axis & 1) != 0;
        cell[axis] = is_upper ? upper[axis] : lower[axis];
        is_new = is_new && !(is_upper && upper[axis] == lower[axis]);
      }
      if (is_new) find(cell, place, first);
    }
    if (first == number) cells_[cell_of(place)].push_back(number);
    return first;
  }

 private:
  Cell cell_of(const Vec3& place) const {
    const double width = 4 * tolerance_;
    return {std::floor(place.x / width), std::floor(place.y / width), std::floor(place.z / width)};
  }

  void find(const Cell& cell, const Vec3& place, std::uint32_t& first) const {
    const auto found = cells_.find(cell);
    if (found == cells_.end()) return;
    for (const std::uint32_t other : found->second) {
      const Vec3 offset = (positions_[other] - place) / tolerance_;
      if (glm::dot(offset, offset) <= 1) first = std::min(first, other);
    }
  }

  std::span<const Vec3> positions_;
  double tolerance_;
  std::map<Cell, std::vector<std::uint32_t>> cells_;
};

}  // namespace

std::vector<std::uint32_t> first_within(std::span<const Vec3> positions, double tolerance) {
  std::vector<std::uint32_t> first = first_equal(positions);
  // With a smaller tolerance the numbers of cells might be beyond all doubles.
  constexpr double least_tolerance = 1e-200;
  if (tolerance < least_tolerance) return first;
  NearGrid grid(positions, tolerance);
  for (std::uint32_t i = 0; i < first.size(); ++i)
    first[i] = first[i] == i ? grid.first_near(i) : first[first[i]];
  return first;
}

}  // namespace crt::core
