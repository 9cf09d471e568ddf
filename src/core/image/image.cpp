#include "crt/image.hpp"

#include <cstddef>
#include <new>

#include "core/image/pixel_conversion.hpp"
#include "crt/error.hpp"
#include "crt/image_limits.hpp"
#include "text/format.hpp"

namespace crt {

namespace {

std::size_t first_value(int x, int y, int width) {
  return 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
              static_cast<std::size_t>(x));
}

/// Throws an Error, as an allocation that fails is an Error like any other.
[[noreturn]] void fail_without_memory(int width, int height) {
  throw Error(ErrorCode::out_of_memory,
              text::format("no memory for a picture of {} x {} pixels", width, height));
}

}  // namespace

std::string NotFiniteValues::message() const {
  return text::format(
      "{} has {} pixel{} with values that are not finite (NaN, infinity), {} ({}, {}) from the "
      "top left: they count as 0",
      file.empty() ? "an image" : text::format("'{}'", file), pixels, pixels == 1 ? "" : "s",
      pixels == 1 ? "at" : "the first at", x, y);
}

Image::Image(int width, int height) : width_(width), height_(height) {
  if (width < 1)
    throw Error(ErrorCode::invalid_argument, "a picture's width must be at least 1", "width");
  if (height < 1)
    throw Error(ErrorCode::invalid_argument, "a picture's height must be at least 1", "height");
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (count > most_image_pixels) {
    throw Error(ErrorCode::invalid_argument,
                text::format("a picture of {} x {} pixels is larger than the {} that are possible",
                             width, height, most_image_pixels),
                "width");
  }
  try {
    pixels_.resize(4 * count);
  } catch (const std::bad_alloc&) {
    fail_without_memory(width, height);
  }
  for (std::size_t i = 3; i < pixels_.size(); i += 4) pixels_[i] = 1;
}

Image Image::from_rgba8(int width, int height, std::span<const std::uint8_t> rgba,
                        std::size_t row_stride) {
  Image image(width, height);
  const std::size_t row_bytes = 4 * static_cast<std::size_t>(width);
  const std::size_t stride = row_stride == 0 ? row_bytes : row_stride;
  const auto more_rows = static_cast<std::size_t>(height) - 1;
  if (stride < row_bytes || rgba.size() < row_bytes ||
      (rgba.size() - row_bytes) / stride < more_rows ||
      rgba.size() != more_rows * stride + row_bytes) {
    throw Error(ErrorCode::invalid_argument,
                text::format("{} bytes in rows of {} are not a picture of {} x {} pixels",
                             rgba.size(), stride, width, height),
                "rgba");
  }
  constexpr float full = 255;
  auto to = image.pixels_.begin();
  for (std::size_t y = 0; y <= more_rows; ++y) {
    const std::span<const std::uint8_t> row = rgba.subspan(y * stride, row_bytes);
    for (std::size_t i = 0; i < row_bytes; i += 4) {
      const float alpha = static_cast<float>(row[i + 3]) / full;
      for (std::size_t channel = 0; channel < 3; ++channel) {
        *to++ = static_cast<float>(row[i + channel]) / full * alpha;
      }
      *to++ = alpha;
    }
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

double displayed(double light, const Settings& settings) {
  return core::displayed(light, settings);
}

std::vector<std::uint8_t> Image::to_rgba8() const {
  try {
    return core::display_bytes(*this, core::AlphaMode::straight);
  } catch (const std::bad_alloc&) {
    fail_without_memory(width_, height_);
  }
}

}  // namespace crt
