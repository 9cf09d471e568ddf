// Neighbour statistics pass on what pixels see to those around them. Within a tile that is done
// while its pixels are at hand. Beyond it it is done when all tiles have the statistics of their
// halos.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "core/render/tiles.hpp"
#include "core/sampling/pixel_samples.hpp"

namespace crt::core {

/// Gives each pixel of a whole tile, row by row, the statistics of the tile's pixels within reach.
void keep_statistics_within(const Region& tile, int reach, std::span<PixelSamples> samples);

/// A TileHalo has the pixels of a tile that statistics reach from beyond it.
class TileHalo {
 public:
  TileHalo(const Region& tile, int reach) : tile_(tile), reach_(reach) {}

  bool has(int x, int y) const {
    return is_in_full_row(y) || x < tile_.x + reach_ || x >= tile_.x + tile_.width - reach_;
  }
  /// Returns the statistics of the halo's pixels, from those of a whole tile row by row.
  std::vector<PixelSamples::Statistics> statistics(std::span<const PixelSamples> samples) const;
  /// Returns the index of a pixel among them.
  std::size_t index(int x, int y) const;

 private:
  bool is_in_full_row(int y) const {
    return y < tile_.y + reach_ || y >= tile_.y + tile_.height - reach_;
  }

  Region tile_;  ///< in picture coordinates
  int reach_;
};

}  // namespace crt::core
