#include "core/render/canvas.hpp"

#include <algorithm>
#include <cstddef>

namespace crt::core {

Canvas::Canvas(const Region& region, const Settings& settings)
    : region_(region), image_(region.width, region.height) {
  std::fill(image_.pixels().begin(), image_.pixels().end(), 0.0f);
  image_.set_settings(settings);
}

void Canvas::put(const Region& tile, std::span<const float> pixels) {
  const auto row_values = static_cast<std::size_t>(tile.width) * 4;
  const std::lock_guard lock(mutex_);
  for (int y = 0; y < tile.height; ++y) {
    const std::size_t row = index_in(region_, tile.x, tile.y + y);
    std::copy_n(
        pixels.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y) * row_values),
        row_values, image_.pixels().begin() + static_cast<std::ptrdiff_t>(row * 4));
  }
}

void Canvas::put(std::span<const PlacedPixel> pixels) {
  const std::lock_guard lock(mutex_);
  for (const PlacedPixel& pixel : pixels) {
    const std::size_t place = index_in(region_, pixel.x, pixel.y);
    std::copy_n(pixel.values.begin(), 4,
                image_.pixels().begin() + static_cast<std::ptrdiff_t>(place * 4));
  }
}

void Canvas::put_aovs(const AovTile& tile) {
  const std::lock_guard lock(mutex_);
  tile.put(region_, image_);
}

void Canvas::set_stats(const RenderStats& stats) {
  const std::lock_guard lock(mutex_);
  image_.stats() = stats;
}

Image Canvas::copy() const {
  const std::lock_guard lock(mutex_);
  return image_;
}

}  // namespace crt::core
