// In each cell the crossings of its border are linked by the outline between them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/section/outline_edges.hpp"

namespace crt::core {

/// A CellLink is the outline in a cell from one crossing of its border to another, with the solid
/// on its left.
struct CellLink {
  static constexpr std::size_t no_face = OutlineCell::no_face;

  std::uint32_t from = 0;  ///< the numbers of the crossings
  std::uint32_t to = 0;
  PlanePoint begin;
  PlanePoint end;
  /// Are the faces on which it begins and ends. If they differ, it has a corner. If they are
  /// no_face, nothing is known but that it is in the cell.
  std::size_t first_face = no_face;
  std::size_t last_face = no_face;
  PlanePoint corner{};
};

/// Links the crossings of a simple cell. Returns nothing if they do not fit what is known of it.
std::optional<std::vector<CellLink>> links_of(const OutlineLooks& looks, const OutlineCell& cell,
                                              std::span<const BorderCrossing> border);
/// Links the crossings of any cell by straight lines.
std::vector<CellLink> straight_links(std::span<const BorderCrossing> border);

}  // namespace crt::core
