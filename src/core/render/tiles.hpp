// A region of the picture is cut into squares, the portions in which threads take work.
#pragma once

#include <algorithm>
#include <cstddef>

#include "crt/render.hpp"

namespace crt::core {

inline std::size_t pixel_count(const Region& region) {
  return static_cast<std::size_t>(region.width) * static_cast<std::size_t>(region.height);
}

/// Returns whether the pixel at (x, y) of the picture is in a region.
inline bool is_in(const Region& region, int x, int y) {
  return x >= region.x && x < region.x + region.width && y >= region.y &&
         y < region.y + region.height;
}

/// Returns the index of the pixel at (x, y) of the picture in a region, row by row from the top.
inline std::size_t index_in(const Region& region, int x, int y) {
  return static_cast<std::size_t>(y - region.y) * static_cast<std::size_t>(region.width) +
         static_cast<std::size_t>(x - region.x);
}

/// Returns the region and the pixels around it, as far as these are within `limits`.
inline Region widened(const Region& region, int margin, const Region& limits) {
  const int left = std::max(region.x - margin, limits.x);
  const int top = std::max(region.y - margin, limits.y);
  const int right = std::min(region.x + region.width + margin, limits.x + limits.width);
  const int bottom = std::min(region.y + region.height + margin, limits.y + limits.height);
  return {left, top, right - left, bottom - top};
}

class Tiles {
 public:
  /// The side is in pixels. A tile has enough rays to outweigh handing it out, and few enough to
  /// keep all threads busy to the end.
  static constexpr int side = 16;
  static constexpr std::size_t most_pixels = std::size_t{side} * side;

  explicit Tiles(const Region& region)
      : region_(region),
        columns_((region.width + side - 1) / side),
        rows_((region.height + side - 1) / side) {}

  std::size_t count() const {
    return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  }

  /// Returns the index of the tile that a pixel of the region is in.
  std::size_t index(int x, int y) const {
    const int column = (x - region_.x) / side;
    const int row = (y - region_.y) / side;
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  /// Returns a tile in picture coordinates. It is smaller at the right and lower edge if the region
  /// is.
  Region tile(std::size_t index) const {
    const int column = static_cast<int>(index % static_cast<std::size_t>(columns_));
    const int row = static_cast<int>(index / static_cast<std::size_t>(columns_));
    return {region_.x + column * side, region_.y + row * side,
            std::min(side, region_.width - column * side),
            std::min(side, region_.height - row * side)};
  }

 private:
  Region region_;
  int columns_;
  int rows_;
};

}  // namespace crt::core
