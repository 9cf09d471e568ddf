#include "core/render/neighbour_statistics.hpp"

#include <array>

namespace crt::core {

namespace {

using Statistics = PixelSamples::Statistics;

/// Returns the statistics of `count` places, `stride` apart, as far as they are within reach of
/// `place`.
Statistics statistics_around(const Statistics* row, std::size_t stride, std::size_t place,
                             std::size_t count, std::size_t reach) {
  const std::size_t last = std::min(place + reach, count - 1);
  std::size_t next = place - std::min(place, reach);
  Statistics statistics = row[next * stride];
  while (++next <= last) statistics.take(row[next * stride]);
  return statistics;
}

}  // namespace

void keep_statistics_within(const Region& tile, int reach, std::span<PixelSamples> samples) {
  // A square's statistics are those of its rows, and these are those of the pixels in them.
  std::array<Statistics, Tiles::most_pixels> seen;
  std::array<Statistics, Tiles::most_pixels> of_rows;
  const auto width = static_cast<std::size_t>(tile.width);
  const auto height = static_cast<std::size_t>(tile.height);
  const auto far = static_cast<std::size_t>(reach);
  for (std::size_t i = 0; i < samples.size(); ++i) seen[i] = samples[i].statistics();
  for (std::size_t y = 0; y < height; ++y) {
    const Statistics* const row = &seen[y * width];
    for (std::size_t x = 0; x < width; ++x)
      of_rows[y * width + x] = statistics_around(row, 1, x, width, far);
  }
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      samples[y * width + x].keep(statistics_around(&of_rows[x], width, y, height, far));
    }
  }
}

std::vector<Statistics> TileHalo::statistics(std::span<const PixelSamples> samples) const {
  const int right = tile_.x + tile_.width - 1;
  const int bottom = tile_.y + tile_.height - 1;
  std::vector<Statistics> statistics;
  statistics.reserve(index(right, bottom) + 1);
  for (int y = tile_.y; y <= bottom; ++y) {
    for (int x = tile_.x; x <= right; ++x) {
      if (has(x, y)) statistics.push_back(samples[index_in(tile_, x, y)].statistics());
    }
  }
  return statistics;
}

std::size_t TileHalo::index(int x, int y) const {
  const int column = x - tile_.x;
  const int row = y - tile_.y;
  // Rows of which only the ends are on the halo leave out so many pixels.
  const int left_out = std::max(tile_.width - 2 * reach_, 0);
  const int full_rows =
      std::min(row, reach_) + std::max(row - std::max(tile_.height - reach_, reach_), 0);
  const bool is_right_end = column >= reach_ && !is_in_full_row(y);
  return static_cast<std::size_t>(row * tile_.width - (row - full_rows) * left_out + column -
                                  (is_right_end ? left_out : 0));
}

}  // namespace crt::core
