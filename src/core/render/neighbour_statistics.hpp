// What the pixels of a tile see, and how those around them get to know it: within the tile while
// its pixels are at hand, and beyond it when all tiles have told what is seen along their rims.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "core/render/tiles.hpp"
#include "core/sampling/pixel_samples.hpp"

namespace crt::core {

/// Tells each pixel of a whole tile, row by row, what those of the tile have seen that are within
/// reach.
void keep_statistics_within(const Region& tile, int reach, std::span<PixelSamples> samples);

/// The pixels of a tile that statistics reach from beyond it.
class TileHalo {
 public:
  TileHalo(const Region& tile, int reach) : tile_(tile), reach_(reach) {}

  bool has(int x, int y) const {
    return is_in_full_row(y) || x < tile_.x + reach_ || x >= tile_.x + tile_.width - reach_;
  }
  /// Their statistics, of a whole tile row by row.
  std::vector<PixelSamples::Statistics> statistics(std::span<const PixelSamples> samples) const;
  /// Where among them those of one are.
  std::size_t index(int x, int y) const;

 private:
  bool is_in_full_row(int y) const {
    return y < tile_.y + reach_ || y >= tile_.y + tile_.height - reach_;
  }

  Region tile_;  ///< in picture coordinates
  int reach_;
};

}  // namespace crt::core
