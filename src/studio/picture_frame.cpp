#include "studio/picture_frame.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <utility>

namespace crt::studio {

namespace {

constexpr std::uint32_t magic = 0x46545243;  // "CRTF"
constexpr std::uint32_t last_frame = 0x100;
constexpr std::uint32_t denoised_frame = 0x200;
constexpr std::size_t bytes_of_pixel = 4;
/// A frame has about so many bytes of pixels at most.
constexpr std::size_t most_bytes = std::size_t{1} << 20;
/// A picture of more pixels than this is shown smaller.
constexpr double most_pixels = 8 << 20;

struct Rows {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

Rows changed_rows(const EncodedPicture& picture, const EncodedPicture* before) {
  Rows rows{0, picture.height};
  if (!before || before->width != picture.width || before->height != picture.height ||
      before->kind != picture.kind)
    return rows;
  const std::size_t stride = picture.width * bytes_of_pixel;
  const auto differs = [&](std::uint32_t row) {
    return std::memcmp(picture.rgba.data() + row * stride, before->rgba.data() + row * stride,
                       stride) != 0;
  };
  while (rows.begin < rows.end && !differs(rows.begin)) ++rows.begin;
  while (rows.end > rows.begin && !differs(rows.end - 1)) --rows.end;
  return rows;
}

void put(std::string& bytes, std::uint32_t number) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(number >> shift & 0xffU);
}

/// Returns the mean of a channel over a square of pixels, as far as that lies in the picture.
std::uint8_t mean_of(const EncodedPicture& picture, std::uint32_t column, std::uint32_t row,
                     std::uint32_t step, std::size_t channel) {
  std::uint32_t sum = 0;
  std::uint32_t count = 0;
  for (std::uint32_t y = row; y < std::min(row + step, picture.height); ++y) {
    for (std::uint32_t x = column; x < std::min(column + step, picture.width); ++x, ++count)
      sum += picture.rgba[(std::size_t{y} * picture.width + x) * bytes_of_pixel + channel];
  }
  return static_cast<std::uint8_t>((sum + count / 2) / count);
}

}  // namespace

int shown_step(int width, int height) {
  const double pixels = static_cast<double>(width) * height;
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(pixels / most_pixels))));
}

void reduce(EncodedPicture& picture) {
  const auto step = static_cast<std::uint32_t>(
      shown_step(static_cast<int>(picture.width), static_cast<int>(picture.height)));
  if (step == 1) return;
  std::vector<std::uint8_t> rgba;
  for (std::uint32_t row = 0; row < picture.height; row += step) {
    for (std::uint32_t column = 0; column < picture.width; column += step) {
      for (std::size_t channel = 0; channel < bytes_of_pixel; ++channel)
        rgba.push_back(mean_of(picture, column, row, step, channel));
    }
  }
  picture.rgba = std::move(rgba);
  picture.width = (picture.width + step - 1) / step;
  picture.height = (picture.height + step - 1) / step;
}

std::vector<std::string> frames_of(const EncodedPicture& picture, const EncodedPicture* before) {
  const Rows rows = changed_rows(picture, before);
  const std::size_t stride = picture.width * bytes_of_pixel;
  const auto rows_of_frame = static_cast<std::uint32_t>(
      std::max<std::size_t>(1, most_bytes / std::max<std::size_t>(stride, 1)));
  std::vector<std::string> frames;
  std::uint32_t row = rows.begin;
  do {
    const std::uint32_t count = std::min(rows_of_frame, rows.end - row);
    const bool is_last = row + count == rows.end;
    std::string& bytes = frames.emplace_back();
    bytes.reserve(40 + count * stride);
    for (const std::uint32_t number :
         {magic,
          static_cast<std::uint32_t>(picture.kind) | (is_last ? last_frame : 0) |
              (picture.is_denoised ? denoised_frame : 0),
          picture.number, picture.revision, picture.full_width, picture.full_height, picture.width,
          picture.height, row, count})
      put(bytes, number);
    bytes.append(reinterpret_cast<const char*>(picture.rgba.data()) + row * stride, count * stride);
    row += count;
  } while (row < rows.end);
  return frames;
}

}  // namespace crt::studio
