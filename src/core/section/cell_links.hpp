// In each cell the crossings of its border are linked by the boundary between them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/section/boundary_edges.hpp"

namespace crt::core {

/// A CellLink is the boundary in a cell from one crossing of its border to another, with the solid
/// on its left.
struct CellLink {
  static constexpr std::size_t unknown_face = BoundaryCell::unknown_face;

  std::uint32_t from = 0;  ///< the numbers of the crossings
  std::uint32_t to = 0;
  PlanePoint begin;
  PlanePoint end;
  /// Are the faces on which it begins and ends. If they differ, it has a corner. If they are
  /// unknown_face, nothing is known but that it is in the cell.
  std::size_t first_face = unknown_face;
  std::size_t last_face = unknown_face;
  PlanePoint corner{};
};

/// Links the crossings of a simple cell. Returns nothing if they do not fit what is known of it.
std::optional<std::vector<CellLink>> links_of(const BoundaryLooks& looks, const BoundaryCell& cell,
                                              std::span<const BorderCrossing> border);
/// Links the crossings of any cell by straight lines.
std::vector<CellLink> straight_links(std::span<const BorderCrossing> border);

}  // namespace crt::core
