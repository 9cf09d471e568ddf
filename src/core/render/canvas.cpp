#include "core/render/canvas.hpp"

#include <algorithm>
#include <cstddef>
#include <new>

#include "crt/error.hpp"
#include "text/format.hpp"

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

void Canvas::add_guides() {
  try {
    guides_.resize(image_.pixels().size() / 4);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::out_of_memory, text::format("no memory to denoise {} x {} pixels",
                                                       image_.width(), image_.height()));
  }
}

void Canvas::put(std::span<const PlacedGuide> guides) {
  const std::lock_guard lock(mutex_);
  for (const PlacedGuide& placed : guides)
    guides_[index_in(region_, placed.x, placed.y)] = placed.guide;
}

std::vector<Guide> Canvas::guides() const {
  const std::lock_guard lock(mutex_);
  return guides_;
}

void Canvas::set_guides(std::vector<Guide> guides) {
  const std::lock_guard lock(mutex_);
  guides_ = std::move(guides);
}

void Canvas::denoise(const StripRunner& run) {
  Image filtered = denoised_copy(run);
  const std::lock_guard lock(mutex_);
  image_ = std::move(filtered);
  guides_ = {};
}

Image Canvas::denoised_copy(const StripRunner& run) const {
  std::unique_lock lock(mutex_);
  Image image = image_;
  const std::vector<Guide> guides = guides_;
  lock.unlock();
  if (!guides.empty()) core::denoise(image.width(), image.height(), image.pixels(), guides, run);
  return image;
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
