// Pictures are split into pieces, and these are given to tasks, so that each task costs about as
// much as any other.
#pragma once

#include <span>
#include <vector>

#include "farm/manifest.hpp"

namespace crt::farm {

/// A CostMap says what the parts of a picture cost: the seconds of cells, in rows from the top, all
/// of one size.
struct CostMap {
  int width = 0;  ///< of the picture, in pixels
  int height = 0;
  int columns = 0;
  int rows = 0;
  std::vector<double> seconds{};
  double prepare_seconds = 0;  ///< before the first pixel

  double total() const;
  /// Returns the seconds of a part of the picture.
  double of(const Region& region) const;
};

/// A Shape says how pictures are to be split.
struct SplitShape {
  int tasks = 1;
  int tile_width = 0;  ///< 0 for cuts by cost
  int tile_height = 0;
};

/// Splits the pictures of frames, from the number `first` on, each of which has a map.
std::vector<Task> split(std::span<const CostMap* const> frames, int first, const SplitShape& shape);

}  // namespace crt::farm
