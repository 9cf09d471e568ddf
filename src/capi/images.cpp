// This file implements the images of the C interface.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

#include "capi/structs.hpp"
#include "crt/validate.hpp"
#include "text/format.hpp"

namespace crt::capi {

namespace {

int to_side(std::uint32_t pixels, const char* argument) {
  if (pixels > static_cast<std::uint32_t>(std::numeric_limits<int>::max())) {
    reject(argument, text::format("is {}, which no picture can have", pixels));
  }
  return static_cast<int>(pixels);
}

/// Returns the checked distance from row to row of the caller's pixels, in bytes.
std::size_t stride_or_default(std::size_t stride, std::size_t row_bytes, std::size_t rows) {
  if (stride == 0) return row_bytes;
  if (stride < row_bytes)
    reject("row_stride", text::format("is {}, but a row has {} bytes", stride, row_bytes));
  if (stride > std::numeric_limits<std::size_t>::max() / 2 / std::max<std::size_t>(rows, 1)) {
    reject("row_stride", "is longer than memory");
  }
  return stride;
}

std::string path_or_throw(const char* path) {
  require(path, "path");
  if (*path == 0) reject("path", "must not be empty");
  return path;
}

WriteOptions to_options(const crt_write_options* options) {
  const crt_write_options given = taken_or_default(options, "options");
  return {.reproducible = given.reproducible != 0, .colors_only = given.colors_only != 0};
}

}  // namespace

}  // namespace crt::capi

using namespace crt::capi;

crt_status crt_image_create(uint32_t width, uint32_t height, const float* pixels, size_t row_stride,
                            crt_image** out) {
  return guarded([&] {
    require(pixels, "pixels");
    require(out, "out");
    crt::Image image(to_side(width, "width"), to_side(height, "height"));
    const std::size_t row_values = std::size_t{4} * width;
    const std::size_t stride = stride_or_default(row_stride, row_values * sizeof(float), height);
    for (std::size_t y = 0; y < height; ++y) {
      const std::span<float> row = image.pixels().subspan(y * row_values, row_values);
      std::memcpy(row.data(), reinterpret_cast<const char*>(pixels) + y * stride, row.size_bytes());
      if (!std::all_of(row.begin(), row.end(), [](float value) { return std::isfinite(value); })) {
        reject("pixels", crt::text::format("must be finite, but row {} is not", y));
      }
    }
    *out = new crt_image(std::move(image));
  });
}

crt_status crt_image_from_rgba8(uint32_t width, uint32_t height, const uint8_t* pixels,
                                size_t row_stride, crt_image** out) {
  return guarded([&] {
    require(pixels, "pixels");
    require(out, "out");
    const int columns = to_side(width, "width");
    const int rows = to_side(height, "height");
    const std::size_t row_bytes = std::size_t{4} * width;
    const std::size_t stride = stride_or_default(row_stride, row_bytes, height);
    const std::size_t count = height == 0 ? 0 : (height - 1) * stride + row_bytes;
    *out = new crt_image(crt::Image::from_rgba8(columns, rows, {pixels, count}, stride));
  });
}

crt_status crt_image_read(const char* path, crt_image** out) {
  return guarded([&] {
    const std::string file = path_or_throw(path);
    require(out, "out");
    *out = new crt_image(crt::Image::read(file));
  });
}

crt_status crt_image_decode(const void* bytes, size_t count, const char* name, crt_image** out) {
  return guarded([&] {
    require(bytes, "bytes");
    require(out, "out");
    const std::span content(static_cast<const std::byte*>(bytes), count);
    *out = new crt_image(crt::Image::decode(content, name == nullptr ? "image" : name));
  });
}

uint64_t crt_image_not_finite(const crt_image* image, uint32_t* x, uint32_t* y) {
  if (image == nullptr || image->value->not_finite().pixels == 0) return 0;
  const crt::NotFiniteValues& values = image->value->not_finite();
  if (x != nullptr) *x = static_cast<uint32_t>(values.x);
  if (y != nullptr) *y = static_cast<uint32_t>(values.y);
  return values.pixels;
}

uint32_t crt_image_width(const crt_image* image) {
  return image == nullptr ? 0 : static_cast<uint32_t>(image->value->width());
}

uint32_t crt_image_height(const crt_image* image) {
  return image == nullptr ? 0 : static_cast<uint32_t>(image->value->height());
}

const float* crt_image_pixels(const crt_image* image, size_t* row_stride) {
  if (image == nullptr) return nullptr;
  if (row_stride != nullptr)
    *row_stride = static_cast<size_t>(image->value->width()) * 4 * sizeof(float);
  return image->value->pixels().data();
}

size_t crt_image_channel_count(const crt_image* image) {
  return image == nullptr ? 0 : image->value->channels().size();
}

const char* crt_image_channel_name(const crt_image* image, size_t index) {
  if (index >= crt_image_channel_count(image)) return nullptr;
  return image->value->channels()[index].name.c_str();
}

const float* crt_image_channel(const crt_image* image, const char* name) {
  if (image == nullptr || name == nullptr) return nullptr;
  return image->value->channel(name).data();
}

const uint32_t* crt_image_channel_uint(const crt_image* image, const char* name) {
  if (image == nullptr || name == nullptr) return nullptr;
  return image->value->integer_channel(name).data();
}

crt_status crt_image_to_rgba8(const crt_image* image, uint8_t* pixels, size_t row_stride) {
  return guarded([&] {
    require(image, "image");
    require(pixels, "pixels");
    const auto rows = static_cast<std::size_t>(image->value->height());
    const auto row_bytes = static_cast<std::size_t>(image->value->width()) * 4;
    const std::size_t stride = stride_or_default(row_stride, row_bytes, rows);
    const std::vector<std::uint8_t> bytes = image->value->to_rgba8();
    for (std::size_t y = 0; y < rows; ++y)
      std::memcpy(pixels + y * stride, &bytes[y * row_bytes], row_bytes);
  });
}

crt_status crt_image_write(const crt_image* image, const char* path) {
  return crt_image_write_with(image, path, nullptr);
}

crt_status crt_image_write_with(const crt_image* image, const char* path,
                                const crt_write_options* options) {
  return guarded([&] {
    require(image, "image");
    image->value->write(path_or_throw(path), to_options(options));
  });
}

crt_status crt_image_encode(const crt_image* image, const char* format,
                            const crt_write_options* options, crt_buffer** out) {
  return guarded([&] {
    require(image, "image");
    require(format, "format");
    require(out, "out");
    *out = new crt_buffer(image->value->encode(format, to_options(options)));
  });
}

const void* crt_buffer_data(const crt_buffer* buffer) {
  return buffer == nullptr ? nullptr : buffer->bytes.data();
}

size_t crt_buffer_size(const crt_buffer* buffer) {
  return buffer == nullptr ? 0 : buffer->bytes.size();
}

crt_status crt_image_stats(const crt_image* image, crt_render_stats* stats) {
  return guarded([&] {
    require(image, "image");
    fill_in(stats, "stats", to_c(image->value->stats()));
  });
}

crt_status crt_image_settings(const crt_image* image, crt_settings* settings) {
  return guarded([&] {
    require(image, "image");
    fill_in(settings, "settings", to_c(image->value->settings()));
  });
}

crt_status crt_image_with_settings(const crt_image* image, const crt_settings* settings,
                                   crt_image** out) {
  return guarded([&] {
    require(image, "image");
    require(out, "out");
    crt::Settings value = to_settings(settings);
    crt::validate(value);
    crt::Image copy = *image->value;
    copy.set_settings(std::move(value));
    *out = new crt_image(std::move(copy));
  });
}
