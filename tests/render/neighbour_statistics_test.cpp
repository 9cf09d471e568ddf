// What a pixel sees reaches the pixels around, whichever tiles they are in.
#include "core/render/neighbour_statistics.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

using namespace crt::core;
using crt::Region;

namespace {

/// Makes the pixels of a tile that all see black, but one that sees white, of two samples each.
std::vector<PixelSamples> tile_with_white(const Region& tile, std::size_t white) {
  std::vector<PixelSamples> pixels(pixel_count(tile));
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const Lanes value = lanes_of(i == white ? 1 : 0);
    SeenSamples seen(pixels[i], i == white ? 2 : 1);
    seen.add(value, 0, i == white ? 2 : 1);
    seen.add(value, 0, i == white ? 2 : 1);
    for (std::int64_t k = 0; k < 2; ++k)
      pixels[i].add_step(PixelSamples::place_of_step(k, 1), value);
    pixels[i].add_seen(seen, true);
  }
  return pixels;
}

}  // namespace

TEST_CASE("inside a tile what a pixel sees reaches those around it, and no others") {
  for (const Region& tile : {Region{16, 32, 16, 16}, Region{0, 0, 1, 7}, Region{0, 0, 5, 3}}) {
    for (const int reach : {1, 2}) {
      for (std::size_t white = 0; white < pixel_count(tile); ++white) {
        std::vector<PixelSamples> pixels = tile_with_white(tile, white);
        keep_statistics_within(tile, reach, pixels);
        const int width = tile.width;
        for (int i = 0; i < static_cast<int>(pixels.size()); ++i) {
          const int across = std::abs(i % width - static_cast<int>(white) % width);
          const int down = std::abs(i / width - static_cast<int>(white) / width);
          const MeanInterval interval =
              pixels[static_cast<std::size_t>(i)].interval(SampleCount(2));
          CHECK((interval.least_shown > 0) == (across <= reach && down <= reach));
        }
      }
    }
  }
}

TEST_CASE("the statistics of a halo are found where they were put, whatever the tile's size") {
  for (const Region& tile : {Region{16, 32, 16, 16}, Region{3, 4, 1, 7}, Region{0, 0, 5, 3},
                             Region{9, 9, 3, 3}, Region{1, 2, 6, 1}, Region{0, 0, 2, 16}}) {
    for (const int reach : {1, 2}) {
      const TileHalo halo(tile, reach);
      std::size_t on_rim = 0;
      for (int y = tile.y; y < tile.y + tile.height; ++y) {
        for (int x = tile.x; x < tile.x + tile.width; ++x) {
          const int to_side = std::min(x - tile.x, tile.x + tile.width - 1 - x);
          const int to_end = std::min(y - tile.y, tile.y + tile.height - 1 - y);
          CHECK(halo.has(x, y) == (std::min(to_side, to_end) < reach));
          if (!halo.has(x, y)) continue;
          CHECK(halo.index(x, y) == on_rim++);
          const std::vector<PixelSamples::Statistics> statistics =
              halo.statistics(tile_with_white(tile, index_in(tile, x, y)));
          CHECK(statistics[halo.index(x, y)].high[0] == 1);
        }
      }
      CHECK(halo.statistics(tile_with_white(tile, 0)).size() == on_rim);
    }
  }
}
