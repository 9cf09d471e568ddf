#include "core/render/canvas.hpp"

#include <algorithm>
#include <cstddef>
#include <new>

#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

/// Returns the numbers of a part of a picture, of which each pixel has so many.
template <class Number>
std::vector<Number> part_of(std::span<const Number> numbers, std::size_t per_pixel,
                            const Region& region, const Region& part) {
  std::vector<Number> result;
  result.reserve(per_pixel * pixel_count(part));
  for (int y = 0; y < part.height; ++y) {
    const auto row = numbers.subspan(per_pixel * index_in(region, part.x, part.y + y),
                                     per_pixel * static_cast<std::size_t>(part.width));
    result.insert(result.end(), row.begin(), row.end());
  }
  return result;
}

/// Returns a part of a picture that shows a region.
Image part_of(Image& image, const Region& region, const Region& part) {
  if (part.width == region.width && part.height == region.height) return std::move(image);
  Image result(part.width, part.height);
  const std::vector<float> pixels =
      part_of(std::span<const float>(image.pixels()), 4, region, part);
  std::copy(pixels.begin(), pixels.end(), result.pixels().begin());
  std::vector<ImageChannel> channels;
  for (const ImageChannel& channel : image.channels()) {
    std::visit(
        [&]<class Number>(const std::vector<Number>& values) {
          channels.push_back(
              {channel.name, part_of(std::span<const Number>(values), 1, region, part)});
        },
        channel.values);
  }
  result.set_channels(std::move(channels));
  result.set_settings(image.settings());
  result.stats() = image.stats();
  return result;
}

}  // namespace

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

void Canvas::denoise(const StripRunner& run, const Region& part) {
  Image filtered = denoised_copy(run, part);
  const std::lock_guard lock(mutex_);
  image_ = std::move(filtered);
  region_ = part;
  guides_ = {};
}

Image Canvas::denoised_copy(const StripRunner& run, const Region& part) const {
  std::unique_lock lock(mutex_);
  Image image = image_;
  const Region region = region_;
  const std::vector<Guide> guides = guides_;
  lock.unlock();
  if (!guides.empty()) core::denoise(image.width(), image.height(), image.pixels(), guides, run);
  return part_of(image, region, part);
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
