#include "crt/image.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <new>

#include "core/image/image_limits.hpp"
#include "core/image/pixel_conversion.hpp"
#include "crt/error.hpp"

namespace crt {

namespace {

std::size_t first_value(int x, int y, int width) {
  return 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
}

/// An allocation that fails is an Error like any other.
[[noreturn]] void fail_without_memory(int width, int height) {
  throw Error(ErrorCode::out_of_memory,
              fmt::format("no memory for a picture of {} x {} pixels", width, height));
}

}  // namespace

Image::Image(int width, int height) : width_(width), height_(height) {
  if (width < 1) throw Error(ErrorCode::invalid_argument, "a picture's width must be at least 1", "width");
  if (height < 1) throw Error(ErrorCode::invalid_argument, "a picture's height must be at least 1", "height");
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (count > core::max_image_pixels) {
    throw Error(ErrorCode::invalid_argument,
                fmt::format("a picture of {} x {} pixels is larger than the {} that are possible", width,
                            height, core::max_image_pixels),
                "width");
  }
  try {
    pixels_.resize(4 * count);
  } catch (const std::bad_alloc&) {
    fail_without_memory(width, height);
  }
  for (std::size_t i = 3; i < pixels_.size(); i += 4) pixels_[i] = 1;
}

Image Image::from_rgba8(int width, int height, std::span<const std::uint8_t> rgba) {
  Image image(width, height);
  if (rgba.size() != image.pixels_.size()) {
    throw Error(ErrorCode::invalid_argument,
                fmt::format("{} bytes are not a picture of {} x {} pixels", rgba.size(), width, height),
                "rgba");
  }
  constexpr float full = 255;
  for (std::size_t i = 0; i < rgba.size(); i += 4) {
    const float alpha = static_cast<float>(rgba[i + 3]) / full;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      image.pixels_[i + channel] = static_cast<float>(rgba[i + channel]) / full * alpha;
    }
    image.pixels_[i + 3] = alpha;
  }
  image.set_display_encoded(true);
  return image;
}

Color Image::at(int x, int y) const {
  const float* const pixel = pixels_.data() + first_value(x, y, width_);
  return {double{pixel[0]}, double{pixel[1]}, double{pixel[2]}, double{pixel[3]}};
}

void Image::set(int x, int y, const Color& color) {
  float* const pixel = pixels_.data() + first_value(x, y, width_);
  pixel[0] = static_cast<float>(color.r);
  pixel[1] = static_cast<float>(color.g);
  pixel[2] = static_cast<float>(color.b);
  pixel[3] = static_cast<float>(color.a);
}

std::vector<std::uint8_t> Image::to_rgba8() const {
  try {
    return core::display_bytes(*this, core::AlphaMode::straight);
  } catch (const std::bad_alloc&) {
    fail_without_memory(width_, height_);
  }
}

}  // namespace crt
